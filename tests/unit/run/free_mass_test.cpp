// The impact bar of cases/impact_bar/free_mass.toml on free rigid masses, with several schemes; and why the alpha
// family makes energy on multipliers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "advise/lint.hpp"
#include "exact/bar_impact.hpp"
#include "run_fixture.hpp"
#include "schemes/generalized_alpha.hpp"
#include "schemes/scheme_table.hpp"

namespace carom::run_free_mass_test {
namespace {

using namespace test;

/// The bar of 100 cells (length 10, E 900, rho 1, speed 0.1, gap 0.05) on a wall: `wall` holds its mass, or nothing.
std::string bar_case(const std::string& scheme, const std::string& wall, double step) {
  std::ostringstream text;
  text << R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.0, 0.0, 0.05]
end = [0.0, 0.0, 10.05]
divisions = 100
groups = { cells = "BAR", start = "FOOT", end = "TOP" }
[materials.unit]
law = "linear_elastic"
E = 900.0
nu = 0.0
rho = 1.0
[[part]]
name = "bar"
cells = "BAR"
material = "unit"
section = "bar"
area = 1.0
[[support]]
nodes = "BAR"
blocked = ["x", "y"]
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -0.1]
[[contact]]
name = "wall"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
)" << wall
       << "[scheme]\n"
       << scheme << "[time]\nend = 1.5\nstep = " << step << "\n[output]\nfields = []\n";
  return text.str();
}

std::string mass(double m) {
  return "mass = " + std::to_string(m) + "\n";
}

const char* const generalized_alpha = "kind = \"generalized_alpha\"\nenforcement = \"lagrange\"\n";
const char* const bathe = "kind = \"bathe\"\nenforcement = \"lagrange\"\n";
const char* const hht = "kind = \"hht\"\nenforcement = \"lagrange\"\nalpha = -0.3333333\n";
const char* const stabilized = "kind = \"contact_stabilized_newmark\"\nmass = \"lumped\"\n";
const char* const moreau_jean = "kind = \"moreau_jean\"\nmass = \"lumped\"\n";
const char* const cd_lagrange = "kind = \"cd_lagrange\"\n";
const char* const modified_mass = "kind = \"modified_mass\"\n";

/// Impulse of the wall at t = 1.5, and the largest error of the momentum.
struct Outcome1d {
  double impulse = 0.0, momentum_error = 0.0;
};

Outcome1d outcome(const std::string& scheme, double wall_mass) {
  const TemporaryCase one(bar_case(scheme, mass(wall_mass), 1.5e-3));
  EXPECT_EQ(one.run(), ExitCode::good) << scheme << one.result("summary.json");
  const Columns energy = read_csv(one.result("energy.csv")), contact = read_csv(one.result("contact.csv"));
  Outcome1d out{contact.at("wall.impulse_z").back(), 0.0};
  for (const double p : energy.at("momentum_z")) out.momentum_error = std::max(out.momentum_error, std::abs(p + 1.0));
  return out;
}

// Exact, in one dimension: m v0 (1 - exp(-2 M / m)) with the mass M = 10 of the bar. A discrete front is about three
// cells wide, which hold 3 rho h v0 = 0.03 of momentum: what the release, decided by the returning front, may be off
// by.
TEST(FreeMass, TakesTheMomentumOfTheExactSolution) {
  for (const double m : {1.0, 10.0, 100.0}) {
    const double exact = -0.1 * m * std::expm1(-20.0 / m);
    for (const char* scheme : {generalized_alpha, bathe, hht, stabilized, moreau_jean, cd_lagrange, modified_mass}) {
      const Outcome1d found = outcome(scheme, m);
      EXPECT_NEAR(found.impulse, exact, 0.03) << scheme << m;
      EXPECT_LT(found.momentum_error, 1e-12) << scheme << m;  // round-off of 1000 steps of a momentum of 1
    }
  }
}

/// Work that a single node of unit mass does on a fixed wall: its speed after the touch, when it arrives at unit speed
/// and would pass the wall by `overshoot` steps' ways. The recurrence of generalized_alpha.hpp with h = 1.
double speed_after_touch(const GeneralizedAlphaParameters& p, double overshoot) {
  double u = 1.0 - overshoot, v = -1.0, a = 0.0;
  for (int step = 0; step < 60; ++step) {
    const double memory = -p.alpha_m / (1.0 - p.alpha_m) * a;  // acceleration without contact
    const double free = u + v + (0.5 - p.beta) * a + p.beta * memory;
    const double a_end = free < 0.0 ? memory - free / p.beta : memory;
    u = free < 0.0 ? 0.0 : free;
    v += (1.0 - p.gamma) * a + p.gamma * a_end;
    a = a_end;
  }
  return v;
}

/// The same with the recurrence of bathe.hpp for a law.
double speed_after_touch_by_bathe(double overshoot) {
  double u = 1.0 - overshoot, v = -1.0, a = 0.0;
  for (int step = 0; step < 60; ++step) {
    const double free = u + v / 2.0 + a / 16.0;
    const double a_half = std::max(0.0, -16.0 * free), v_half = v + (a + a_half) / 4.0;
    const double v_back = (4.0 * v_half - v) / 3.0, u_back = (v_back + 4.0 * std::max(0.0, free) - u) / 3.0;
    a = std::max(0.0, -9.0 * u_back);
    v = v_back + a / 3.0;
    u = u_back + a / 9.0;
  }
  return v;
}

