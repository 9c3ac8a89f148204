"""tools/check_names.py finds names and files that pages of docs/ tell of and the code does not have."""

import unittest

from tool_test import ToolTest

HEAD = "| type | stands in | what it is |\n|---|---|---|\n"


class CheckNames(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("src/march/march.hpp", "class March {\n  void make_step();\n};\n")

    def test_a_page_that_is_true(self):
        self.write("docs/page.md", HEAD + "| `March`, `March::make_step` | `march/march.hpp` | steps |\n"
                   "\n| type | file |\n|---|---|\n| `Nobody` | `nowhere.hpp` |\n")
        self.assertEqual(self.run_tool("check_names.py")[0], 0)

    def test_names_and_files_that_have_gone(self):
        self.write("docs/page.md", "# Page\n\n" + HEAD + "| `March::make` | `march/march.hpp` | a part of a word |\n"
                   "| `March` | `run/march.hpp` | has moved |\n| `March` | march | names no file |\n")
        self.assertEqual(self.run_tool("check_names.py"),
                         (1, "docs/page.md:5: src/march/march.hpp has no make\n"
                             "docs/page.md:6: no such file: src/run/march.hpp\n"
                             "docs/page.md:7: no such file: src/\n"))

    def test_a_folder_that_the_map_leaves_out(self):
        self.write("docs/map.md", HEAD + "| `March` | `march/march.hpp` | steps |\n")
        self.assertEqual(self.run_tool("check_names.py")[0], 0)
        self.write("src/rows/row.hpp", "struct Row {};\n")
        self.assertEqual(self.run_tool("check_names.py"), (1, "docs/map.md: nothing of src/rows\n"))


if __name__ == "__main__":
    unittest.main()
