"""tools/check_types.py finds types of one name that stand in several files."""

import unittest

from tool_test import ToolTest


class CheckTypes(ToolTest):
    def test_names_that_are_their_own(self):
        self.write("src/a/one.hpp", "namespace carom {\nstruct Body;\nstruct Body {\n  int a;\n};\n"
                   "}  // namespace carom\n")
        self.write("src/a/two.cpp", "namespace carom {\nnamespace {\nstruct Body {};\n}  // namespace\n"
                   "namespace detail {\nstruct Body {};\n}  // namespace detail\n}  // namespace carom\n")
        self.assertEqual(self.run_tool("check_types.py"), (0, "types: 2 names, each of one type\n"))

    def test_a_name_of_two_types(self):
        self.write("src/a/one.hpp", "namespace carom {\nstruct Body {\n  int a;\n};\n}  // namespace carom\n")
        self.write("src/b/two.hpp", "namespace carom {\n\nclass Body final : public Base {\n};\n"
                   "}  // namespace carom\n")
        self.assertEqual(self.run_tool("check_types.py"),
                         (1, "src/a/one.hpp:2: carom::Body is defined in src/b/two.hpp:3 as well: give one of them "
                             "another name\n"))


if __name__ == "__main__":
    unittest.main()
