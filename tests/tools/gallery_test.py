"""The gallery shows cases that are there, and its page in docs/ is of the same cases."""

import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))
import case_runs  # noqa: E402
import gallery  # noqa: E402


class Gallery(unittest.TestCase):
    def test_its_cases_are_there(self):
        for name, _, _ in gallery.PICTURES:
            self.assertTrue((ROOT / case_runs.file_of(name)).exists(), name)
        shown = {name for name, _, _ in gallery.PICTURES}
        for path in (ROOT / "examples/gallery").glob("*.toml"):
            self.assertIn(f"gallery/{path.stem}", shown)

    def test_its_page_is_of_the_same_cases(self):
        page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
        self.assertEqual(re.findall(r"(?m)^carom init mine --like (\S+)$", page), [name for name, _, _ in gallery.PICTURES])


if __name__ == "__main__":
    unittest.main()
