"""tools/manual.py: what becomes of pages and links, and that it sees what is wrong with a site."""

import pathlib
import sys
import unittest

from tool_test import TOOLS, ToolTest

sys.path[:0] = [str(TOOLS), str(TOOLS / "manual")]
import manual  # noqa: E402
from pages import ManualError, Pages, names_in, with_wide_lists  # noqa: E402

HOME = """# Home

## Reference

- [Format](format.md): all keys
- [Decisions](decisions)
- [Read me](../README.md)
"""


class Manual(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("docs/README.md", HOME)
        self.write("docs/format.md", "# Format\n\nSee [a case](../cases/a.toml), [all of them](../cases), [top](README.md#home).\n")
        self.write("docs/decisions/0001-a.md", "# 0001: A\n")
        self.write("README.md", "# Read me\n\n[![picture](docs/images/a.png)](docs/format.md)\n")
        self.write("docs/images/a.png", "")
        self.write("cases/a.toml", "title = \"a\"\n")

    def test_pages_and_links(self):
        out = self.root / "out"
        Pages(self.root).write(out)
        self.assertEqual((out / "format.md").read_text(),
                         "# Format\n\nSee [a case](cases/a.toml.md), all of them, [top](index.md#home).\n")
        self.assertIn("[![picture](images/a.png)](format.md)", (out / "overview.md").read_text())
        self.assertIn("````toml\ntitle = \"a\"\n````", (out / "cases/a.toml.md").read_text())
        self.assertIn("- [0001: A](0001-a.md)", (out / "decisions/index.md").read_text())
        self.assertTrue((out / "images/a.png").is_file())

    def test_the_first_page_is_the_navigation(self):
        found = Pages(self.root).navigation()
        self.assertEqual(found, [{"Start": "index.md"}, {"Reference": [
            {"Format": "format.md"}, {"Decisions": ["decisions/index.md", {"0001: A": "decisions/0001-a.md"}]},
            {"Read me": "overview.md"}]}])
        self.assertEqual(names_in(found), {"index.md", "format.md", "decisions/index.md", "decisions/0001-a.md", "overview.md"})

    def test_a_link_to_nowhere(self):
        self.write("docs/format.md", "# Format\n\n[gone](gone.md)\n")
        with self.assertRaisesRegex(ManualError, r"^docs/format.md: dead link: gone.md$"):
            Pages(self.root)

    def test_a_page_that_nothing_leads_to(self):
        self.write("docs/lost.md", "# Lost\n")
        with self.assertRaisesRegex(ManualError, "leads to none of lost.md"):
            manual.make(self.root, self.root / "out" / "manual")

    def test_links_in_blocks_of_code_are_text(self):
        self.write("docs/format.md", "# Format\n\n```toml title=\"a.toml, lines of it\"\n[gone](gone.md)\n```\n")
        Pages(self.root).write(self.root / "out")
        self.assertIn("```toml title=\"a.toml\"\n[gone](gone.md)\n```", (self.root / "out" / "format.md").read_text())

    def test_lists(self):
        self.assertEqual(with_wide_lists("Text:\n- a\n  more\n\n  second\n- b\n\nText\n"),
                         "Text:\n\n- a\n    more\n\n    second\n\n- b\n\nText\n")

    def test_offences_of_a_site(self):
        self.write("site/a.html", '<h1 id="top">A</h1><a href="b.html#there">b</a><a href="#top">top</a>')
        self.write("site/b.html", '<h1 id="there">B</h1><a href="a.html">a</a>')
        self.assertEqual(manual.offences(self.root / "site"), [])
        self.write("site/b.html", '<a href="c.html">c</a><script src="https://example.org/x.js"></script>')
        self.assertEqual(manual.offences(self.root / "site"),
                         ["a.html: no such heading: b.html#there", "b.html: dead link: c.html",
                          "b.html: needs the network: https://example.org/x.js"])


class TheManualOfTheRepository(unittest.TestCase):
    def test_every_page_is_in_its_navigation(self):
        pages = Pages(pathlib.Path(TOOLS).parent)
        self.assertEqual(manual.absent(pages), [])


if __name__ == "__main__":
    unittest.main()
