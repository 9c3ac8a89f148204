"""tools/check_sizes.py measures functions and files, and fails above their limits (C++ functions 100 lines,
files 600, of JavaScript 300)."""

import unittest

from tool_test import TOOLS, ToolTest

import sys

sys.path.insert(0, str(TOOLS))
import check_sizes  # noqa: E402


def function(lines):
    """Source of a function that spans `lines` lines."""
    return "int f(int x) {\n" + "  x += 1;\n" * (lines - 2) + "}\n"


class CheckSizes(ToolTest):
    def lengths(self, text):
        return [length for _, length, _ in check_sizes.functions(text)]

    def test_limit_of_functions(self):
        self.write("src/a/a.cpp", function(100))
        self.assertEqual(self.run_tool("check_sizes.py")[0], 0)
        self.write("src/a/a.cpp", "// first line\n" + function(101))
        code, output = self.run_tool("check_sizes.py")
        self.assertEqual(code, 1)
        self.assertIn("src/a/a.cpp:2: function of 101 lines, more than 100: int f(int x)", output)

    def test_limit_of_files(self):
        self.write("src/a/a.hpp", "int x;\n" * 600)
        self.assertEqual(self.run_tool("check_sizes.py")[0], 0)
        self.write("tools/a.py", "x = 1\n" * 601)
        code, output = self.run_tool("check_sizes.py")
        self.assertEqual(code, 1)
        self.assertIn("tools/a.py: 601 lines, more than 600", output)

    def test_limit_of_scripts(self):
        self.write("src/a/a.js", "f();\n" * 300)
        self.assertEqual(self.run_tool("check_sizes.py")[0], 0)
        self.write("src/a/a.js", "f();\n" * 301)
        code, output = self.run_tool("check_sizes.py")
        self.assertEqual(code, 1)
        self.assertIn("src/a/a.js: 301 lines, more than 300", output)

    def test_tables_apart(self):
        self.write("src/a/quadrature_tables.cpp", "int x;\n" * 700)
        self.assertEqual(self.run_tool("check_sizes.py")[0], 0)

    def test_constructor_with_initialisers_and_defaults(self):
        self.assertEqual(self.lengths("namespace n {\nA::A(int a, B b = {})\n    : a_{a}, b_(b) {\n  go();\n}\n}\n"), [4])

    def test_types_tables_and_lambdas_are_no_functions(self):
        text = """struct S {
  int x = 0;
  std::array<int, 2> y{1, 2};
  int get() const { return x; }
};
constexpr int kTable[] = {1, 2,
                          3};
const auto twice = [](int x) {
  return 2 * x;
};
enum class E { a, b };
"""
        self.assertEqual(self.lengths(text), [1])

    def test_braces_in_strings_and_comments(self):
        self.assertEqual(self.lengths('void f() {\n  g("}", \'}\', R"(})");  // }\n  /* } */\n}\n'), [4])

    def test_nested_blocks_count_once(self):
        self.assertEqual(self.lengths("template <class T>\nvoid f(T t) {\n  if (t) {\n    h([&] { t(); });\n  }\n}\n"), [6])

    def test_percentile(self):
        self.assertEqual(check_sizes.percentile(range(1, 11), 0.9), 9)
        self.assertEqual(check_sizes.percentile([7], 0.9), 7)
        self.assertEqual(check_sizes.percentile([], 0.9), 0)


if __name__ == "__main__":
    unittest.main()
