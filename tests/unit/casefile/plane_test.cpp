// Plane strips, bars, sections of parts and finite-strain laws in the case file.
#include <gtest/gtest.h>

#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"

namespace carom::casefile_plane_test {
namespace {

const std::string base = R"(
[[mesh.block]]
kind = "quad"
origin = [1.0, 2.0, 0.5]
size = [3.0, 4.0]
divisions = [6, 8]
groups = { cells = "STRIP", ymin = "FOOT", xmax = "" }
[[mesh.block]]
kind = "bar"
origin = [0.0, 0.0, 0.1]
end = [0.0, 3.0, 4.1]
divisions = 50
groups = { cells = "BAR", end = "TOP" }
[materials.rubber]
law = "neo_hookean"
E = 1e6
nu = 0.4
rho = 1100
[[part]]
name = "strip"
cells = "STRIP"
material = "rubber"
section = "plane_stress"
thickness = 0.01
[[part]]
name = "bar"
cells = "BAR"
material = "rubber"
section = "bar"
area = 1e-4
[scheme]
kind = "central_differences"
[time]
end = 1.0
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CasefilePlane, BlocksAndPartsAreRead) {
  const Case c = parse_case(base, "c.toml");
  ASSERT_EQ(c.mesh.blocks.size(), 2U);
  const StructuredBlock &strip = c.mesh.blocks[0], &bar = c.mesh.blocks[1];
  EXPECT_EQ(strip.kind, StructuredBlock::Kind::quad);
  EXPECT_EQ(strip.size, (Vec3{3.0, 4.0, 0.0}));
  EXPECT_EQ(strip.divisions[0], 6);
  EXPECT_EQ(strip.divisions[1], 8);
  EXPECT_EQ(strip.face_groups, (std::array<std::string, 6>{"XMIN", "", "FOOT", "YMAX", "ZMIN", "ZMAX"}));
  EXPECT_EQ(bar.kind, StructuredBlock::Kind::bar);
  EXPECT_EQ(bar.end, (Vec3{0.0, 3.0, 4.1}));
  EXPECT_EQ(bar.divisions[0], 50);
  EXPECT_EQ(bar.end_groups, (std::array<std::string, 2>{"START", "TOP"}));
  EXPECT_EQ(*c.materials[0].law, "neo_hookean");
  ASSERT_EQ(c.parts.size(), 2U);
  EXPECT_EQ(c.parts[0].section, Section::plane_stress);
  EXPECT_EQ(c.parts[0].thickness, 0.01);
  EXPECT_EQ(c.parts[1].section, Section::bar);
  EXPECT_EQ(c.parts[1].area, 1e-4);
}

TEST(CasefilePlane, ThicknessIsOneUnlessGiven) {
  EXPECT_EQ(parse_case(with(base, "thickness = 0.01", ""), "c.toml").parts[0].thickness, 1.0);
}

TEST(CasefilePlane, ResolvedCaseReadsBackToItself) {
  const std::string text = resolved_toml(parse_case(base, "c.toml"));
  const Case again = parse_case(text, "resolved");
  EXPECT_EQ(resolved_toml(again), text);
  EXPECT_EQ(again.mesh.blocks[1].end, (Vec3{0.0, 3.0, 4.1}));
  EXPECT_EQ(again.mesh.blocks[0].size, (Vec3{3.0, 4.0, 0.0}));
  EXPECT_EQ(text.find("ZMIN"), std::string::npos);  // a strip has no such side
}

TEST(CasefilePlane, EveryMessage) {
  struct Malformed {
    const char* from;
    const char* to;
    const char* message;
  };
  const std::vector<Malformed> malformed{
      // clang-format off
      {"kind = \"quad\"",
       "kind = \"quads\"",
       "c.toml:3:8: mesh.block[0].kind: found \"quads\"; expected one of \"hexa\", \"quad\", \"bar\". Did you mean \"quad\"?"},
      {"size = [3.0, 4.0]",
       "size = [3.0, 4.0, 5.0]",
       "c.toml:5:8: mesh.block[0].size: found a list of 3 values; expected two numbers [x, y] > 0 in m"},
      {"size = [3.0, 4.0]",
       "size = [3.0, 0.0]",
       "c.toml:5:14: mesh.block[0].size[1]: found 0.0; expected a number > 0 in m"},
      {"divisions = [6, 8]",
       "divisions = [6, 8, 1]",
       "c.toml:6:13: mesh.block[0].divisions: found a list of 3 values; expected two integers [nx, ny] >= 1"},
      {"divisions = [6, 8]",
       "divisions = [6, 0]",
       "c.toml:6:17: mesh.block[0].divisions[1]: found 0; expected an integer >= 1"},
      {"size = [3.0, 4.0]",
       "size = [3.0, 4.0]\nend = [4.0, 6.0, 0.5]",
       "c.toml:6:1: mesh.block[0].end: found a key that kind = \"quad\" does not take; expected one of kind, origin, size, divisions, groups, points. It belongs to kind = \"bar\"."},
      {"ymin = \"FOOT\"",
       "zmin = \"FOOT\"",
       "c.toml:7:29: mesh.block[0].groups.zmin: found an unknown key; expected one of cells, xmin, xmax, ymin, ymax. Did you mean xmin?"},
      {"divisions = 50",
       "divisions = [50]",
       "c.toml:12:13: mesh.block[1].divisions: found a list of 1 value; expected an integer >= 1"},
      {"divisions = 50",
       "divisions = 0",
       "c.toml:12:13: mesh.block[1].divisions: found 0; expected an integer >= 1"},
      {"end = [0.0, 3.0, 4.1]\n",
       "",
       "c.toml:8:1: mesh.block[1].end: found nothing; expected three numbers [x, y, z] in m. Add end: The other end."},
      {"end = \"TOP\"",
       "zmax = \"TOP\"",
       "c.toml:13:27: mesh.block[1].groups.zmax: found an unknown key; expected one of cells, start, end"},
      {"law = \"neo_hookean\"",
       "law = \"neohookean\"",
       "c.toml:15:7: materials.rubber.law: found \"neohookean\"; expected one of \"linear_elastic\", \"st_venant_kirchhoff\", \"neo_hookean\", \"j2_small_strain\", \"j2\", \"johnson_cook\", \"j2_rate_small_strain\", \"j2_rate\", \"swift_small_strain\". Did you mean \"neo_hookean\"?"},
      {"section = \"plane_stress\"",
       "section = \"plane\"",
       "c.toml:23:11: part[0].section: found \"plane\"; expected one of \"solid\", \"plane_strain\", \"plane_stress\", \"axisymmetric\", \"bar\". Shells and beams are not computed: mesh thin parts by solids, and read in docs/locking.md how many cells they need through the thickness."},
      {"section = \"plane_stress\"",
       "section = \"axisymmetric\"",
       "c.toml:24:1: part[0].thickness: found a key that section = \"axisymmetric\" does not take; expected one of name, cells, material, section, type, formulation, hourglass, hourglass_viscosity, distortion_control, linear_bulk_viscosity, quadratic_bulk_viscosity. It belongs to section = \"plane_strain\", \"plane_stress\"."},
      {"section = \"plane_stress\"\n",
       "",
       "c.toml:23:1: part[0].thickness: found a key that section = \"solid\" does not take; expected one of name, cells, material, section, type, formulation, hourglass, hourglass_viscosity, distortion_control, linear_bulk_viscosity, quadratic_bulk_viscosity. It belongs to section = \"plane_strain\", \"plane_stress\"."},
      {"thickness = 0.01",
       "thickness = -0.01",
       "c.toml:24:13: part[0].thickness: found -0.01; expected a number > 0 in m"},
      {"area = 1e-4\n",
       "",
       "c.toml:25:1: part[1].area: found nothing; expected a number > 0 in m2. Add area: Area of the section of the bars."},
      {"area = 1e-4",
       "area = 0",
       "c.toml:30:8: part[1].area: found 0; expected a number > 0 in m2"},
      // clang-format on
  };
  for (const Malformed& m : malformed) {
    try {
      parse_case(with(base, m.from, m.to), "c.toml");
      ADD_FAILURE() << "no error for " << m.to;
    } catch (const CaseError& error) {
      EXPECT_STREQ(error.what(), m.message) << "for " << m.to;
    }
  }
}

}  // namespace
}  // namespace carom::casefile_plane_test
