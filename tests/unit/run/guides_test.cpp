// Rigid bodies that guides and hinges hold along or about some axes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "math/vec3.hpp"
#include "model/compatibility.hpp"
#include "model/turning_body.hpp"
#include "run/run.hpp"
#include "run_fixture.hpp"

namespace carom::run_guides_test {
namespace {

using namespace test;

/// A brick of 1 x 2 x 3 and mass 12 about the origin; `body` adds to its [[rigid_body]].
std::string brick(const std::string& body, const std::string& rest) {
  return R"(units = "SI"
[[mesh.block]]
origin = [-0.5, -1.0, -1.5]
size = [1.0, 2.0, 3.0]
divisions = [1, 1, 1]
groups = { cells = "BRICK" }
[materials.hard]
law = "linear_elastic"
E = 2.0e5
nu = 0.3
rho = 2.0
[[part]]
name = "brick"
cells = "BRICK"
material = "hard"
[[rigid_body]]
name = "brick"
parts = ["brick"]
)" + body +
         rest;
}

/// Positions of the directors and the centre, and their rates.
struct Seen {
  BodyFrame now, rate;
  Vec3 omega;
};
Seen seen(const Simulation& simulation, const State& state) {
  const TurningBody& body = simulation.model().turning_bodies.front();
  std::array<Vec3, 4> x = nodal_values(body, state.q);
  for (std::size_t a = 0; a < 4; ++a) x[a] = add(x[a], corner(body, a));
  Seen all{body_frame(body, x), body_frame(body, nodal_values(body, state.v)), {}};
  all.omega = angular_velocity(all.now, all.rate);
  return all;
}

/// Where the material point X is.
Vec3 place_of(const Simulation& simulation, const State& state, const Vec3& X) {
  return place_body(simulation.model().turning_bodies.front(), state.q).position(X);
}

struct Scheme {
  const char* kind;
  const char* step;
};
constexpr std::array schemes{Scheme{"central_differences", ""}, Scheme{"energy_momentum", "step = 0.005\n"},
                             Scheme{"newmark", "step = 0.005\n"}, Scheme{"noh_bathe", ""}};

std::string at_end(const Scheme& scheme, double end) {
  return fmt::format("[scheme]\nkind = \"{}\"\n[time]\nend = {}\n{}", scheme.kind, end, scheme.step);
}

// A physical pendulum that is let go from the horizontal is at its lowest after sqrt(I_A / (m g l)) K(sin 45 degrees),
// with K = 1.85407467730137 (A.-M. Legendre; E. T. Whittaker, Analytical Dynamics, 1917, section 44), and turns there
// by omega^2 = 2 m g l / I_A. Here I_A = m (1 + 4) / 12 + m l^2 with l = 1 about the edge x = 0, y = 1: the brick falls
// about z. Steps of 1/400 of the way: 2e-4; the axes, which spring by (omega / frequency)^2, as much again.
TEST(Guides, APendulumSwingsAboutItsHinge) {
  const double m = 12.0, g = 9.81, l = 1.0, I_A = m * 5.0 / 12.0 + m * l * l;
  const double quarter = std::sqrt(I_A / (m * g * l)) * 1.85407467730137;
  for (const Scheme& scheme : schemes) {
    SCOPED_TRACE(scheme.kind);
    const Simulation simulation(parse_case(
        brick("blocked = [\"x\", \"y\", \"z\"]\nblocked_at = [0.0, 1.0, 0.0]\nblocked_turns = [\"x\", \"y\"]\n",
              "[[load]]\ngravity = [9.81, 0.0, 0.0]\n" + at_end(scheme, quarter)),
        "case.toml"));
    March march(simulation);
    march.start();
    while (!march.at_end()) {
      march.step();
      ASSERT_FALSE(march.has_failed()) << march.message();
      ASSERT_LE(norm(subtract(place_of(simulation, march.state(), {0.0, 1.0, 0.0}), Vec3{0.0, 1.0, 0.0})), 1e-9);
    }
    const Seen last = seen(simulation, march.state());
    EXPECT_NEAR(last.now.centre[0], l, 1e-3);
    EXPECT_NEAR(last.now.centre[1], 1.0, 5e-3);
    EXPECT_NEAR(last.now.centre[2], 0.0, 1e-9);
    EXPECT_NEAR(last.omega[2], std::sqrt(2.0 * m * g * l / I_A), 2e-3 * std::sqrt(2.0 * m * g * l / I_A));
    EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-9 * m * g * l);  // hinges do no work
    EXPECT_LE(march.body_strain(), 1e-3);
  }
}

