"""tools/mutants.py finds operators and constants with their operands, leaves alone what is no code that runs, and
writes sources in which one mutant at a time can be switched on; tools/mutate.py chooses tests and takes out what does
not compile."""

import json
import os
import random
import subprocess
import unittest

from tool_test import TOOLS, ToolTest

import sys

sys.path.insert(0, str(TOOLS))
import mutants  # noqa: E402
import mutate  # noqa: E402


def found(text, kind=None):
    """(before, after) of the mutants of a source, or of one kind of them."""
    all_of_it = mutants.Source("src/a/a.cpp", text).mutants(random.Random(1))
    return [(" ".join(mutant.before.split()), mutant.after) for mutant in all_of_it if kind in (None, mutant.kind)]


def body(statement):
    return "int f(int a, int b, int c) {\n  " + statement + "\n}\n"


class Places(unittest.TestCase):
    def test_operands_by_precedence(self):
        text = body("return a - b + c * d[i - 1] < g(x, y);")
        self.assertEqual(found(text, "+"), [("a - b + c * d[i - 1]", "a - b - c * d[i - 1]")])
        self.assertEqual(found(text, "*"), [("c * d[i - 1]", "c / d[i - 1]")])
        self.assertEqual([before for before, _ in found(text, "<")], ["a - b + c * d[i - 1] < g(x, y)"])
        self.assertIn(("i - 1", "i + 1"), found(text, "-"))

    def test_signs_belong_to_operands(self):
        self.assertEqual(found(body("return -a * !b;")), [("-a * !b", "-a / !b")])

    def test_logic_and_conditions(self):
        text = body("if (a == b && b < c || !c) return x ? a : b;")
        self.assertEqual(found(text, "||"), [("a == b && b < c || !c", "a == b && b < c && !c")])
        self.assertEqual(found(text, "&&"), [("a == b && b < c", "a == b || b < c")])
        self.assertEqual(found(text, "=="), [("a == b", "a != b")])

    def test_lines_of_operands(self):
        text = body("return a +\n      b;")
        mutant = mutants.Source("src/a/a.cpp", text).mutants(random.Random(1))[0]
        mutant.number = 7
        written = mutants.write_in(text, [mutant])
        self.assertEqual(written.count("\n"), text.count("\n"))
        self.assertIn("(mutants::on(7) ? (a - b) : (a + b))", written)

    def test_constants(self):
        self.assertEqual(found(body("x = 0;")), [("0", "1")])
        self.assertEqual(found(body("x = 0.5;")), [("0.5", "1.0")])
        self.assertEqual(found(body("x = 1e-12;")), [("1e-12", "1e-09")])
        self.assertIn(found(body("x = 7u;")), ([("7u", "6u")], [("7u", "8u")]))
        self.assertEqual(found(body("x = 0x1f;")), [])

    def test_what_is_left_alone(self):
        for statement in ('throw E("a" + b, 2);', "constexpr int n = 2 * m;", "static_assert(n == 2);", "case 3: f();",
                          "std::array<double, 3> x;", "using T = A<B, 2>;", "// a + b", "const int n = 3;",
                          "f(A<m + 1>());", "assert(a + b == 1);", "const Vec3 x{1.0, 0.0, 0.0};"):
            self.assertEqual(found(body(statement)), [], statement)
        self.assertEqual(found("const double x = 2.0 * y;\nstruct S { int n = 2; };\n#define X 1 + 2\n"), [])
        self.assertEqual(found("constexpr int f(int a) { return a + 1; }\n"), [])


class Drawing(unittest.TestCase):
    def test_folders_by_their_lines(self):
        sources = {"src/a/a.cpp": body("x = 1;\n" * 40), "src/b/b.cpp": body("x = 1;\n" * 10)}
        drawn = mutants.draw(sources, 10, random.Random(3))
        self.assertEqual(sorted(mutant.file for mutant in drawn), ["src/a/a.cpp"] * 8 + ["src/b/b.cpp"] * 2)
        self.assertEqual([mutant.number for mutant in drawn], list(range(1, 11)))
        self.assertEqual(drawn, mutants.draw(sources, 10, random.Random(3)))

    def test_none_within_another(self):
        drawn = mutants.draw({"src/a/a.cpp": body("return a + b * c;")}, 5, random.Random(1))
        self.assertEqual(len(drawn), 1)

    def test_places_that_the_compiler_names(self):
        drawn = mutants.draw({"src/a/a.cpp": body("x = 1;\n  y = 2;\n  z = 3;")}, 3, random.Random(1))
        output = "src/a/a.cpp:2:3: note: here\n../tree/src/a/a.cpp:3:4: error: no match\nsrc/b/b.cpp:4:1: error: no\n"
        self.assertEqual(mutate.guilty(output, drawn), {mutant.number for mutant in drawn if mutant.line == 3})
        beside = mutate.guilty("src/a/a.cpp:2:3: note: here\n", drawn)
        self.assertEqual(beside, {mutant.number for mutant in drawn if mutant.line == 2})


class Running(ToolTest):
    def test_one_mutant_at_a_time(self):
        text = '#include <cstdio>\nint f(int a, int b) { return a - b; }\nint main() { return f(5, 2); }\n'
        drawn = [m for m in mutants.Source("src/a/a.cpp", text).mutants(random.Random(1)) if m.kind == "-"]
        drawn[0].number = 9
        source = self.write("a.cpp", mutants.write_in(text, drawn))
        program = self.root / "a"
        header = TOOLS.parent / "tests/mutation/mutants.hpp"
        subprocess.run(["g++", "-std=c++20", "-include", header, source, "-o", program], check=True)
        shared = self.write("reached", "\0" * 4096)
        for number, code in (("0", 3), ("8", 3), ("9", 7)):
            chosen = {**os.environ, "MUTANT": number, "MUTANTS_REACHED": str(shared)}
            done = subprocess.run([program], env=chosen, check=False)
            self.assertEqual(done.returncode, code)
        self.assertEqual([number for number, byte in enumerate(shared.read_bytes()) if byte], [9])

    def test_tests_of_the_folder_then_quick_ones(self):
        tests = {"run_tests:A.Quick": {"program": "run_tests", "seconds": 0.1, "reached": {1}},
                 "run_tests:A.Slow": {"program": "run_tests", "seconds": 50.0, "reached": {1}},
                 "math_tests:B.Own": {"program": "math_tests", "seconds": 3.0, "reached": {1, 2}},
                 "math_tests:B.Other": {"program": "math_tests", "seconds": 3.0, "reached": {2}}}
        todo, reaching = mutate.batches(1, "src/math/a.cpp", tests, 10.0)
        self.assertEqual(todo, [("math_tests", ["B.Own"], 3.0), ("run_tests", ["A.Quick"], 0.1)])
        self.assertEqual(reaching, 3)

    def test_long_tests_are_left_out(self):
        filtered = {"name": "sanitize", "filter": {"exclude": {"name": "LongOne|^Threads[.]"}}}
        self.write("CMakePresets.json", json.dumps({"testPresets": [{"name": "release"}, filtered]}))
        self.assertEqual(mutate.long_ones(self.root), ["*LongOne*"])

    def test_groups_of_tests(self):
        self.write("tests/unit/CMakeLists.txt", "# carom_tests(group folder...)\ncarom_tests(run run driver)\n")
        self.assertEqual(mutate.groups(self.root), {"run": ["run", "driver"]})


if __name__ == "__main__":
    unittest.main()
