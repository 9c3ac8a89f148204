// What `carom check` says of the bodies.
#include "advise/check_summary.hpp"

#include <gtest/gtest.h>

#include "run_fixture.hpp"

namespace carom::advise_check_summary_test {
namespace {

using namespace test;

std::string summary_of(const std::string& rest) {
  const std::string end = "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";
  return check_summary(Simulation(parse_case(case_of_block(rest + end), "case.toml")));
}

// 2 x 2 x 3 of density 1.5: m = 18, centre (1, 1, 1.5), I_x = m (4 + 9) / 12, I_z = m (4 + 4) / 12.
TEST(CheckSummary, HasMassCentreAndInertia) {
  const std::string text = summary_of("");
  EXPECT_NE(text.find("mass 18 kg, kinetic energy 0 J, momentum (0, 0, 0)\n"
                      "            centre (1, 1, 1.5), inertia about it (19.5, 19.5, 12) kg m2\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("all parts"), std::string::npos) << text;
}

// A cube of mass 1.5 at (4.5, 0.5, 0.5) beside it: with mu = 18 x 1.5 / 19.5 and d = (3.5, -0.5, -1) between the
// centres, I_x = 19.5 + 0.25 + mu (0.25 + 1), ..., I_xy = -mu d_x d_y, ...
TEST(CheckSummary, HasThoseOfAllPartsTogether) {
  const std::string text = summary_of(
      "[[mesh.block]]\norigin = [4.0, 0.0, 0.0]\nsize = [1.0, 1.0, 1.0]\ndivisions = [1, 1, 1]\ngroups = { cells = \"CUBE\" }\n"
      "[[part]]\nname = \"cube\"\ncells = \"CUBE\"\nmaterial = \"soft\"\n"
      "[[initial]]\npart = \"cube\"\nvelocity = [0.0, 0.0, 2.0]\n");
  EXPECT_NE(text.find("  all parts mass 19.5 kg, kinetic energy 3 J, momentum (0, 0, 3)\n"
                      "            centre (1.26923, 0.961538, 1.42308), inertia about it (21.4808, 38.0962, 29.5577), "
                      "products xy, yz, zx (2.42308, -0.692308, 4.84615) kg m2\n"),
            std::string::npos)
      << text;
}

// A tie has no gap to close, however far apart its rows' makers look.
TEST(CheckSummary, SaysThatTiesHoldTheirSidesTogether) {
  const std::string text = summary_of(
      "[[mesh.block]]\norigin = [0.0, 0.0, 3.0]\nsize = [2.0, 2.0, 1.0]\ndivisions = [3, 3, 1]\n"
      "groups = { cells = \"CAP\", zmin = \"SOLE\" }\n"
      "[[part]]\nname = \"cap\"\ncells = \"CAP\"\nmaterial = \"soft\"\n"
      "[[contact]]\nname = \"glue\"\nkind = \"tie\"\ngroup = \"SOLE\"\nmaster = \"HEAD\"\n");
  EXPECT_NE(text.find("  contact   \"glue\": holds its sides together\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace carom::advise_check_summary_test
