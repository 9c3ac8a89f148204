"""tools/check_layers.py finds every kind of forbidden include, and passes allowed ones."""

import unittest

from tool_test import TOOLS, ToolTest


class CheckLayers(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("docs/layers.md", (TOOLS.parent / "docs/layers.md").read_text())
        self.write("src/base/errors.hpp", "#include <string>\n")
        self.write("src/solid/CMakeLists.txt", "carom_library(solid DEPENDS base math mesh\n  LIBRARIES some::library)\n")
        self.write("src/solid/solid.cpp", '#include "solid/mass.hpp"\n#include "base/errors.hpp"\n')
        self.write("src/contact/CMakeLists.txt", "carom_library(contact DEPENDS base)\n")

    def assert_offence(self, text):
        code, output = self.run_tool("check_layers.py")
        self.assertEqual(code, 1)
        self.assertIn(text, output)

    def test_passes_downward_includes(self):
        code, output = self.run_tool("check_layers.py")
        self.assertEqual((code, output), (
            0, "layers: includes point down, no files include each other in a circle, sums are behind parallel\n"))

    def test_upward_include(self):
        self.write("src/base/log.cpp", '\n#include "mesh/mesh.hpp"\n')
        self.assert_offence("src/base/log.cpp:2: base (level 0) may not include mesh (level 4)")

    def test_sideways_include(self):
        self.write("src/surface/facets.hpp", '#include "solid/solid.hpp"\n')
        self.assert_offence("src/surface/facets.hpp:1: surface (level 6) may not include solid (level 6)")

    def test_include_that_cmake_does_not_name(self):
        self.write("src/contact/rows.cpp", '#include "base/errors.hpp"\n#include "mesh/mesh.hpp"\n')
        self.assert_offence("src/contact/rows.cpp:2: contact includes mesh, which its CMakeLists.txt does not name")

    def test_upward_link(self):
        self.write("src/contact/CMakeLists.txt", "carom_library(contact DEPENDS base schemes)\n")
        self.assert_offence("src/contact/CMakeLists.txt: links schemes, which is not below it")

    def test_confined_header(self):
        self.write("src/solid/case.cpp", "#include <toml++/toml.h>\n")
        self.assert_offence("src/solid/case.cpp:1: <toml++/toml.h> belongs behind casefile, not in solid")

    def test_folder_without_level(self):
        self.write("src/misc/a.hpp", "\n")
        self.assert_offence("src/misc: folder without a level")

    def test_circle_of_files(self):
        self.write("src/solid/mass.hpp", '#include "solid/lumped.hpp"\n')
        self.write("src/solid/lumped.cpp", '#include "solid/solid_impl.hpp"\n')
        self.assert_offence("src/solid: files include each other in a circle: lumped -> solid -> mass -> lumped")

    def test_sum_outside_parallel(self):
        self.write("src/solid/sum.cpp", "// std::reduce\n\ndouble s = std::accumulate(m.begin(), m.end(), 0.0);\n")
        self.assert_offence("src/solid/sum.cpp:3: accumulate over values belongs behind parallel")

    def test_decision_about_values_outside_parallel(self):
        self.write("src/solid/rest.cpp", "bool b = std::ranges::any_of(\n    u, [&](double v) { return v != 0.0; });\n")
        self.assert_offence("src/solid/rest.cpp:1: any_of over values belongs behind parallel")

    def test_decisions_about_other_things_and_sums_of_parallel_pass(self):
        self.write("src/solid/any.cpp", "bool b = std::any_of(a, e, [](Index n) { return n > 0; });\n")
        self.write("src/parallel/sum.cpp", "double s = std::accumulate(m.begin(), m.end(), 0.0);\n")
        self.assertEqual(self.run_tool("check_layers.py")[0], 0)

    def test_every_folder_of_the_project_has_a_level(self):
        for folder in (TOOLS.parent / "src").iterdir():
            if folder.is_dir():
                self.write(f"src/{folder.name}/x.hpp", "\n")
        self.assertEqual(self.run_tool("check_layers.py")[0], 0)


if __name__ == "__main__":
    unittest.main()
