#!/usr/bin/python3
"""Curves, exports, pages of several runs and the page of a run that goes on, in headless Chromium.

Usage: report_test.py CAROM
"""

import csv
import io
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

from browser import PATIENCE, browser, open_report, picture, saved, wait_for
from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

# A bar thrown at a wall; its mesh and scheme differ between runs.
CASE = """
title = "Bar on a wall, {cells} cells"
units = "SI"

[[mesh.block]]
size = [0.02, 0.02, 0.2]
divisions = [2, 2, {cells}]
groups = {{ cells = "BAR", zmin = "FOOT", zmax = "TOP" }}

[materials.steel]
law = "linear_elastic"
E = 2.0e11
nu = 0.3
rho = 8000.0

[[part]]
name = "bar"
cells = "BAR"
material = "steel"

[[initial]]
part = "bar"
velocity = [0.0, 0.0, -1.0]

[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]

[scheme]
kind = "central_differences"

[time]
end = {end}

[[probe]]
name = "top"
group = "TOP"
quantities = ["displacement", "velocity"]
"""

# Hides the first curve and drags over the middle of its chart; true once the chart is zoomed.
ZOOM_AND_HIDE = """(() => {
  window.isOld = true;
  const chart = document.querySelector("[data-chart]"), box = chart?.getBoundingClientRect();
  if (!chart?.querySelector("canvas")) return false;
  const button = document.querySelector(".legend button");
  if (button.getAttribute("aria-pressed") === "true") button.click();
  const mouse = (type, share, target) => target.dispatchEvent(new MouseEvent(type, {
    bubbles: true, clientX: box.left + share * box.width, clientY: box.top + box.height / 2 }));
  for (const canvas of chart.querySelectorAll("canvas")) {
    mouse("mousedown", 0.4, canvas);
    mouse("mousemove", 0.7, document);
    mouse("mouseup", 0.7, document);
  }
  return chart.querySelector(".dygraph-axis-label-x").textContent !== "0";
})()"""


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.holder.name)
        for cells in (10, 20):
            cls.run_case(f"bar_{cells}", cells, 1e-4)
        cls.context = browser()
        cls.driver = cls.context.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.context.__exit__(None, None, None)
        cls.holder.cleanup()

    @classmethod
    def write_case(cls, name, cells, end):
        case = cls.folder / f"{name}.toml"
        case.write_text(CASE.format(cells=cells, end=end), encoding="utf-8")
        return case

    @classmethod
    def run_case(cls, name, cells, end):
        subprocess.run([CAROM, "run", cls.write_case(name, cells, end), "--out", cls.folder / name, "--quiet"], check=False)

    def table(self, name):
        """Column names and rows of a .csv file."""
        with (self.folder / name).open(encoding="utf-8") as stream:
            return [row for row in csv.reader(stream) if not row[0].startswith("#")]

    def saved(self, figure, kind):
        return saved(self.driver, figure.find_element(By.XPATH, f".//span[@class='exports']/button[text()='{kind}']"))

    def figure(self, title):
        return self.driver.find_element(By.XPATH, f"//figure[figcaption[starts-with(., '{title}')]]")

    def test_curves_are_saved_as_they_are_shown(self):
        open_report(self.driver, self.folder / "bar_20/report.html")
        figure = self.figure("top · velocity")
        name, data = self.saved(figure, "CSV")
        self.assertEqual(name, "top_velocity.csv")
        rows = list(csv.reader(io.StringIO(data.decode())))
        self.assertEqual(rows[0][0], "time [µs]")
        column = next(k for k, title in enumerate(rows[0]) if title.startswith("z"))
        # The first and the last row of probes.csv.
        table = self.table("bar_20/probes.csv")
        own = table[0].index("top.velocity_z")
        for row, known in ((rows[1], table[1]), (rows[-1], table[-1])):
            self.assertAlmostEqual(float(row[0]), 1e6 * float(known[0]), delta=1e-6)
            self.assertAlmostEqual(float(row[column]), float(known[own]), delta=1e-6)
        name, data = self.saved(figure, "SVG")
        self.assertEqual(name, "top_velocity.svg")
        root = xml.etree.ElementTree.fromstring(data)
        texts = [e.text for e in root.iter("{http://www.w3.org/2000/svg}text")]
        self.assertIn("velocity [m/s]", texts)
        self.assertGreater(len(list(root.iter("{http://www.w3.org/2000/svg}path"))), 10)
        name, data = self.saved(figure, "PNG")
        self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
        # A curve that is switched off is not saved.
        button = figure.find_element(By.CSS_SELECTOR, ".legend button")
        gone = button.text
        button.click()
        _, data = self.saved(figure, "CSV")
        self.assertNotIn(gone, [title.split(" [")[0] for title in next(csv.reader(io.StringIO(data.decode())))])

    def test_plots_are_saved_and_keep_their_colours(self):
        case = pathlib.Path(__file__).parents[2] / "cases/impact_bar/central_differences.toml"
        subprocess.run([CAROM, "compare", case, "--scheme", "central_differences", "newmark", "--cells", "20", "40", "--out",
                        self.folder / "compared", "--quiet"], check=False, capture_output=True)
        open_report(self.driver, self.folder / "compared/compare.html")
        figure = self.figure("Convergence with the mesh")
        name, data = self.saved(figure, "CSV")
        self.assertEqual(name, "Convergence_with_the_mesh.csv")
        rows = list(csv.reader(io.StringIO(data.decode())))
        self.assertEqual(rows[0][:2], ["curve", "cells along the longest edge"])
        self.assertEqual({(row[0], row[1]) for row in rows[1:]}, {(s, c) for s in ("central_differences", "newmark") for c in ("20", "40")})
        _, data = self.saved(figure, "SVG")
        root = xml.etree.ElementTree.fromstring(data)
        paths = [e for e in root.iter("{http://www.w3.org/2000/svg}path")]
        self.assertTrue(all(e.get("stroke", "").startswith("rgb") for e in paths), "colours are there without the page's style")
        self.assertIn("Convergence with the mesh", [e.text for e in root.iter("{http://www.w3.org/2000/svg}text")])
        self.assertEqual(self.saved(figure, "PNG")[1][:4], b"\x89PNG")
        # A scheme has one colour, in plots and in curves.
        colours = self.driver.execute_script("""
            const found = {};
            for (const entry of document.querySelectorAll(".legend :is(span, button)")) {
              const scheme = entry.textContent.split(/[,:]/)[0], line = entry.querySelector("svg, i");
              const colour = getComputedStyle(line)[line.matches("i") ? "borderTopColor" : "stroke"];
              (found[scheme] = found[scheme] || new Set()).add(colour.match(/[0-9]+/g).slice(0, 3).join());
            }
            return Object.fromEntries(Object.entries(found).map(([name, set]) => [name, [...set]]));""")
        for scheme in ("central_differences", "newmark"):
            self.assertEqual(len(colours[scheme]), 1, colours)
        self.assertNotEqual(colours["central_differences"], colours["newmark"])

    def test_a_page_that_is_open_is_printed_to_the_size_of_the_paper(self):
        with browser(1400, 1000, dark=True) as driver:
            open_report(driver, self.folder / "bar_20/report.html")
            driver.execute_script("""
                window.sizes = () => [...document.querySelectorAll("[data-chart] canvas, .stage canvas")].map((c) => [c.clientWidth, c.parentElement.clientWidth]);
                window.addEventListener("beforeprint", () => (window.printed = [window.sizes(), getComputedStyle(document.body).backgroundColor]));
                window.before = window.sizes();""")
            driver.execute_cdp_cmd("Page.printToPDF", {})
            sizes, background = wait_for(driver, "window.printed")
            paper = 18 / 2.54 * 96  # 18 cm
            for own, around in sizes:
                self.assertEqual(own, around)
                self.assertLess(own, paper)
                self.assertGreater(own, 0.9 * paper)
            self.assertEqual(background, "rgb(251, 251, 250)")
            self.assertEqual(driver.execute_script("return window.sizes()"), driver.execute_script("return window.before"))

    def test_long_pages_say_what_is_on_them(self):
        open_report(self.driver, self.folder / "bar_20/report.html")
        links = self.driver.find_elements(By.CSS_SELECTOR, ".contents a")
        self.assertEqual([link.text for link in links], [h.text for h in self.driver.find_elements(By.CSS_SELECTOR, "main h2")])
        links[-1].click()
        self.assertGreater(self.driver.execute_script("return window.scrollY"), 500)

    def test_largest_values(self):
        open_report(self.driver, self.folder / "bar_20/report.html")
        rows = [[cell.text for cell in row.find_elements(By.TAG_NAME, "td")] for row in self.driver.find_elements(
            By.XPATH, "//section[h2='Largest values']//tbody/tr")]
        found = {(row[0], row[3].split(":")[0]): row for row in rows}
        table = self.table("bar_20/contact.csv")
        force = [table[0].index(f"wall.force_{c}") for c in "xyz"]
        largest = max(sum(float(row[k]) ** 2 for k in force) ** 0.5 for row in table[1:])
        self.assertEqual(found[("force", "wall")][1], f"{largest / 1000:.4g} kN")
        self.assertIn(("penetration", "wall"), found)
        self.assertIn(("velocity", "top"), found)
        self.assertIn(("von Mises stress", "bar"), found)

    def test_two_runs_on_one_page(self):
        page = self.folder / "both.html"
        subprocess.run([CAROM, "report", self.folder / "bar_10", self.folder / "bar_20", "--out", page], check=True,
                       stdout=subprocess.DEVNULL)
        self.assertLess(page.stat().st_size, 6_000_000)
        open_report(self.driver, page)
        links = [a.get_attribute("href") for a in self.driver.find_elements(By.CSS_SELECTOR, "td a")]
        self.assertEqual([link.split("/")[-2:] for link in links], [["bar_10", "report.html"], ["bar_20", "report.html"]])
        names = [b.text for b in self.figure("top · velocity").find_elements(By.CSS_SELECTOR, ".legend button")]
        self.assertTrue({"bar_10: z", "bar_20: z"} <= set(names), names)
        views = self.driver.find_elements(By.CSS_SELECTOR, ".view")
        self.assertEqual(len(views), 2)
        # One time, one direction, one quantity in one range of colours.
        self.driver.execute_script("carom.show(5e-5)")
        self.assertEqual(len({v.find_element(By.CSS_SELECTOR, ".clock").text.split()[-1] for v in views}), 1)
        Select(views[0].find_element(By.XPATH, ".//select[@title='What the colours show']")).select_by_visible_text("velocity z")
        legends = [[b.text for b in v.find_elements(By.CSS_SELECTOR, ".colours strong, .colours b")] for v in views]
        self.assertEqual(legends[0], legends[1])
        self.assertEqual(legends[0][0], "velocity z [m/s]")
        canvas = views[1].find_element(By.CSS_SELECTOR, "canvas")
        before = picture(self.driver, canvas)
        views[0].find_element(By.XPATH, ".//button[text()='x']").click()
        self.assertNotEqual(picture(self.driver, canvas)["hash"], before["hash"])

    def test_runs_in_other_units_and_other_folders_are_refused(self):
        case = self.write_case("bar_mm", 10, 1e-5)
        case.write_text(case.read_text(encoding="utf-8").replace('"SI"', '"mm-t-s"'), encoding="utf-8")
        subprocess.run([CAROM, "run", case, "--out", self.folder / "bar_mm", "--quiet"], check=False, capture_output=True)
        for folders, words in ((("bar_10", "bar_mm"), "units"), (("none",), "no such folder"), ((".",), "energy.csv")):
            done = subprocess.run([CAROM, "report", *(self.folder / f for f in folders)], capture_output=True, text=True,
                                  check=False, cwd=self.folder)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(words, done.stderr)

    def test_a_broken_run_has_its_report(self):
        folder = self.folder / "broken"
        self.run_case("broken", 10, 1e-4)
        (folder / "summary.json").unlink()
        text = (folder / "energy.csv").read_text(encoding="utf-8")
        (folder / "energy.csv").write_text(text[:len(text) * 2 // 3], encoding="utf-8")
        frames = sorted((folder / "fields").glob("step_*.vtkhdf"))
        frames[-1].write_bytes(frames[-1].read_bytes()[:1000])
        subprocess.run([CAROM, "report", folder], check=True, stdout=subprocess.DEVNULL)
        open_report(self.driver, folder / "report.html")
        self.assertIn("No verdict", self.driver.find_element(By.CSS_SELECTOR, ".banner").text)
        self.assertIn("No view of the bodies", self.driver.find_element(By.CSS_SELECTOR, ".notes").text)
        self.assertTrue(self.driver.find_elements(By.CSS_SELECTOR, "[data-chart] canvas"))

    def test_a_run_is_watched_to_its_end(self):
        folder = self.folder / "long"
        run = subprocess.Popen([CAROM, "run", self.write_case("long", 400, 1.0), "--out", folder, "--quiet"])
        try:
            end = time.monotonic() + PATIENCE
            while not (folder / "energy.csv").exists() and time.monotonic() < end:
                time.sleep(0.1)
            watch = subprocess.Popen([CAROM, "watch", folder, "--every", "1"], stdout=subprocess.PIPE, text=True)
            while not (folder / "watch.html").exists() and time.monotonic() < end:
                time.sleep(0.1)
            self.driver.get(f"file://{folder}/watch.html")
            # The page reads itself again every second: what is looked at is read within one script, never kept between two.
            wait_for(self.driver, "document.querySelector('.banner strong')?.textContent === 'Running'")
            self.assertRegex(wait_for(self.driver, "[document.querySelector('.progress span')?.textContent ?? '']"
                                                   ".filter((text) => text.includes('left'))[0]"),
                             r"^t = .* of 1 s, \d+ % of the time, about .* left$")
            wait_for(self.driver, "document.querySelectorAll('[data-chart] canvas').length > 2")
            # The next reading keeps what is zoomed and what is hidden.
            wait_for(self.driver, ZOOM_AND_HIDE)
            wait_for(self.driver, "!window.isOld && document.querySelector('.legend button')?.getAttribute('aria-pressed') === 'false' && "
                                  "!['', '0'].includes(document.querySelector('.dygraph-axis-label-x')?.textContent ?? '')")
            run.send_signal(signal.SIGTERM)
            run.wait(PATIENCE)
            said, _ = watch.communicate(timeout=PATIENCE)
            self.assertEqual(watch.returncode, 0)
            self.assertIn("the run has ended", said)
            wait_for(self.driver, "location.pathname.endsWith('report.html')")
        finally:
            run.kill()
            run.wait()
        done = subprocess.run([CAROM, "watch", folder], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, bool(re.search("has ended", done.stdout))), (0, True))


if __name__ == "__main__":
    CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
