"""tools/check_links.py finds dead links between pages and leaves other sites alone."""

import unittest

from tool_test import ToolTest


class CheckLinks(ToolTest):
    def test_links(self):
        self.write("docs/other.md", "\n")
        self.write("README.md", "[a](docs/other.md#part) [b](https://example.org/none) ![c](docs)\n")
        self.assertEqual(self.run_tool("check_links.py")[0], 0)
        self.write("docs/page.md", "\n[back](../README.md) [gone](other/gone.md)\n")
        code, output = self.run_tool("check_links.py")
        self.assertEqual((code, output), (1, "docs/page.md:2: dead link: other/gone.md\n"))


if __name__ == "__main__":
    unittest.main()
