"""What notebooks show: HTML that is whole, escaped, and needs no network."""

import html
import html.parser
import json
import pathlib
import re
import subprocess
import sys
import unittest

import numpy as np

import carom
from python_fixture import FolderTest, falling_block

VOID = {"br", "line", "rect", "progress", "meta", "link", "input"}


class Checked(html.parser.HTMLParser):
    """Every element that is opened is closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.attributes = [], []
        self.feed(text)
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]
        if tag not in VOID or tag == "progress":
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


class ResultTest(FolderTest):
    def test_verdict_figures_and_pictures(self):
        case = falling_block()
        case["title"] = "a <b>lock & more"
        result = case.start().finish()
        text = result._repr_html_()
        checked = Checked(text)
        self.assertIn("Good", text)
        self.assertIn("a &lt;b&gt;lock &amp; more", text)
        self.assertGreater(len(result.figures), 1)
        peak = result.contact["floor.force_z"].max()
        self.assertIn(("Peak force, floor", f"{peak / 1e6:.4g} MN"), [figure[:2] for figure in result.figures])
        for title, value, remark in result.figures:
            self.assertIn(html.escape(value), text, title)
        lines = [value for tag, name, value in checked.attributes if (tag, name) == ("polyline", "points")]
        self.assertEqual(len(lines), 1 + 3)  # force; kinetic, strain, contact
        self.assertFalse([a for a in checked.attributes if a[1] in ("src", "href")])

    def test_curves_are_drawn_to_scale(self):
        result = falling_block().start().finish()
        text = result._repr_html_()
        points = np.array([pair.split(",") for pair in re.search('points="([^"]*)"', text)[1].split()], dtype=float)
        force = np.linalg.norm([result.contact[f"floor.force_{axis}"] for axis in "xyz"], axis=0)
        np.testing.assert_allclose(points[:, 1], 150.0 * (1.0 - force / force.max()), atol=0.06)  # one digit
        np.testing.assert_allclose(points[:, 0], 400.0 * result.contact["time"] / result.contact["time"][-1], atol=0.06)

    def test_long_curves_keep_their_peaks(self):
        y = np.zeros(100_000)
        y[77_777], y[33_333] = 3.0, -2.0
        rows = carom._html._drawn(y)
        self.assertLess(len(rows), 500)
        self.assertTrue({0, 33_333, 77_777, 99_999} <= set(rows))

    def test_what_failed_is_said(self):
        case = falling_block()
        case["check"] = [{"quantity": "velocity_z", "place": "top", "time": 5e-5, "value": 7.0, "tolerance": 0.01,
                          "source": "nowhere"}]
        result = case.start().finish()
        self.assertEqual(result.verdict, "failed")
        Checked(result._repr_html_())
        self.assertIn("reference 7", result._repr_html_())
        stopped = case.start()
        stopped.step()  # the check is not reached
        self.assertIn("Stopped", stopped.stop()._repr_html_())

    def test_a_run_on_its_way(self):
        run = falling_block().start()
        run.step(25)
        text = run._repr_html_()
        Checked(text)
        self.assertIn("step 25", text)
        self.assertIn(f"{np.linalg.norm(run.contact['floor'].force):.4g} N", text)
        Checked(falling_block().start()._repr_html_())


class ViewTest(FolderTest):
    def test_the_frame_holds_a_page_that_needs_nothing(self):
        result = falling_block().start("out").finish()
        shown = result.view(height=321)
        checked = Checked(shown._repr_html_())
        (page,) = [value for tag, name, value in checked.attributes if (tag, name) == ("iframe", "srcdoc")]
        self.assertEqual(page, shown.html)
        self.assertIn("height:321px", shown._repr_html_())
        self.assertIn('data-view="view-0"', page)
        self.assertNotIn("<h1>", page)
        self.assertFalse(re.findall(r'(?:src|href)="(?!data:)[^"#]', page))
        frames = json.loads(re.search('id="view-0">(.*?)</script>', page, re.DOTALL)[1])
        self.assertTrue(frames)
        self.assertLess(len(page), 4_000_000)

    def test_a_browser_draws_it(self):
        sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "browser"))
        try:
            from browser import browser, picture, wait_for
        except ImportError:
            self.skipTest("selenium is not installed (apt install chromium chromium-driver python3-selenium)")
        result = falling_block().start("out").finish()
        page = self.folder / "page.html"
        page.write_text('<!DOCTYPE html><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
                        '<link rel="icon" href="data:,">' + result._repr_html_()
                        + result.view()._repr_html_(), encoding="utf-8")
        for width in (1400, 420):
            with browser(width) as driver:
                driver.get(f"file://{page}")
                driver.switch_to.frame(driver.find_element("css selector", "iframe"))
                wait_for(driver, "'ready' in (document.querySelector('[data-view]')?.dataset ?? {})")
                self.assertGreater(picture(driver, driver.find_element("css selector", ".stage canvas"))["count"], 1000)
                driver.switch_to.default_content()
                self.assertEqual([entry for entry in driver.get_log("browser") if entry["level"] == "SEVERE"], [])
                wide = driver.execute_script("return document.documentElement.scrollWidth")
                self.assertLessEqual(wide, width)

    def test_what_is_missing(self):
        with self.assertRaisesRegex(FileNotFoundError, 'case.start\\("out"\\)'):
            falling_block().start().finish().view()
        case = falling_block()
        case["output"]["fields"] = []
        with self.assertRaisesRegex(RuntimeError, "frames"):
            case.start("out").finish().view()


class NotebookTest(FolderTest):
    def test_in_a_notebook(self):
        try:
            import nbconvert  # noqa: F401
            import nbformat
            import ipykernel  # noqa: F401
        except ImportError:
            self.skipTest("nbconvert is not installed (apt install python3-nbconvert python3-ipykernel)")
        cells = ["import sys; sys.path.insert(0, " + repr(str(pathlib.Path(__file__).parent)) + ")\n"
                 "from python_fixture import falling_block\nimport carom\nrun = falling_block().start('out')\n"
                 "run.step(20)\nrun", "result = run.finish()\nresult", "result.view()",
                 "carom.study([falling_block(speed=-s) for s in (1.0, 2.0)], progress=False)[1].value"]
        book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(source) for source in cells])
        nbformat.write(book, "book.ipynb")
        subprocess.run([sys.executable, "-m", "nbconvert", "--execute", "--to", "html", "book.ipynb"], check=True,
                       capture_output=True)
        text = pathlib.Path("book.html").read_text()
        self.assertEqual(text.count("<iframe srcdoc="), 1)
        self.assertGreaterEqual(text.count("Contact forces"), 3)
        self.assertIn("step 20", text)


if __name__ == "__main__":
    unittest.main()
