#!/usr/bin/python3
"""Manual page and completions know every command and option that the program has.

Usage: command_pages_test.py CAROM
"""

import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parent.parent.parent / "tools/command_pages.py"


def help_of(*words):
    return subprocess.run([CAROM, *words, "--help"], capture_output=True, text=True, check=True).stdout


class CommandPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run(["/usr/bin/python3", TOOL, CAROM, cls.folder.name], check=True)
        read = lambda name: (pathlib.Path(cls.folder.name) / name).read_text(encoding="utf-8")
        cls.manual, cls.bash, cls.zsh = read("carom.1"), read("carom.bash"), read("_carom")
        listed = help_of().split("Subcommands:\n")[1].split("\n\n")[0]
        cls.commands = [line.split()[0] for line in listed.splitlines() if re.match(r"^  \S", line)]
        cls.options = {command: set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", help_of(command), re.MULTILINE))
                       for command in cls.commands}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def complete(self, *words):
        """What bash offers for the last of these words."""
        script = f'source {self.folder.name}/carom.bash; COMP_WORDS=({" ".join(words)}); COMP_CWORD={len(words) - 1}; _carom; ' \
                 'printf "%s\\n" "${COMPREPLY[@]}"'
        return subprocess.run(["/bin/bash", "-c", script], capture_output=True, text=True, check=True).stdout.split()

    def test_manual(self):
        self.assertIn("run", self.commands)
        for command, options in self.options.items():
            self.assertIn(f".SS carom {command} ", self.manual.replace("\\-", "-"))
            for option in options - {"--help"}:
                self.assertIn(f"\\fB{option}".replace("-", "\\-"), self.manual)
        for code in range(4):
            self.assertIn(f"\\fB{code}\\fR", self.manual)

    def test_bash(self):
        self.assertEqual(set(self.complete("carom", "--")), {"--help", "--version"})
        self.assertTrue(set(self.commands) <= set(self.complete("carom", "''")))
        for command, options in self.options.items():
            self.assertTrue(options <= set(self.complete("carom", command, "--")), command)

    def test_zsh(self):
        for command, options in self.options.items():
            self.assertIn(f"  {command}) _arguments", self.zsh)
            for option in options:
                self.assertIn(f"'{option}[", self.zsh)


if __name__ == "__main__":
    CAROM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
