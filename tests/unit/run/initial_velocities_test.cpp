// Velocities of [[initial]] that differ from node to node, and what is no field of velocities.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/expression.hpp"
#include "run_fixture.hpp"

namespace carom::run_initial_velocities_test {
namespace {

using namespace test;

const std::string newmark = "[scheme]\nkind = \"newmark\"\n[time]\nend = 1.0\nstep = 0.1\n";

std::string initial(const std::string& keys) {
  return case_of_block("[[initial]]\npart = \"body\"\n" + keys + newmark);
}

/// Calls check(X, v) for every node of the state at the start.
template <class Check>
void for_each_node(const std::string& text, const Check& check) {
  const Case given = parse_case(text, "case.toml");
  const Simulation simulation(given);
  const State state = simulation.initial_state();
  for (std::size_t n = 0; n < simulation.mesh().node_count(); ++n)
    check(simulation.mesh().coordinates[n], Vec3{state.v[3 * n], state.v[3 * n + 1], state.v[3 * n + 2]});
}

TEST(Expression, ComputesAtAPlace) {
  EXPECT_EQ(Expression("-8000 * y * z").at({1.0, 2.0, 3.0}), -48000.0);
  EXPECT_EQ(Expression("x^2 + abs(y) - (z > 1 ? 5 : 7)").at({3.0, -2.0, 0.5}), 4.0);
  // cos and sqrt of the C library: equal to the last bit
  EXPECT_EQ(Expression("cos(pi * x) * sqrt(y)").at({0.25, 2.0, 0.0}),
            std::cos(std::numbers::pi * 0.25) * std::sqrt(2.0));
  EXPECT_TRUE(std::isinf(Expression("1 / x").at({})));
}

TEST(Expression, RefusesWhatIsNoFormula) {
  for (const char* text :
       {"", "2 * t", "x +", "x, y", "system(1)", "x; y", "__import__", "\"a\"", "3 x", "x = 1", "x = 0 ? 1 : 2"})
    EXPECT_THROW(Expression{text}, ExpressionError) << text;
  EXPECT_EQ(Expression("x <= 1 && y >= 0 && z != 2 && x == 0 ? 3 : 4").at({0.0, 1.0, 1.0}), 3.0);
}

TEST(InitialVelocities, OfARotationAboutAnAxisAddToAUniformOne) {
  for_each_node(initial("velocity = [0.0, 0.0, -3.0]\nangular_velocity = [0.0, 0.0, 2.0]\ncentre = [1.0, 1.0, 0.0]\n"),
                [](const Vec3& X, const Vec3& v) {
                  EXPECT_EQ(v, (Vec3{-2.0 * (X[1] - 1.0), 2.0 * (X[0] - 1.0), -3.0}));
                });
}

TEST(InitialVelocities, FollowFormulasInTheCoordinates) {
  for_each_node(initial("velocity = [1.0, 0.0, 0.0]\nvelocity_field = [\"-8000*y*z\", \"8000*x*z\", \"0\"]\n"),
                [](const Vec3& X, const Vec3& v) {
                  EXPECT_EQ(v, (Vec3{1.0 - 8000.0 * X[1] * X[2], 8000.0 * X[0] * X[2], 0.0}));
                });
}

/// Both ways of writing one rotation give the same momenta: 1/12 m (2^2 + 2^2) w, m = 12 x 1.5, w = 0.1, up to what
/// lumping adds to the inertia of 2 x 2 cells, m h^2 / 6 for each direction across.
TEST(InitialVelocities, OfARotationCarryItsAngularMomentum) {
  constexpr double mass = 18.0, inertia = mass * (4.0 + 4.0) / 12.0 + 2.0 * mass / 6.0;
  for (const char* keys : {"angular_velocity = [0.0, 0.0, 0.1]\ncentre = [1.0, 1.0, 0.0]\n",
                           "velocity_field = [\"-0.1 * (y - 1)\", \"0.1 * (x - 1)\", \"0\"]\n"}) {
    const TemporaryCase run(case_of_block("[[initial]]\npart = \"body\"\n" + std::string(keys) +
                                          "[scheme]\nkind = \"central_differences\"\n[time]\nend = 0.1\n"));
    run.run();
    EXPECT_NEAR(column(run.result("energy.csv"), "kinetic").at(0), 0.5 * inertia * 0.01, 1e-14 * inertia);
  }
}

TEST(InitialVelocities, AreRefusedWhereTheyAreNone) {
  const auto error = [](const std::string& keys) -> std::string {
    try {
      const Case given = parse_case(initial(keys), "case.toml");
      const Simulation simulation(given);
    } catch (const CaseError& e) {
      return std::to_string(e.where().line) + " " + e.what();
    }
    ADD_FAILURE() << "no error for\n" << keys;
    return {};
  };
  const auto expect = [&](const std::string& keys, const std::string& text) {
    const std::string said = error(keys);
    EXPECT_NE(said.find(text), std::string::npos) << said;
    EXPECT_TRUE(said.starts_with("17 ") || said.starts_with("15 ")) << said;  // of the key or of its section
  };
  expect("velocity_field = [\"0\", \"1\"]\n", "three formulas");
  expect("velocity_field = [\"0\", \"2 * t\", \"0\"]\n", "\"2 * t\"");
  expect("velocity_field = [\"0\", \"0\", \"1 / x\"]\n", "at node");
  expect("angular_velocity = [0.0, 0.0, 1.0]\n", "without a centre");
  expect("centre = [0.0, 0.0, 1.0]\nvelocity = [1.0, 0.0, 0.0]\n", "without angular_velocity");
}

// 5 m under gravity of 10 along a slanted line: (2 g h)^(1/2) = 10 along it; what turns or moves besides adds to it.
TEST(DropHeight, GivesTheSpeedOfTheFall) {
  const std::string falls =
      "[[load]]\ngravity = [0.0, 6.0, -8.0]\n[[initial]]\npart = \"body\"\ndrop_height = 5.0\nvelocity = [1.0, 0.0, 0.0]\n"
      "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";
  const Simulation s(parse_case(case_of_block(falls), "case.toml"));
  const State state = s.initial_state();
  for (std::size_t n = 0; n < s.mesh().node_count(); ++n) {
    EXPECT_DOUBLE_EQ(state.v[3 * n], 1.0);
    EXPECT_DOUBLE_EQ(state.v[3 * n + 1], 6.0);
    EXPECT_DOUBLE_EQ(state.v[3 * n + 2], -8.0);
  }
}

TEST(DropHeight, IsRefusedWithoutGravityWithBothWaysOut) {
  const std::string weightless =
      "[[initial]]\npart = \"body\"\ndrop_height = 1.5\n[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";
  const std::string mm = replaced(case_of_block(weightless), "units = \"SI\"", "units = \"mm-t-s\"");
  try {
    parse_case(mm, "case.toml");
    ADD_FAILURE() << "taken";
  } catch (const CaseError& e) {
    const std::string said = e.what();
    EXPECT_NE(said.find("gravity = [0.0, 0.0, -9806.65]"), std::string::npos) << said;
    EXPECT_NE(said.find("velocity = [0.0, 0.0, -171.522]"), std::string::npos) << said;  // (2 x 9806.65 x 1.5)^(1/2)
  }
}

}  // namespace
}  // namespace carom::run_initial_velocities_test