// About an axis that is not a principal one a free body tumbles; hinged about it, it spins steadily (L. Euler 1758: the
// moment of the hinge is omega x I omega). The body is stretched by (omega / frequency)^2 < 1e-4, which makes it slower
// by twice that.
TEST(Guides, ABodyThatIsNotBalancedSpinsSteadilyAboutItsHinge) {
  const std::string body =
      "mass = 12.0\ncentre_of_mass = [0.0, 0.0, 0.0]\ninertia = [13.0, 10.0, 6.0]\nproducts_of_inertia = [1.0, 2.0, "
      "1.5]\n";
  const std::string spin =
      "[[initial]]\npart = \"brick\"\nangular_velocity = [0.0, 0.0, 2.0]\ncentre = [0.0, 0.0, 0.0]\n";
  // Where a point of the hinge and one beside it are after 8 radian.
  const auto last_of = [&](const std::string& guide, const Scheme& scheme) {
    const Simulation simulation(parse_case(brick(body + guide, spin + at_end(scheme, 4.0)), "case.toml"));
    March march(simulation);
    march.start();
    while (!march.at_end()) march.step();
    EXPECT_FALSE(march.has_failed()) << march.message();
    return std::pair{place_of(simulation, march.state(), {0.0, 0.0, 1.0}),
                     place_of(simulation, march.state(), {1.0, 0.0, 0.0})};
  };
  for (const Scheme& scheme : schemes) {
    SCOPED_TRACE(scheme.kind);
    EXPECT_GT(std::hypot(last_of("", scheme).first[0], last_of("", scheme).first[1]), 0.1);
    const auto [on, beside] = last_of("blocked_turns = [\"x\", \"y\"]\n", scheme);
    EXPECT_NEAR(on[0], 0.0, 1e-10);
    EXPECT_NEAR(on[1], 0.0, 1e-10);
    EXPECT_LE(norm(subtract(beside, Vec3{std::cos(8.0), std::sin(8.0), 0.0})), 8.0 * 2e-4);
  }
}

// Newton's law along the one axis that is left: v = F t / M, though the force is off the centre, and the weight g sin
// of an inclined guide does not exist: what pulls along x and y is borne.
TEST(Guides, ThatBlockAllTurnsLetABodySlide) {
  for (const SchemeTraits& traits : scheme_table) {
    if (!traits.has_inertia || traits.has_massless_contact) continue;  // they are refused
    const std::string name(traits.name);
    const Scheme scheme{name.c_str(), is_explicit(traits.kind) ? "" : "step = 0.005\n"};
    SCOPED_TRACE(scheme.kind);
    const Simulation simulation(parse_case(
        replaced(brick("blocked = [\"x\", \"y\"]\nblocked_turns = [\"x\", \"y\", \"z\"]\n",
                       "[[load]]\nforce = [3.0, 0.0, 6.0]\ngroup = \"FAR\"\n[[load]]\ngravity = [1.0, 2.0, 0.0]\n" +
                           at_end(scheme, 1.0)),
                 "groups = { cells = \"BRICK\" }",
                 "groups = { cells = \"BRICK\" }\npoints = { FAR = [0.5, 1.0, 1.5] }"),
        "case.toml"));
    March march(simulation);
    march.start();
    while (!march.at_end()) march.step();
    ASSERT_FALSE(march.has_failed()) << march.message();
    const Seen last = seen(simulation, march.state());
    // 1/2 (F / M) t^2; schemes of first order lag by up to a step of 0.005
    EXPECT_NEAR(last.now.centre[2], 0.25, 0.005 * 0.5);
    EXPECT_NEAR(last.rate.centre[2], 0.5, 1e-3 * 0.5);
    EXPECT_NEAR(last.now.centre[0], 0.0, 1e-12);
    EXPECT_NEAR(last.now.centre[1], 0.0, 1e-12);
    EXPECT_LE(norm(last.omega), 1e-9);
    EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-10);
  }
}

/// A guided plate of mass 5 that is an obstacle hits the end of a bar with rho = c = A = 1; `guide` is the rest of it.
std::string plate_on_bar(const std::string& guide) {
  return R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 20.0]
