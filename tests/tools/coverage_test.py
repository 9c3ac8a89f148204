"""tools/coverage.py counts what a program ran, by folder, names what it did not enter, and fails below its bound."""

import subprocess
import unittest

from tool_test import TOOLS, ToolTest


class Coverage(ToolTest):
    def setUp(self):
        super().setUp()
        # Of the four lines with code in src/, those of `other` are not run. A template counts once.
        self.write("src/a/twice.hpp", "template <class T>\nT twice(T x) {\n  return x + x;\n}\n")
        self.write("src/b/other.hpp", "inline int other(int x) {\n  return x;\n}\n")
        main = self.write("main.cpp", '#include "src/a/twice.hpp"\n#include "src/b/other.hpp"\n'
                          "int main(int argc, char**) { return argc > 5 ? other(1) + twice(2.5) : twice(0); }\n")
        self.build = self.root / "build"
        self.build.mkdir()
        subprocess.run(["g++", "-O0", "--coverage", main, "-o", "main"], cwd=self.build, check=True)
        subprocess.run([self.build / "main"], cwd=self.build, check=True)

    def coverage(self, bound):
        done = subprocess.run(["/usr/bin/python3", TOOLS / "coverage.py", "--root", self.root, "--build", self.build,
                               "--no-run", "--at-least", str(bound)], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_lines_by_folder(self):
        code, output = self.coverage(50)
        self.assertEqual(code, 0, output)
        self.assertIn("| a | 2 | 2 | 100.0% |\n| b | 2 | 0 | 0.0% |\n| all | 4 | 2 | 50.0% |", output)
        self.assertIn("- `src/b/other.hpp`\n", output)
        self.assertIn("- `src/b/other.hpp:1` `other(int)`\n", output)
        self.assertNotIn("twice", output)

    def test_bound(self):
        code, output = self.coverage(51)
        self.assertEqual(code, 1)
        self.assertIn("coverage: 2 of 4 lines run, 50.0%; below 51 %", output)

    def test_no_counters(self):
        for notes in self.build.glob("*.gcno"):
            notes.unlink()
        code, output = self.coverage(50)
        self.assertEqual(code, 1)
        self.assertIn("coverage: no notes of the compiler", output)


if __name__ == "__main__":
    unittest.main()