TEST(FreeMass, ReboundOfATouchIsThatOfTheRecurrence) {
  const auto rebound_of = [](SchemeKind kind, const SchemeParameters& parameters) {
    return touch_rebound({.kind = kind, .parameters = parameters, .enforcement = EnforcementKind::plain}).value();
  };
  EXPECT_EQ(rebound_of(SchemeKind::newmark, NewmarkParameters{}), 3.0);
  for (const double alpha : {-0.05, -0.2, -1.0 / 3.0}) {
    const AlphaParameters given{alpha};
    EXPECT_NEAR(speed_after_touch(hht_parameters(alpha), 1.0 - 1e-9), rebound_of(SchemeKind::hht, given), 1e-7);
    EXPECT_NEAR(speed_after_touch(wbz_parameters(alpha), 1.0 - 1e-9), rebound_of(SchemeKind::wbz, given), 1e-7);
  }
  for (const double rho : {0.0, 0.5, 0.8, 1.0}) {
    const double rebound = rebound_of(SchemeKind::generalized_alpha, SpectralRadius{rho});
    EXPECT_NEAR(speed_after_touch(chung_hulbert_parameters(rho), 1.0 - 1e-9), rebound, 1e-7);
    EXPECT_NEAR(rebound, 1.0 + rho * (1.0 - rho), 1e-12);
  }
  double most = 0.0;
  for (int i = 0; i <= 1000; ++i) most = std::max(most, speed_after_touch_by_bathe(0.001 * i));
  EXPECT_NEAR(most, rebound_of(SchemeKind::bathe, NoParameters{}), 1e-12);
  for (const EnforcementKind e : {EnforcementKind::penalty, EnforcementKind::lagrange})
    EXPECT_FALSE(touch_rebound({.kind = SchemeKind::bathe, .enforcement = e}).has_value());
}

/// What a run of the case says when it ends, and the case's warnings.
std::string verdict_and_warnings(const std::string& scheme, const std::string& wall, ExitCode expected) {
  const std::string text = bar_case(scheme, wall, 1.5e-3);
  const TemporaryCase one(text);
  EXPECT_EQ(one.run(), expected) << scheme;
  const Case given = parse_case(text, "case.toml");
  std::string all = one.result("summary.json");
  for (const std::string& warning : lint_warnings(Simulation(given))) all += warning + "\n";
  return all;
}

// The energy that weakly damped HHT makes on multipliers is not the free mass's: on a wall that is held it is the same.
// The user is told before and after.
TEST(FreeMass, SchemesThatThrowBackAreNamed) {
  const char* const weak = "kind = \"hht\"\nenforcement = \"plain\"\nalpha = -0.05\n";
  for (const std::string& wall : {std::string(), mass(10.0)}) {
    const std::string said = verdict_and_warnings(weak, wall, ExitCode::run_failed);
    const std::size_t first = said.find("with up to 2.63 times its speed");  // 4 / 1.05^2 - 1
    EXPECT_NE(first, std::string::npos) << said;
    EXPECT_NE(said.find("with up to 2.63 times its speed", first + 1), std::string::npos) << said;
  }
  EXPECT_EQ(verdict_and_warnings(generalized_alpha, mass(10.0), ExitCode::good).find("times its speed"),
            std::string::npos);
  EXPECT_EQ(verdict_and_warnings(bathe, mass(10.0), ExitCode::good).find("times its speed"), std::string::npos);
}

// The wall presses with rho c v = 3 while the wave is in the bar, whichever axis the bar lies along. The front holds
// 0.03 of the momentum, as above.
TEST(ModifiedMass, OfABarIsThatOfItsAxis) {
  const std::string axes = "xyz";
  for (std::size_t c = 0; c < 3; ++c) {
    const auto along = [&](const std::string& length) {
      std::array<std::string, 3> x{"0.0", "0.0", "0.0"};
      x[c] = length;
      return "[" + x[0] + ", " + x[1] + ", " + x[2] + "]";
    };
    std::string text = bar_case(modified_mass, "", 1.5e-3);
    text = replaced(text, "origin = [0.0, 0.0, 0.05]", "origin = [0.0, 0.0, 0.0]");
    text = replaced(text, "end = [0.0, 0.0, 10.05]", "end = " + along("10.0"));
    text = replaced(text, "blocked = [\"x\", \"y\"]",
                    std::string("blocked = [\"") + axes[(c + 1) % 3] + "\", \"" + axes[(c + 2) % 3] + "\"]");
    text = replaced(text, "velocity = [0.0, 0.0, -0.1]", "velocity = " + along("-0.1"));
    text = replaced(text, "normal = [0.0, 0.0, 1.0]", "normal = " + along("1.0"));
    text = replaced(text, "end = 1.5\n", "end = 0.3\n");
    const TemporaryCase one(text);
    EXPECT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
    EXPECT_NEAR(last_row(one.result("contact.csv")).at(std::string("wall.impulse_") + axes[c]), 3.0 * 0.3, 0.03) << c;
  }
}

}  // namespace
}  // namespace carom::run_free_mass_test
