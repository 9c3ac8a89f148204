// One cell all of whose nodes are led by supports: the step it takes, and what every law answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "advise/check_summary.hpp"
#include "driver/material_path.hpp"
#include "march/march.hpp"
#include "run_fixture.hpp"
#include "solid/cell_values.hpp"
#include "solid/stability.hpp"

namespace carom::run_driven_cells_test {
namespace {

using namespace test;

constexpr double duration = 1e-3;

struct LawValues {
  const char* law;
  const char* keys;
};
// Of steel and, for the elastic law of large strains, of rubber.
constexpr LawValues all_laws[] = {
    {"linear_elastic", "E = 2.1e11\nnu = 0.3\nrho = 7800.0\n"},
    {"st_venant_kirchhoff", "E = 2.1e11\nnu = 0.3\nrho = 7800.0\n"},
    {"neo_hookean", "E = 1e9\nnu = 0.45\nrho = 1000.0\n"},
    {"j2_small_strain", "E = 2.1e11\nnu = 0.3\nrho = 7800.0\nyield_stress = 4e8\nhardening_modulus = 1e9\n"},
    {"j2", "E = 2.1e11\nnu = 0.3\nrho = 7800.0\nyield_stress = 4e8\nsaturation_stress = 6e8\nsaturation_rate = 10.0\n"},
    {"johnson_cook",
     "E = 2.06e11\nnu = 0.3\nrho = 7830.0\nA = 8.06e8\nB = 6.14e8\nn = 0.168\nC = 0.0089\nm = 1.1\n"
     "reference_rate = 1.0\nmelting_temperature = 1540.0\nspecific_heat = 460.0\n"},
    {"j2_rate_small_strain",
     "E = 2.1e11\nnu = 0.3\nrho = 7800.0\nrates = [0.0, 100.0]\n"
     "hardening_tables = [[0.0, 4e8], [1.0, 5e8], [0.0, 6e8], [1.0, 7e8]]\n"},
    {"j2_rate",
     "E = 2.1e11\nnu = 0.3\nrho = 7800.0\nrates = [0.0, 100.0]\n"
     "hardening_tables = [[0.0, 4e8], [1.0, 5e8], [0.0, 6e8], [1.0, 7e8]]\n"},
    {"swift_small_strain",
     "E = 2.1e11\nnu = 0.3\nrho = 7800.0\nyield_stress = 4e8\npre_strain = 0.01\nexponent = 0.2\n"},
};

/// A cube of 1 m whose nodes on one side move by `to` along x in a millisecond: the side across x (the length changes)
/// or across y (shear).
std::string driven_case(const LawValues& law, const char* path, double to, const std::string& time = "") {
  const bool is_shear = std::string(path) == "simple_shear";
  return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
groups = {{ cells = "CUBE", {0}min = "HELD", {0}max = "LED" }}
[materials.m]
law = "{1}"
{2}[[part]]
name = "cube"
cells = "CUBE"
material = "m"
[[support]]
nodes = "CUBE"
blocked = ["y", "z"]
[[support]]
nodes = "HELD"
blocked = ["x"]
[[support]]
nodes = "LED"
displacement = {{ x = {3}, function = "ramp" }}
[functions.ramp]
time = [0.0, {4}]
value = [0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = {4}
{5})",
                     is_shear ? "y" : "x", law.law, law.keys, to, duration, time);
}

struct DrivenEnd {
  std::array<double, 6> stress{};
  double plastic_strain = 0.0;
  long long steps = 0;
};

DrivenEnd drive(const std::string& text) {
  const Simulation simulation(parse_case(text, "case.toml"));
  March march(simulation);
  march.start();
  while (!march.at_end() && !march.has_failed()) march.step();
  EXPECT_EQ(march.message(), "");
  const StepView view = march.view();
  DrivenEnd end{.stress = cell_stress(simulation.solid(), view.state.q, view.points()).front(), .steps = march.steps()};
  const auto plastic = cell_history(simulation.solid(), "equivalent_plastic_strain", view.state.points);
  if (!plastic.empty()) end.plastic_strain = plastic.front();
  return end;
}

struct DrivenPath {
  const char* kind;
  double to;
};

// The same path at a single point by `carom material` in 20,000 steps, without cells and supports. Laws that flow lose
// 0.5 % of the stress by 0.5 % of strain a step, and 0.006 % of the plastic strain (driven_cells.hpp); elastic laws
// lose nothing. The waves through the cell alone would leave eight steps.
void expect_answers_of_laws(const std::string& scheme, const std::string& time) {
  for (const LawValues& law : all_laws) {
    for (const DrivenPath& path :
         {DrivenPath{"uniaxial_strain", -0.3}, {"uniaxial_strain", 0.2}, {"simple_shear", 1.0}}) {
      SCOPED_TRACE(fmt::format("{} {} {}", law.law, path.kind, path.to));
      const std::string text = replaced(driven_case(law, path.kind, path.to, time), "central_differences", scheme);
      const DrivenEnd end = drive(text);
      const Simulation simulation(parse_case(text, "case.toml"));
      const MaterialCurve curve =
          follow(simulation.model().parts.front().material, 0,
                 make_path({.path = path.kind, .to = {path.to}, .steps = 20000, .rate = std::abs(path.to) / duration}));
      const std::array<const char*, 6> names{"xx", "yy", "zz", "xy", "yz", "zx"};
      const bool is_plastic = !curve.rows.empty() && simulation.model().parts.front().remembers();
      double size = 0.0;
      for (const char* name : names)
        size = std::max(size, std::abs(curve.column(std::string("stress_") + name).back()));
      for (std::size_t c = 0; c < 6; ++c) {
        EXPECT_NEAR(end.stress[c], curve.column(std::string("stress_") + names[c]).back(),
                    (is_plastic ? 6e-3 : 1e-9) * size)
            << names[c];
      }
      if (!is_plastic) continue;
      const double plastic = curve.column("equivalent_plastic_strain").back();
      EXPECT_GT(plastic, 0.1);
      EXPECT_NEAR(end.plastic_strain, plastic, 1e-4 * plastic);
    }
  }
}

TEST(DrivenCell, GivesTheAnswerOfItsLaw) {
  expect_answers_of_laws("central_differences", "");
}

// 200 steps, as many as the explicit ones above have at least.
TEST(DrivenCell, OfImplicitSchemesGivesTheAnswerOfItsLaw) {
  expect_answers_of_laws("newmark", "step = 5e-6\n");
  expect_answers_of_laws("statics", "step = 5e-6\n");
}

// Closed form, linear hardening at small strain: tau = (yield + H alpha) / sqrt 3, gamma = tau / G + sqrt 3 alpha.
TEST(DrivenCell, OfLinearHardeningIsExactInShear) {
  const double G = 2.1e11 / 2.6, gamma = 0.1;
  const double alpha = (gamma - 4e8 / std::sqrt(3.0) / G) / (std::sqrt(3.0) + 1e9 / std::sqrt(3.0) / G);
  const DrivenEnd end = drive(driven_case(all_laws[3], "simple_shear", gamma));
  EXPECT_NEAR(end.plastic_strain, alpha, 1e-12);
  EXPECT_NEAR(end.stress[3], (4e8 + 1e9 * alpha) / std::sqrt(3.0), 1e-3);  // 1e-11 of it
}

// Free sides, equilibrium by the law's tangent: sigma = E (R t - alpha) = s + H alpha + k alpha' with s = 4e8, H = 1e8
// and k = 2e8 / 100 of the curves. What is left of the start is alpha = E R / (E + H) (t - s / E R - k / (E + H)); the
// start itself falls by 3 in each of 48 steps.
TEST(DrivenCell, OfCurvesOverTheRateIsExactInStaticTension) {
  std::string text = driven_case(all_laws[6], "uniaxial_strain", 0.05, "step = 2e-5\nfixed = true\n");
  text = replaced(text, "xmin = \"HELD\"", "xmin = \"HELD\", ymin = \"SIDE\", zmin = \"BELOW\"");
  text = replaced(text, "nodes = \"CUBE\"\nblocked = [\"y\", \"z\"]",
                  "nodes = \"SIDE\"\nblocked = [\"y\"]\n[[support]]\nnodes = \"BELOW\"\nblocked = [\"z\"]");
  const DrivenEnd end = drive(replaced(text, "central_differences", "statics"));
  const double E = 2.1e11, R = 0.05 / duration,
               alpha = E * R / (E + 1e8) * (duration - 4e8 / (E * R) - 2e6 / (E + 1e8));
  EXPECT_NEAR(end.plastic_strain, alpha, 1e-9 * alpha);
  EXPECT_NEAR(end.stress[0], E * (0.05 - alpha), 1e-6 * 5e8);
  EXPECT_NEAR(end.stress[1], 0.0, 1e-6 * 5e8);
}

// No free node has a stable step: that of the cell, if it were free, and half a per cent of strain a step. The length
// of a side changes its logarithm most at the end of the compression to 0.7, 0.3 / 0.7 per duration.
TEST(DrivenCell, HasAStepOfItsOwn) {
  const Simulation fast(parse_case(driven_case(all_laws[4], "uniaxial_strain", -0.3), "case.toml"));
  const Stage& stage = fast.first();
  EXPECT_EQ(stage.driven().count, 1);
  EXPECT_TRUE(std::isinf(fast.stable().dt));
  // by the last of 200 intervals, and a whole number of steps
  EXPECT_NEAR(stage.dt(), most_imposed_strain * 0.7 / 0.3 * duration, 0.02 * stage.dt());
  const Simulation slow(parse_case(driven_case(all_laws[4], "uniaxial_strain", -1e-4), "case.toml"));
  EXPECT_NEAR(slow.dt(), 0.9 * 2.0 / std::sqrt(largest_frequency_bound(slow.solid())), 0.2 * slow.dt());
  EXPECT_LE(slow.dt(), 0.9 * 2.0 / std::sqrt(largest_frequency_bound(slow.solid())));
  // A given step is the user's.
  const Simulation given(parse_case(driven_case(all_laws[4], "uniaxial_strain", -1e-4, "step = 5e-4\n"), "case.toml"));
  EXPECT_EQ(given.dt(), 5e-4);
  for (const Simulation* one : {&fast, &slow, &given}) {
    const std::string text = examine(*one, "").text();
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
    EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    EXPECT_NE(text.find("1 cell strained by supports alone"), std::string::npos) << text;
  }
}

// A displacement that jumps is no rate, and what moves as a whole is not strained.
TEST(DrivenCell, IsNotBoundByJumpsOrRigidMotions) {
  const std::string jump =
      replaced(driven_case(all_laws[4], "uniaxial_strain", -0.01), "time = [0.0, 0.001]\nvalue = [0.0, 1.0]",
               "time = [0.0, 5e-4, 5e-4, 0.001]\nvalue = [0.0, 0.0, 1.0, 1.0]");
  const Simulation jumping(parse_case(jump, "case.toml"));
  EXPECT_EQ(jumping.first().driven().count, 1);
  EXPECT_TRUE(std::isinf(jumping.first().driven().dt_strain));
  const std::string rigid =
      replaced(driven_case(all_laws[4], "uniaxial_strain", -0.01), "nodes = \"HELD\"\nblocked = [\"x\"]",
               "nodes = \"HELD\"\ndisplacement = { x = -0.01, function = \"ramp\" }");
  const Simulation moving(parse_case(rigid, "case.toml"));
  EXPECT_EQ(moving.first().driven().count, 0);
  EXPECT_EQ(moving.first().steps(), 100);
}

}  // namespace
}  // namespace carom::run_driven_cells_test