divisions = [1, 1, 200]
groups = { cells = "BAR", zmax = "END" }
[materials.bar]
law = "linear_elastic"
E = 1.0
nu = 0.0
rho = 1.0
[[part]]
name = "bar"
cells = "BAR"
material = "bar"
[[load]]
gravity = [1.0e-4, 0.0, 0.0]
[[support]]
nodes = "BAR"
blocked = ["x", "y"]
[[contact]]
name = "plate"
kind = "box"
group = "END"
lower = [-0.5, -1.0, 20.0]
upper = [5.0, 2.0, 21.0]
mass = 5.0
velocity = [0.0, 0.0, -1.0e-3]
)" + guide +
         R"(
[scheme]
kind = "central_differences"
enforcement = "impulse"
[time]
end = 10.0
)";
}

// v = v_0 exp(-rho c A t / M) (Saint-Venant 1883; W. Goldsmith, Impact, 1960, section 3.2), as cases/rigid_bodies has
// it for a part: here the hit is off the centre of the plate, and gravity pulls it sideways. The tolerance is that of
// the case, the mesh's answer to a sudden velocity.
TEST(Guides, APlateInItsGuideHitsABar) {
  for (const char* guide :
       {"blocked = [\"x\", \"y\"]\n",
        "blocked = [\"x\", \"y\"]\nblocked_turns = [\"x\", \"y\"]\ninertia = [8.0, 9.0, 10.0]\nrigidity = 1.0\n",
        "blocked = [\"x\", \"y\"]\nblocked_turns = [\"x\", \"y\", \"z\"]\ninertia = [8.0, 9.0, 10.0]\n"}) {
    SCOPED_TRACE(guide);
    const TemporaryCase one(plate_on_bar(guide));
    ASSERT_EQ(one.run(), ExitCode::good) << one.result("summary.json");
    const auto plate = last_row(one.result("contact.csv")), energy = last_row(one.result("energy.csv"));
    EXPECT_NEAR(plate.at("plate.velocity_z"), -1.0e-3 * std::exp(-2.0), 0.01 * 1.0e-3 * std::exp(-2.0));
    EXPECT_NEAR(plate.at("plate.displacement_z"), -5.0e-3 * (1.0 - std::exp(-2.0)), 1e-3 * 5.0e-3);
    EXPECT_NEAR(plate.at("plate.displacement_x"), 0.0, 1e-15);
    EXPECT_LE(std::abs(energy.at("imbalance")), 1e-12);
  }
}

// Motions against a guide would break its equations; each says which velocity it is.
TEST(Guides, AVelocityAgainstTheGuideIsRefused) {
  const auto what = [](const std::string& text) { return std::string(case_error(text).what()); };
  const Scheme scheme = schemes[0];
  EXPECT_EQ(what(replaced(plate_on_bar("blocked = [\"x\", \"y\"]\n"), "[0.0, 0.0, -1.0e-3]", "[0.0, 0.5, -1.0e-3]")),
            "case.toml:28:11: contact.blocked: found \"plate\" held along y, where its initial velocities give it 0.5; "
            "expected velocities that its guide allows. Give it none along y, or let it move there.");
  const std::string spin =
      "[[initial]]\npart = \"brick\"\nangular_velocity = [0.0, 0.0, 2.0]\ncentre = [0.0, 1.0, 0.0]\n";
  const std::string hinge = "blocked = [\"x\", \"y\", \"z\"]\nblocked_at = [0.0, 1.0, 0.0]\n";
  const Simulation allowed(parse_case(brick(hinge, spin + at_end(scheme, 1.0)), "case.toml"));
  EXPECT_EQ(allowed.model().equations.size(), 3U);
  EXPECT_NE(what(brick(replaced(hinge, "1.0, 0.0]", "0.0, 0.0]"), spin + at_end(scheme, 1.0)))
                .find("rigid_body.blocked: found \"brick\" held along x, where its initial velocities give it 2"),
            std::string::npos);
  EXPECT_NE(what(brick("blocked_turns = [\"x\", \"z\"]\n", spin + at_end(scheme, 1.0)))
                .find("rigid_body.blocked_turns: found \"brick\" held about z, where its initial velocities give it 2"),
            std::string::npos);
  EXPECT_NE(what(brick(hinge, "[[support]]\nnodes = \"BRICK\"\nblocked = [\"x\"]\n" + at_end(scheme, 1.0)))
                .find("\"BRICK\", the nodes of rigid body \"brick\", which has a guide"),
            std::string::npos);
}

}  // namespace
}  // namespace carom::run_guides_test
