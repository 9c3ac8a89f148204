// [[equation]] of a case: what it makes, what is refused, and runs that go on.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run_fixture.hpp"

namespace carom::run_equation_test {
namespace {

using namespace test;

const std::string stepped = R"([scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.1
)";

std::string equation(const std::string& terms) {
  return "[[equation]]\nterms = [" + terms + "]\n";
}
std::string term(const std::string& nodes, const std::string& dof, double coefficient) {
  return "{ nodes = \"" + nodes + "\", dof = \"" + dof + "\", coefficient = " + std::to_string(coefficient) + " }";
}

// Every node of the head hangs on the one of the foot that lies under it.
TEST(CaseEquation, OfGroupsPairsNodesByTheirPlaces) {
  const Case given = parse_case(
      case_of_block(equation(term("HEAD", "z", 2.0) + ", " + term("FOOT", "z", -1.0)) + stepped), "case.toml");
  const Simulation s(given);
  ASSERT_EQ(s.model().equations.size(), 9U);
  for (const LinearEquation& made : s.model().equations) {
    ASSERT_EQ(made.terms.size(), 2U);
    const Vec3 &a = s.mesh().coordinates[static_cast<std::size_t>(made.terms[0].node)],
               &b = s.mesh().coordinates[static_cast<std::size_t>(made.terms[1].node)];
    EXPECT_EQ(a[0], b[0]);
    EXPECT_EQ(a[1], b[1]);
    EXPECT_EQ(a[2], 3.0);
    EXPECT_EQ(made.terms[0].component, 2);
    EXPECT_EQ(made.terms[1].coefficient, -1.0);
  }
}

TEST(CaseEquation, ThatCannotBeIsRefused) {
  const auto what = [](const std::string& text) {
    return std::string(case_error(case_of_block(text + stepped)).what());
  };
  const std::string support = "[[support]]\nnodes = \"HEAD\"\nblocked = [\"z\"]\n";
  const std::string own = equation(term("HEAD", "z", 1.0) + ", " + term("FOOT", "z", -1.0));
  EXPECT_NE(what(support + own).find("imposes"), std::string::npos) << what(support + own);
  EXPECT_NE(what(own + own).find("dependent one of another equation"), std::string::npos);
  const std::string twice = equation(term("HEAD", "z", 1.0) + ", " + term("HEAD", "z", -1.0));
  EXPECT_NE(what(twice).find("twice in one equation"), std::string::npos);
  const std::string uneven = equation(term("HEAD", "z", 1.0) + ", " + term("BODY", "z", -1.0));
  EXPECT_NE(what(uneven).find("36 nodes in \"BODY\" against 9"), std::string::npos) << what(uneven);
  // All of HEAD is imposed, and nothing is left to begin with.
  const std::string both = "[[support]]\nnodes = \"FOOT\"\nblocked = [\"z\"]\n" + support;
  EXPECT_NE(what(both + own).find("All that it couples is imposed"), std::string::npos) << what(both + own);
  // FOOT follows HEAD, which follows FOOT: once, or, by another factor, so that both are zero.
  const std::string back = equation(term("FOOT", "z", 1.0) + ", " + term("HEAD", "z", -1.0));
  EXPECT_NE(what(own + back).find("equations before it"), std::string::npos) << what(own + back);
  const std::string twofold = equation(term("FOOT", "z", 1.0) + ", " + term("HEAD", "z", -2.0));
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block(own + twofold + stepped), "case.toml")));
  const std::string driven = "[[support]]\nnodes = \"FOOT\"\nvelocity = { z = 0.5 }\n" + own;
  EXPECT_NE(what(driven).find("expected 0.5 there"), std::string::npos) << what(driven);
  const std::string along = "[[initial]]\nnodes = \"HEAD\"\nvelocity = [0.0, 0.0, 0.5]\n";
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block(along + driven + stepped), "case.toml")));
  const std::string ramp =
      "[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n[[support]]\nnodes = \"FOOT\"\nvelocity = { z = 0.5, "
      "function = \"ramp\" }\n" +
      own;
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block(ramp + stepped), "case.toml")));
  for (const std::string kind : {"tchamwa_wielgosz", "nonsmooth_generalized_alpha"}) {
    const std::string step = kind == "tchamwa_wielgosz" ? "" : "step = 0.1\n";
    const std::string text = case_of_block(ramp + "[scheme]\nkind = \"" + kind + "\"\n[time]\nend = 1.0\n" + step);
    EXPECT_NE(std::string(case_error(text).what()).find("imposes a motion"), std::string::npos) << text;
  }
  const std::string later = own + stepped + "[[stage]]\nkind = \"newmark\"\nend = 2.0\nstep = 0.1\n";
  const auto stage_error = [](const std::string& text) { return std::string(case_error(case_of_block(text)).what()); };
  const std::string some = later + "[[stage.initial]]\nnodes = \"HEAD\"\nvelocity = [0.0, 0.0, 1.0]\n";
  EXPECT_NE(stage_error(some).find("some only"), std::string::npos) << stage_error(some);
  const std::string all = later + "[[stage.initial]]\nnodes = \"all\"\nvelocity = [0.0, 0.0, 1.0]\n";
  EXPECT_NO_THROW(Simulation(parse_case(case_of_block(all), "case.toml")));
  const std::string moving = "[[initial]]\nnodes = \"HEAD\"\nvelocity = [0.0, 0.0, 1.0]\n";
  EXPECT_NE(what(moving + own).find("break equation"), std::string::npos) << what(moving + own);
  EXPECT_THROW(parse_case(case_of_block(equation(term("HEAD", "z", 0.0)) + stepped), "case.toml"), CaseError);
  EXPECT_THROW(parse_case(case_of_block(own + "[scheme]\nkind = \"modified_mass\"\n[time]\nend = 1.0\n"), "case.toml"),
               CaseError);
}

}  // namespace
}  // namespace carom::run_equation_test
