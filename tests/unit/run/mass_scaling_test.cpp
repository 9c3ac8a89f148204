// Mass scaling: what is added where, the step that it gives, the books of the heavier body, and the refusal.
#include <algorithm>
#include <cmath>
#include <vector>

#include "casefile/document.hpp"
#include "run_fixture.hpp"
#include "solid/stability.hpp"

namespace carom::run_mass_scaling_test {
namespace {

using namespace test;

/// The block of case_of_block and a flake beside it, a tenth of a cell thick, which drags the stable step down.
std::string case_with_flake(const std::string& scheme, const std::string& rest = "") {
  return case_of_block(R"(
[[mesh.block]]
origin = [3.0, 0.0, 0.0]
size = [1.0, 1.0, 0.1]
divisions = [1, 1, 1]
groups = { cells = "FLAKE", zmin = "UNDER" }
[[part]]
name = "flake"
cells = "FLAKE"
material = "soft"
[[initial]]
part = "flake"
velocity = [0.0, 0.0, -0.1]
[[initial]]
nodes = "HEAD"
velocity = [0.0, 0.0, 0.02]
[scheme]
kind = "central_differences"
)" + scheme + "\n[time]\nend = 4.0\n" +
                       rest);
}

const Stage& first_stage(const Simulation& simulation) {
  return *simulation.stages().front();
}

TEST(MassScaling, AddsWhatTheSmallCellsNeedAndReachesTheStep) {
  const Simulation plain(parse_case(case_with_flake(""), "case.toml"));
  const double before = first_stage(plain).stable().dt, step = 2.0 * before;
  const Simulation scaled(parse_case(case_with_flake("mass_scaling_step = " + toml_number(step)), "case.toml"));
  const Stage& stage = first_stage(scaled);
  // The bound of a cell is above its frequency by a few percent, so that the step is reached with that to spare.
  EXPECT_GE(stage.stable().dt, step * (1.0 - 1e-3));
  EXPECT_LT(stage.stable().dt, 1.2 * step);
  // The flake is the last cell: its bound says by how much it has to gain; no other cell does.
  const Solid& solid = scaled.solid();
  const std::vector<double> bounds = cell_frequency_bounds(solid);
  const double factor = bounds.back() * step * step / 4.0, flake = 1.5 * 0.1;
  ASSERT_GT(factor, 3.9);
  for (std::size_t k = 0; k + 1 < bounds.size(); ++k) EXPECT_LT(bounds[k] * step * step / 4.0, 1.0);
  const double added = (factor - 1.0) * flake, total = 1.5 * 12.1;
  EXPECT_NEAR(stage.mass().total(), total + added, 1e-12 * total);
  EXPECT_NEAR(stage.mass_notes().added, added, 1e-12 * total);
  EXPECT_NEAR(stage.mass_notes().added_share, added / total, 1e-12);
  ASSERT_EQ(stage.mass_notes().lines.size(), 1U);
  EXPECT_TRUE(stage.mass_notes().lines[0].starts_with("mass scaling: 1 of 13 cells gain a mass of "))
      << stage.mass_notes().lines[0];
  EXPECT_NE(stage.mass_notes().lines[0].find("; the worst: cell 13 at (3.5, 0.5, 0.05) x "), std::string::npos)
      << stage.mass_notes().lines[0];
}

TEST(MassScaling, AddsNothingWhereTheStepIsReached) {
  const Simulation plain(parse_case(case_with_flake(""), "case.toml"));
  const double step = 0.8 * first_stage(plain).stable().dt;
  const Simulation scaled(parse_case(case_with_flake("mass_scaling_step = " + toml_number(step)), "case.toml"));
  EXPECT_EQ(first_stage(scaled).mass_notes().added, 0.0);
  EXPECT_EQ(first_stage(scaled).mass().node_diagonal(), first_stage(plain).mass().node_diagonal());
}

TEST(MassScaling, IsRefusedBeyondItsLimit) {
  const Simulation plain(parse_case(case_with_flake(""), "case.toml"));
  const double step = 2.0 * first_stage(plain).stable().dt;
  const CaseError error =
      case_error(case_with_flake("mass_scaling_step = " + toml_number(step) + "\nmass_scaling_limit = 0.001"));
  EXPECT_EQ(error.key(), "scheme.mass_scaling_step");
  EXPECT_NE(error.found().find("1 of 13 cells gain a mass of "), std::string::npos) << error.found();
  EXPECT_NE(std::string(error.what()).find("at most 0.1 % of added mass"), std::string::npos) << error.what();
}

TEST(MassScaling, IsRefusedOnAConsistentMassAndALimitAlone) {
  for (const char* scheme : {"mass = \"consistent\"\nmass_scaling_step = 0.1", "mass_scaling_limit = 0.1"})
    EXPECT_THROW(parse_case(case_with_flake(scheme), "case.toml"), CaseError) << scheme;
}

// Not with an implicit scheme on a lumped mass, and not with the modified one, which is its own.
TEST(MassScaling, BelongsToExplicitSchemesOfALumpedMass) {
  for (const char* scheme : {"newmark\"\nmass = \"lumped", "modified_mass"}) {
    std::string text = replaced(case_with_flake("mass_scaling_step = 0.1"), "central_differences", scheme);
    text = replaced(text, "end = 4.0", "end = 4.0\nstep = 0.1");
    try {
      parse_case(text, "case.toml");
      ADD_FAILURE() << "no error with " << scheme;
    } catch (const CaseError& e) {
      EXPECT_EQ(e.key(), "scheme.mass_scaling_step") << e.what();
    }
  }
}

// Falls on a floor under its weight: energy, momentum and the work of gravity are those of the heavier body.
TEST(MassScaling, ClosesTheBooksWithTheHeavierBody) {
  const Simulation plain(parse_case(case_with_flake(""), "case.toml"));
  const double step = 2.0 * first_stage(plain).stable().dt;
  const TemporaryCase one(case_with_flake("mass_scaling_step = " + toml_number(step), R"(
[[load]]
gravity = [0.0, 0.0, -0.01]
[[contact]]
name = "floor"
kind = "plane"
group = "UNDER"
point = [0.0, 0.0, -0.02]
normal = [0.0, 0.0, 1.0]
stiffness = 2.0
)"));
  EXPECT_NE(one.run(), ExitCode::run_failed) << one.result("summary.json");
  const std::string energy = one.result("energy.csv");
  const std::vector<double> kinetic = column(energy, "kinetic"), imbalance = column(energy, "imbalance"),
                            momentum_error = column(energy, "momentum_error"), momentum = column(energy, "momentum_z"),
                            stored = column(energy, "contact_stored");
  for (std::size_t i = 0; i < kinetic.size(); ++i) {
    EXPECT_LT(std::abs(imbalance[i]), 1e-10 * kinetic[0]);
    EXPECT_LT(std::abs(momentum_error[i]), 1e-9 * std::abs(momentum[0]));
  }
  EXPECT_GT(*std::max_element(stored.begin(), stored.end()), 0.0);  // it has met the floor
  const std::string summary = one.result("summary.json"), key = "\"added_mass_share\":";
  ASSERT_NE(summary.find(key), std::string::npos) << summary;
  EXPECT_GT(std::stod(summary.substr(summary.find(key) + key.size())), 0.0);
}

}  // namespace
}  // namespace carom::run_mass_scaling_test
