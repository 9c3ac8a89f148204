"""tools/verify keeps a stamp of each good case, tries failed ones again and writes the page."""

import json
import os
import shutil
import subprocess
import unittest

from tool_test import TOOLS, ToolTest

PROGRAM = """#!/bin/sh
# stands for carom: counts its runs; fails for the case named bad
mkdir -p "$4"
echo "$2" >>runs.log
case $2 in *bad*) pass=false ;; *) pass=true ;; esac
echo "{\\"checks\\": [{\\"pass\\": true}, {\\"pass\\": $pass}]}" >"$4/summary.json"
$pass
"""


class Verify(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("tests/verification/cases.txt", "# table\ncases/a/good.toml  closes\ncases/a/bad.toml  does not\n")
        self.write("docs/index.md", "\n")
        self.write("src/x.cpp", "int x;\n")
        self.write(".gitignore", "build\nruns.log\n")
        self.write("build/release/carom", PROGRAM).chmod(0o755)
        self.write("tools/x", "")
        shutil.copy(TOOLS / "verify", self.root / "tools/verify")
        for arguments in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "first"]):
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *arguments], cwd=self.root,
                           check=True)

    def verify(self):
        return subprocess.run(["/usr/bin/python3", "tools/verify"], cwd=self.root, capture_output=True, check=False,
                              env=os.environ).returncode

    def runs(self):
        return [line.split("/")[-1] for line in (self.root / "runs.log").read_text().split()]

    def test_stamps_and_page(self):
        self.assertEqual(self.verify(), 1)
        self.assertEqual(self.runs(), ["good.toml", "bad.toml"])
        page = (self.root / "docs/verification.md").read_text()
        self.assertRegex(page, r"\| `cases/a/good.toml` \| closes \| good \| 2 of 2 \|")
        self.assertRegex(page, r"\| `cases/a/bad.toml` \| does not \| check failed \| 1 of 2 \|")
        self.assertEqual(self.verify(), 1)
        self.assertEqual(self.runs(), ["good.toml", "bad.toml", "bad.toml"])

    def test_changed_sources_run_again(self):
        self.verify()
        self.write("src/x.cpp", "int y;\n")
        self.verify()
        self.assertEqual(self.runs().count("good.toml"), 2)

    def test_stamps_are_json(self):
        self.verify()
        stamp, = (self.root / "build/verify").glob("*/cases_a_good_toml.json")
        self.assertEqual(json.loads(stamp.read_text())["result"], "good")


if __name__ == "__main__":
    unittest.main()
