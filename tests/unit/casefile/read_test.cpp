// Small rules of reading a case: what may stand twice, what a value may be, and what a message on a whole file says.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "casefile/read_case.hpp"
#include "casefile/read_toml.hpp"

namespace carom::casefile_read_test {
namespace {

std::string case_with(const std::string& material, const std::string& more) {
  return "[mesh]\nfile = \"bar.msh\"\n[materials.m]\n" + material + "E = 2e11\nnu = 0.3\nrho = 7800.0\n" +
         "[[part]]\nname = \"p\"\ncells = \"all\"\nmaterial = \"m\"\n" + more +
         "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1e-3\n";
}

TEST(CasefileSupport, TakesEachComponentOnce) {
  for (const std::string axis : {"x", "y", "z"}) {
    try {
      parse_case(case_with("law = \"linear_elastic\"\n", "[[support]]\nnodes = \"FOOT\"\nsymmetry = \"" + axis +
                                                             "\"\nblocked = [\"" + axis + "\"]\n"),
                 "c.toml");
      FAIL() << axis << " was taken twice";
    } catch (const CaseError& error) {
      EXPECT_EQ(error.key(), "support[0].blocked");
      EXPECT_EQ(error.found(), "component " + axis + " a second time (also in symmetry)");
    }
  }
}

// docs/case_format.md: rates are numbers >= 0.
TEST(CasefileMaterials, RatesOfCurvesMayBeBelowOne) {
  const std::string law =
      "law = \"j2_rate\"\nhardening_tables = [[0.0, 4e8], [0.0, 5e8], [0.0, 6e8]]\nrates = [0.0, 0.5, 10.0]\n";
  const Case given = parse_case(case_with(law, ""), "c.toml");
  EXPECT_EQ(given.materials[0].made().rates, (std::vector<double>{0.0, 0.5, 10.0}));
}

// TOML 1.0.0, "Float" and "Integer": digits on both sides of the point, digits after e, no leading zero.
TEST(CasefileNumbers, AreShownAsTomlHasThem) {
  const auto remedy = [](const std::string& value) {
    try {
      read_toml("[materials.m]\nE = 2e11 # .5\n" + value + "\n", "c.toml");
    } catch (const CaseError& error) {
      EXPECT_EQ(error.where().line, 3) << value;
      return error.suggestion();
    }
    return std::string("none");
  };
  const std::vector<std::array<std::string, 3>> mended{
      {"nu = .3", ".3", "0.3"},        {"nu = -.1", "-.1", "-0.1"},
      {"nu = +.2", "+.2", "+0.2"},     {"nu = 1.", "1.", "1.0"},
      {"nu = 1e", "1e", "1e0"},        {"nu = 1d-3", "1d-3", "1e-3"},
      {"nu = 1.e3", "1.e3", "1.0e3"},  {"v = [0.0, 1.0, -.5]", "-.5", "-0.5"},
      {"v = { z = 2. }", "2.", "2.0"}, {"t = [\".5\", 1D+2]", "1D+2", "1e+2"}};
  for (const auto& [line, found, written] : mended)
    EXPECT_NE(remedy(line).find("write " + written + " instead of " + found + "."), std::string::npos)
        << line << ": " << remedy(line);
  EXPECT_EQ(remedy("v = [0.0, -0.5, 1e-3, 0, 10"), "Check quotes, brackets and commas here.");
}

// No line of it is wrong: the file is another one.
TEST(CasefileFiles, AMeshInThePlaceOfACaseIsSaidOfTheWholeFile) {
  const std::string mesh = std::string(CAROM_SOURCE_DIR) + "/cases/sdnv100/as_published.msh";
  try {
    read_case(mesh);
    FAIL() << "it was read";
  } catch (const CaseError& error) {
    EXPECT_EQ(error.found(), "a mesh file");
    EXPECT_EQ(error.where().line, 0);
    EXPECT_EQ(error.where().column, 0);
  }
}

}  // namespace
}  // namespace carom::casefile_read_test
