"""tools/docs.py puts the pages that tests have written where the repository has them."""

import subprocess
import unittest

from tool_test import TOOLS, ToolTest

# A test program as tools/docs.py sees it: it fails where the page differs, and leaves the right one.
PROGRAM = """#!/bin/sh
[ "$1" = "--gtest_filter=*InTheRepositoryIsCurrent" ] || exit 2
printf 'as the code says\\n' > "$TEST_TMPDIR"format.md
if cmp -s "$TEST_TMPDIR"format.md {page}; then rm "$TEST_TMPDIR"format.md; else echo 'not current'; exit 1; fi
"""


class Docs(ToolTest):
    def docs(self, text):
        program = self.write("tests/program", text)
        program.chmod(0o755)
        done = subprocess.run(["/usr/bin/python3", TOOLS / "docs.py", "--root", self.root, program],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_writes_what_differs(self):
        page = self.write("docs/format.md", "as it was\n")
        program = PROGRAM.format(page=page)
        self.assertEqual(self.docs(program), (0, "docs: written: format.md\n"))
        self.assertEqual(page.read_text(), "as the code says\n")
        self.assertEqual(self.docs(program), (0, "docs: all pages are current\n"))

    def test_a_test_that_goes_on_failing(self):
        self.write("docs/format.md", "as it was\n")
        code, output = self.docs(PROGRAM.format(page=self.root / "elsewhere.md"))
        self.assertEqual((code, output), (1, "docs: written: format.md\nnot current\n"))


if __name__ == "__main__":
    unittest.main()
