// What the verdict judges errors by, and what it leaves out.
#include <gtest/gtest.h>

#include "run/lint.hpp"
#include "run/verdict.hpp"
#include "run_fixture.hpp"

namespace carom {
namespace {

using namespace test;

const VerdictItem& item(const std::vector<VerdictItem>& items, const std::string& name) {
  for (const VerdictItem& one : items) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << "no item " << name;
  return items.front();
}

LedgerIncrement with(double EnergyTerms::*term, double value) {
  LedgerIncrement step;
  step.energy.*term = value;
  return step;
}

// 1e-30 of energy that comes from nowhere: as much as a body at rest has been supplied with, and nothing, relative to
// what rounding of its positions stores.
TEST(Verdict, HasAScaleForBodiesAtRest) {
  for (const double rest : {0.0, 1e-18}) {
    EnergyLedger ledger({}, {}, 1.0);
    RunMonitor monitor(ledger, {.mass = 1.0, .rest_energy = rest}, {});
    LedgerIncrement noise = with(&EnergyTerms::strain, 2e-30);
    noise.energy.external_work = 1e-30;
    noise.impulse.linear = {1e-20, 0.0, 0.0};
    ledger.add(noise, {});
    monitor.update();
    const auto items = monitor.items({}, 1e-9);
    EXPECT_EQ(item(items, "energy balance").pass, rest > 0.0);
    EXPECT_EQ(item(items, "linear momentum").pass, rest > 0.0);
    EXPECT_EQ(monitor.alarm().empty(), rest > 0.0);
  }
}

// Half of the work of a load that comes at once is `algorithmic` in statics; the same in a dynamic stage counts.
TEST(Verdict, LeavesOutThePathOfStaticStages) {
  EnergyLedger ledger({}, {}, 1.0);
  RunMonitor monitor(ledger, {.mass = 1.0}, {.reversible = 1.0, .is_static = true});
  LedgerIncrement load = with(&EnergyTerms::external_work, 2.0);
  load.energy.strain = 0.75;
  load.energy.algorithmic = 1.0;
  load.energy.quadrature = 0.25;
  ledger.add(load, {});
  monitor.update();
  EXPECT_TRUE(item(monitor.items({}, 1e-9), "algorithmic dissipation").pass);
  EXPECT_TRUE(item(monitor.items({}, 1e-9), "quadrature").pass);
  EXPECT_EQ(item(monitor.items({}, 1e-9), "algorithmic dissipation").value, 0.0);
  monitor.begin_stage({.reversible = 1.0, .is_static = false});
  LedgerIncrement loss = with(&EnergyTerms::strain, -0.5);
  loss.energy.algorithmic = 0.5;
  ledger.add(loss, {});
  monitor.update();
  EXPECT_EQ(item(monitor.items({}, 1e-9), "algorithmic dissipation").value, 0.25);  // 0.5 of 2
  EXPECT_FALSE(item(monitor.items({}, 1e-9), "algorithmic dissipation").pass);
}

TEST(Verdict, AllowsThePenetrationThatCellsAreCompressedBy) {
  const EnergyLedger ledger({}, {}, 1.0);
  const RunMonitor monitor(ledger, {.mass = 1.0}, {});
  const auto penetration = [&](double relative, double strain) {
    return item(monitor.items({relative, strain}, 1e-9), "penetration");
  };
  EXPECT_TRUE(penetration(0.04, 0.0).pass);
  EXPECT_FALSE(penetration(0.06, 0.02).pass);
  EXPECT_TRUE(penetration(0.06, 0.04).pass);
  EXPECT_EQ(penetration(0.06, 0.04).limit, 0.08);
}

const std::string statics = R"([scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)";

std::string pressed(double pressure, const std::string& time_function = "") {
  return case_of_block("[[load]]\npressure = " + std::to_string(pressure) + "\ngroup = \"HEAD\"\n" + time_function +
                       "[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"FOOT\"\npoint = [0.0, 0.0, 0.0]\n"
                       "normal = [0.0, 0.0, 1.0]\n" +
                       statics);
}

// The whole load in one step, on a body that only the floor holds.
TEST(Verdict, PassesOneStaticStep) {
  const TemporaryCase one(pressed(1e-3));
  EXPECT_EQ(one.run(), ExitCode::good);
  EXPECT_NE(one.result("summary.json").find("\"steps\": 1,"), std::string::npos);
}

TEST(Lint, HasNoCourantNumberForStatics) {
  const Case given = parse_case(pressed(1e-3), "case.toml");
  const Simulation simulation(given);
  ASSERT_GT(simulation.dt() * std::sqrt(2.0 / 1.5), 0.0);
  for (const std::string& warning : lint_warnings(simulation))
    EXPECT_EQ(warning.find("Courant"), std::string::npos) << warning;
}

// The head moves sideways by 3 % of the height in one step: 1.7 degrees of shear, half of it rotation. 5 %: too much.
TEST(Run, LooksAtRotationsAtTheEndOfAStage) {
  for (const double sideways : {0.03 * 3.0, 0.05 * 3.0}) {
    const TemporaryCase one(case_of_block(
        "[[support]]\nnodes = \"FOOT\"\nblocked = [\"x\", \"y\", \"z\"]\n[[support]]\nnodes = \"BODY\"\nblocked = "
        "[\"z\"]\n[[support]]\nnodes = \"HEAD\"\ndisplacement = { x = " +
        std::to_string(sideways) +
        ", function = \"ramp\" }\n[functions.ramp]\ntime = [0.0, 1.0]\nvalue = [0.0, 1.0]\n" + statics));
    const ExitCode code = one.run();
    EXPECT_EQ(code == ExitCode::run_failed, sideways > 0.1);
    EXPECT_EQ(one.result("summary.json").find("of a small-strain part has turned") != std::string::npos,
              sideways > 0.1);
  }
}

}  // namespace
}  // namespace carom
