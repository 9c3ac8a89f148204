"""tests/pages/run_page.py fails where a page is wrong."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "pages"))
from run_page import PageError, do_page  # noqa: E402

CASE = """```toml title="a/case.toml"
title = "one"

[scheme]
kind = "statics"

[time]
end = 1.0
```
"""


class RunPage(unittest.TestCase):
    def do(self, text):
        """Does a page; `carom` is a program that prints the file it is given."""
        with tempfile.TemporaryDirectory() as folder:
            do_page(text, pathlib.Path("/bin/cat"), pathlib.Path(folder))

    def fails(self, text, message):
        with self.assertRaisesRegex(PageError, message):
            self.do(text)

    def test_commands_end_as_the_page_says(self):
        self.do(CASE + "```sh\ncd a\ncarom case.toml\nfalse # exit code 1\n```\n")
        self.fails(CASE + "```sh\ncarom case.toml\n```\n", "ends with 1, not 0")
        self.fails(CASE + "```sh\ntrue # exit code 2\n```\n", "ends with 0, not 2")

    def test_what_commands_say(self):
        run = CASE + "```sh\ncarom a/case.toml\n```\n"
        self.do(run + "```text\nend = 2.5e-3\n...\n```\n")
        self.fails(run + "```text\nend of it\n```\n", "nothing has said\nend of it")

    def test_sections_are_added_and_replaced(self):
        self.do(CASE + '```toml title="a/case.toml, in place of [scheme]"\n[scheme]\nkind = "newmark"\n```\n'
                '```toml title="a/case.toml, added"\n[output]\n```\n'
                "```sh\ngrep newmark a/case.toml\ngrep statics a/case.toml # exit code 1\ngrep output a/case.toml\ngrep end a/case.toml\n```\n")
        self.fails(CASE + '```toml title="a/case.toml, in place of [mesh]"\n[mesh]\n```\n```sh\ntrue\n```\n', "is not there once")

    def test_lines_of_a_file(self):
        quoted = '```toml title="a/case.toml, lines of it"\n[time]\nend = {}\n```\n```sh\ntrue\n```\n'
        self.do(CASE + quoted.format("1.0"))
        self.fails(CASE + quoted.format("2.0"), "has not the lines")

    def test_blocks_that_nothing_would_test(self):
        self.fails("```toml\nkey = 1\n```\n```sh\ntrue\n```\n", "without the name of a file")
        self.fails("```\ncarom run\n```\n```sh\ntrue\n```\n", "without a language")
        self.fails("# A page\n", "no commands")


if __name__ == "__main__":
    unittest.main()
