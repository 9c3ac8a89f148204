"""tools/check_words.py finds machine paths and registry addresses, and passes ordinary text."""

import subprocess
import unittest

from tool_test import ToolTest


class CheckWords(ToolTest):
    def assert_offence(self, line):
        self.write("docs/page.md", "first\n" + line + "\n")
        code, output = self.run_tool("check_words.py")
        self.assertEqual(code, 1, line)
        self.assertIn("docs/page.md:2: ", output)

    def test_passes_ordinary_text(self):
        self.write("a.md", "cases/sdnv100, /usr/bin/python3, /dev/full, force/wor" + "k/energy, https://www.gnu.org/licenses/\n")
        self.assertEqual(self.run_tool("check_words.py")[0], 0)

    def test_machine_paths(self):
        for folder in ("work", "root", "home", "tmp", "var/tmp"):
            self.assert_offence(f"see /{folder}/someone/mesh.med")
            self.assert_offence(f'path = "/{folder}/x"')

    def test_registry_addresses(self):
        for host in ("pypi." + "org", "registry.npm" + "js.org", "deb.debian." + "org"):
            self.assert_offence(f"https://{host}/thing")

    def test_looks_at_what_git_lists(self):
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write(".gitignore", "build\n")
        self.write("build/log", "/hom" + "e/someone\n")
        self.assertEqual(self.run_tool("check_words.py")[0], 0)
        self.write("notes.txt", "/hom" + "e/someone\n")
        self.assertEqual(self.run_tool("check_words.py")[0], 1)


if __name__ == "__main__":
    unittest.main()
