// Obstacles that are led to turn: what they drag, hit and press, from the case to the results.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "advise/lint_contact.hpp"
#include "math/vec3.hpp"
#include "model/compatibility.hpp"
#include "run_fixture.hpp"
#include "schemes_fixture.hpp"

namespace carom::run_turned_obstacles_test {
namespace {

using namespace test;

/// A bar of 2 kg that lies along y on top of a roller of radius 100, whose surface goes at 0.1 m/s along x; mu = 0.3.
std::string on_roller(const std::string& contact, const std::string& scheme, double height = 0.0) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.0, -0.1, {}]
end = [0.0, 0.1, {}]
divisions = 1
groups = {{ cells = "BLOCK" }}
[materials.steel]
law = "linear_elastic"
E = 1.0e9
nu = 0.0
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
section = "bar"
area = 0.01
[[load]]
gravity = [0.0, 0.0, -9.81]
[[contact]]
name = "roller"
kind = "cylinder"
group = "BLOCK"
measure = "node"
point = [0.0, 0.0, -100.0]
axis = [0.0, 1.0, 0.0]
radius = 100.0
angular_velocity = [0.0, 0.001, 0.0]
friction = 0.3
{}
[scheme]
mass = "lumped"
{}
end = 0.05
[output]
fields = []
[[probe]]
name = "block"
group = "BLOCK"
quantities = ["velocity"]
)",
                     height, height, contact, scheme);
}

/// Value of a column of equal steps at a time, between those of the steps.
double at_time(const std::vector<double>& time, const std::vector<double>& values, double t) {
  const auto next = std::lower_bound(time.begin(), time.end(), t);
  const auto i = static_cast<std::size_t>(next - time.begin());
  const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return values[i - 1] + share * (values[i] - values[i - 1]);
}

// Coulomb: mu g t until the block goes with the surface. Then friction has done m v^2 on the side of the roller, of
// which half is the block's; the torque is mu m g R. The slope by which the top has moved, x / R = 2e-5, is below what
// the step leaves within which the block begins to stick: mu m g x 0.1 m/s x 1e-4 s of work, 3e-3 of it. Springs along
// the surface hold it then, on which it rings on by mu m g / sqrt(2 k m) = 3e-3 m/s.
void expect_dragged(const TemporaryCase& run, double tolerance) {
  ASSERT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
  const Columns contact = test::read_csv(run.result("contact.csv")), probe = test::read_csv(run.result("probes.csv"));
  EXPECT_NEAR(at_time(probe.at("time"), probe.at("block.velocity_x"), 0.02), 0.3 * 9.81 * 0.02, tolerance * 0.06);
  EXPECT_NEAR(probe.at("block.velocity_x").back(), 0.1, tolerance * 0.1);
  EXPECT_NEAR(contact.at("roller.impulse_x").back(), 0.2, tolerance * 0.2);
  EXPECT_NEAR(at_time(contact.at("time"), contact.at("roller.moment_y"), 0.02), 100.0 * 0.3 * 2.0 * 9.81,
              tolerance * 600.0);
  EXPECT_NEAR(contact.at("roller.angular_velocity_y").back(), 0.001, 1e-15);
  EXPECT_EQ(contact.at("roller.displacement_x").back(), 0.0);
  const auto energy = last_row(run.result("energy.csv"));
  EXPECT_NEAR(energy.at("friction"), 0.01, tolerance * 0.01);
  EXPECT_NEAR(energy.at("support_work"), 0.02, tolerance * 0.02);
}

TEST(TurnedObstacles, DragBlocksByFriction) {
  const std::string implicit = "\n[time]\nstep = 1e-4";
  expect_dragged(TemporaryCase(on_roller("", "kind = \"newmark\"\nenforcement = \"lagrange\"" + implicit)), 3e-3);
  expect_dragged(TemporaryCase(on_roller("", "kind = \"bathe\"\nenforcement = \"lagrange\"" + implicit)), 3e-3);
  expect_dragged(TemporaryCase(on_roller("", "kind = \"moreau_jean\"" + implicit)), 3e-3);
  expect_dragged(TemporaryCase(on_roller("", "kind = \"nonsmooth_generalized_alpha\"" + implicit)), 3e-3);
  expect_dragged(TemporaryCase(on_roller("", "kind = \"cd_lagrange\"\n[time]")), 3e-3);
  // As deep in the springs as the weight presses: 9.81 / 1e6.
  const double depth = -9.81e-6;
  const std::string springs = "stiffness = 1e6\ninitial_penetration = \"prestress\"";
  expect_dragged(TemporaryCase(on_roller(springs, "kind = \"central_differences\"\n[time]", depth)), 3e-2);
}

/// A bar of 2 kg along z stands before a paddle that turns about z at 1 radian per second, half a metre from the axis.
struct Hit {
  double speed = 0.0;       ///< of the bar, along y
  double work_error = 0.0;  ///< relative: work of the paddle less rate x integral of its torque
  double imbalance = 0.0;   ///< of the ledger, relative
};

/// By the trapezoidal rule.
double integral(const std::vector<double>& time, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t i = 1; i < time.size(); ++i) sum += 0.5 * (time[i] - time[i - 1]) * (values[i - 1] + values[i]);
  return sum;
}

Hit hit_by_paddle(const std::string& scheme, double step, double end) {
  const TemporaryCase run(fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.5, 0.02, -0.1]
end = [0.5, 0.02, 0.1]
divisions = 1
groups = {{ cells = "BLOCK" }}
[materials.steel]
law = "linear_elastic"
E = 1.0e9
nu = 0.0
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
section = "bar"
area = 0.01
[[contact]]
name = "paddle"
kind = "box"
group = "BLOCK"
measure = "node"
lower = [0.0, -0.02, -1.0]
upper = [1.0, 0.02, 1.0]
centre_of_rotation = [0.0, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 1.0]
stiffness = 1e6
[scheme]
mass = "lumped"
{}
[time]
step = {}
end = {}
[output]
fields = []
[[probe]]
name = "block"
group = "BLOCK"
quantities = ["velocity"]
)",
                                      scheme, step, end));
  EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
  const auto energy = last_row(run.result("energy.csv"));
  const Columns contact = test::read_csv(run.result("contact.csv"));
  const double work = energy.at("support_work");
  return {last_row(run.result("probes.csv")).at("block.velocity_y"),
          std::abs(work - integral(contact.at("time"), contact.at("paddle.moment_z"))) / work,
          std::abs(energy.at("imbalance")) / work};
}

// What is hit without friction by a body that nothing stops leaves at twice its speed, 2 omega r, while it does not
// turn: springs hold for pi sqrt(m / k) = 3e-3, by which the paddle turns on. It works by its rate times its torque;
// both are sums over steps, which differ to the second order.
TEST(TurnedObstacles, HitAtTwiceTheSpeedOfTheirSurface) {
  for (const std::string scheme : {"kind = \"central_differences\"", "kind = \"newmark\"\nenforcement = \"penalty\"",
                                   "kind = \"energy_momentum\""}) {
    const Hit whole = hit_by_paddle(scheme, 5e-5, 0.02);
    EXPECT_NEAR(whole.speed, 1.0, 3e-3) << scheme;
    EXPECT_LT(whole.work_error, 1e-6) << scheme;
    EXPECT_LT(whole.imbalance, 1e-12) << scheme;
    if (scheme == "kind = \"energy_momentum\"") continue;  // its forces are means over steps
    const Hit coarse = hit_by_paddle(scheme, 1e-4, 2e-3), fine = hit_by_paddle(scheme, 5e-5, 2e-3);
    EXPECT_NEAR(coarse.work_error / fine.work_error, 4.0, 0.4) << scheme;
  }
}

/// A square rod of two by two facets a side turns with its corners against a plate that is held at its back.
const std::string square_against_plate = R"(units = "SI"
[mesh]
unused = "ignore"
[[mesh.block]]
origin = [-1.0, -1.0, 0.0]
size = [2.0, 2.0, 1.0]
divisions = [2, 2, 1]
groups = { cells = "ROD", xmin = "ROUND", xmax = "ROUND", ymin = "ROUND", ymax = "ROUND" }
[[mesh.block]]
origin = [-1.0, 1.38, 0.2]
size = [2.0, 0.5, 0.6]
divisions = [16, 2, 2]
groups = { cells = "PLATE", ymin = "FACE", ymax = "BACK" }
[materials.rubber]
law = "linear_elastic"
E = 2.0e6
nu = 0.3
rho = 1000.0
[[part]]
name = "plate"
cells = "PLATE"
material = "rubber"
[[support]]
nodes = "BACK"
blocked = ["x", "y", "z"]
[[contact]]
name = "rod"
kind = "surface"
group = "FACE"
surface = "ROUND"
centre_of_rotation = [0.0, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 6.283185307179586]
)";

Columns pressed_by_square(const std::string& time) {
  const TemporaryCase run(square_against_plate + R"([scheme]
kind = "statics"
enforcement = "penalty"
[guards]
rotation_stop = 90.0
[output]
fields = []
)" + time);
  EXPECT_NE(run.run(), ExitCode::run_failed) << run.result("summary.json");
  return test::read_csv(run.result("contact.csv"));
}

// After one turn everything is where it was, and presses as it did, to what the equations are solved to; and a stage
// goes on from the angle at which the one before has ended.
TEST(TurnedObstacles, AreBackAfterAWholeTurn) {
  const Columns contact = pressed_by_square("[time]\nstep = 0.015625\nend = 2.0\n");
  const Columns in_stages = pressed_by_square(R"([time]
step = 0.015625
end = 1.1875
[[stage]]
kind = "statics"
enforcement = "penalty"
step = 0.015625
end = 2.0
)");
  ASSERT_EQ(contact.at("time").size(), 129U);
  ASSERT_EQ(in_stages.at("time").size(), 129U);
  const std::vector<double>& force = contact.at("rod.force_y");
  const double largest = *std::max_element(force.begin(), force.end());
  EXPECT_GT(largest, 1e3);
  for (const char* name : {"rod.force_x", "rod.force_y", "rod.moment_z"}) {
    const std::vector<double>& values = contact.at(name);
    for (std::size_t i = 0; i < force.size(); ++i) {
      if (i + 64 < force.size()) {
        EXPECT_NEAR(values[i], values[i + 64], 1e-9 * largest) << name << ", row " << i;
      }
      EXPECT_NEAR(values[i], in_stages.at(name)[i], 1e-9 * largest) << name << ", row " << i;
    }
  }
}

/// A roller beside a plate of plane cells, turning about the given direction.
std::string beside_plate(const std::string& section, const std::string& rate) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "quad"
origin = [0.0, 0.0, 0.0]
size = [1.0, 1.0]
divisions = [2, 2]
groups = {{ cells = "PLATE", ymin = "FOOT" }}
[materials.soft]
law = "linear_elastic"
E = 2.0e9
nu = 0.3
rho = 1500.0
[[part]]
name = "plate"
cells = "PLATE"
material = "soft"
section = "{}"
[[contact]]
name = "roller"
kind = "sphere"
group = "FOOT"
centre = [0.0, -2.0, 0.0]
radius = 1.9
angular_velocity = {}
[scheme]
kind = "central_differences"
[time]
end = 1e-3
)",
                     section, rate);
}

TEST(TurnedObstacles, AreDoubtedWhereTheyMoveNothingOrTurnTooFarInAStep) {
  const std::string text =
      replaced(beside_plate("plane_strain", "[0.0, 0.0, 3000.0]"), "kind = \"central_differences\"\n[time]",
               "kind = \"newmark\"\n[time]\nstep = 1e-4");
  const Simulation simulation(parse_case(text, "case.toml"));
  const std::vector<std::string> warnings = contact_warnings(simulation);
  const auto has = [&](const std::string& wanted) {
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& said) { return said.find(wanted) != std::string::npos; });
  };
  EXPECT_TRUE(has("a round body that turns about itself moves nothing without friction"));
  EXPECT_TRUE(has("a step turns it by 0.3 radians"));
}

TEST(TurnedObstacles, TurnInThePlaneOfPlaneCells) {
  const Simulation about_z(parse_case(beside_plate("plane_strain", "[0.0, 0.0, 3.0]"), "case.toml"));
  EXPECT_EQ(about_z.model().turning_bodies.size(), 1U);
  const CaseError out_of_plane = case_error(beside_plate("plane_stress", "[0.0, 2.0, 3.0]"));
  EXPECT_EQ(
      std::string(out_of_plane.what()),
      "case.toml:24:20: contact.angular_velocity: found [0, 2, 3] beside \"plate\", which is plane_stress; expected a "
      "rotation about z, [0, 0, w]. Plane cells have no displacement along z.");
  const CaseError ring = case_error(beside_plate("axisymmetric", "[0.0, 3.0, 0.0]"));
  EXPECT_NE(std::string(ring.what())
                .find("case.toml:24:20: contact.angular_velocity: found [0, 3, 0] beside \"plate\", which "
                      "is axisymmetric; expected an obstacle that does not turn."),
            std::string::npos)
      << ring.what();
}

/// A block of rubber is pressed on a roller that drags it and whose axis sinks a little. `turns`: else its surface does
/// not.
std::string pressed_on_roller(const SchemeTraits& scheme, std::size_t enforcement, bool turns) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
origin = [0.0, 0.0, 0.01]
size = [1.0, 1.0, 2.0]
divisions = [2, 2, 2]
groups = {{ cells = "BODY", zmin = "FOOT", zmax = "HEAD" }}
[materials.soft]
law = "linear_elastic"
E = 2.0
nu = 0.3
rho = 1.5
[[part]]
name = "body"
cells = "BODY"
material = "soft"
[[support]]
nodes = "HEAD"
velocity = {{ x = 0.05, z = -0.1 }}
[[contact]]
name = "roller"
kind = "cylinder"
group = "FOOT"
point = [0.5, 0.0, -2.0]
axis = [0.0, 1.0, 0.0]
radius = 2.0
velocity = [0.0, 0.0, -0.01]
{}
friction = 0.3
[scheme]
kind = "{}"
enforcement = "{}"
[time]
end = {}
{}
[guards]
rotation_stop = 90.0
[output]
fields = []
)",
                     turns ? "angular_velocity = [0.0, 0.2, 0.0]" : "", scheme.name,
                     name(static_cast<EnforcementKind>(enforcement)), is_explicit(scheme.kind) ? 3.0 : 1.6,
                     is_explicit(scheme.kind) ? "" : "step = 0.05");
}

struct Books {
  double imbalance = 0.0, momentum = 0.0, angular_momentum = 0.0;  ///< largest errors
  double work = 0.0, friction = 0.0;                               ///< at the end
};

Books books_of(const std::string& text) {
  const TemporaryCase run(text);
  EXPECT_NE(run.run(), ExitCode::run_failed) << run.result("summary.json");
  const Columns energy = test::read_csv(run.result("energy.csv"));
  const auto largest = [&](const char* name) {
    double most = 0.0;
    for (const double value : energy.at(name)) most = std::max(most, std::abs(value));
    return most;
  };
  return {largest("imbalance"), largest("momentum_error"), largest("angular_momentum_error"),
          energy.at("support_work").back(), energy.at("friction").back()};
}

// The balances close as those of a velocity that is imposed: to round-off, or to what the equations are solved to. Of
// the work, implicit steps leave at most 1e-12 unbooked; divided by the speed of the head, 0.1 m/s, that is an impulse,
// with an arm of at most 2.3 m.
TEST(TurnedObstacles, AreInTheBooksOfEverySchemeAndEnforcement) {
  for (const SchemeTraits& scheme : scheme_table) {
    for (std::size_t e = 0; e < enforcement_count; ++e) {
      if (!scheme.takes[e]) continue;
      SCOPED_TRACE(fmt::format("{} {}", scheme.name, name(static_cast<EnforcementKind>(e))));
      const Books turned = books_of(pressed_on_roller(scheme, e, true));
      const Books plain = books_of(pressed_on_roller(scheme, e, false));
      constexpr double round_off =
          2e-14;  // where steps are not iterated: 2000 roundings of energies and momenta near 0.1
      const double solved_to = is_explicit(scheme.kind) ? 0.0 : 1e-12 * turned.work;
      EXPECT_LT(turned.imbalance, std::max(round_off, solved_to));
      EXPECT_LT(turned.momentum, std::max(round_off, solved_to / 0.1));
      EXPECT_LT(turned.angular_momentum, std::max(round_off, 2.3 * solved_to / 0.1));
      EXPECT_GT(turned.work, plain.work);
      EXPECT_GT(turned.friction, plain.friction);
    }
  }
}

/// The vector, turned by two radians about a direction along no axis.
Vec3 in_other_frame(const Vec3& x) {
  const Vec3 n{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  return add(scaled(x, std::cos(2.0)),
             add(scaled(cross(n, x), std::sin(2.0)), scaled(n, dot(n, x) * (1.0 - std::cos(2.0)))));
}
Vec3 as_it_is(const Vec3& x) {
  return x;
}

/// Where a block of rubber is after a hit on a shape that turns and travels: displacements as seen in the given frame.
template <class Frame>
std::vector<Vec3> after_hit(bool on_plane, const Frame& frame) {
  Mesh mesh = block_mesh({2, 2, 2}, 0.0);
  for (Vec3& X : mesh.coordinates) X = frame(X);
  const Vec3 centre = frame({0.4, 1.1, -1.0}), axis = frame(normalized({0.3, 1.0, 0.2}));
  TurningBody body = make_led_body(centre, axis, 2.0);
  std::vector<Index> led;
  for (std::size_t a = 0; a < 4; ++a) {
    led.push_back(static_cast<Index>(mesh.node_count()));
    body.nodes[a] = led.back();
    mesh.coordinates.push_back(corner(body, a));
    mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.node_count()));
  }
  Model model = one_part(std::move(mesh));
  model.parts[0].material = StVenantKirchhoff{{.E = 20.0, .nu = 0.3, .rho = 0.5}};
  model.turning_bodies.push_back(body);
  const Vec3 travel = frame({0.1, 0.0, 0.2});
  for (int c = 0; c < 3; ++c) {
    PrescribedMotion motion{"turn", led, c, MotionKind::rotation, {{0.0, 1.0}, {0.0, 2.0}}};
    motion.rotation = ImposedRotation{centre, axis, {{0.0}, {travel[static_cast<std::size_t>(c)]}}};
    model.motions.push_back(motion);
  }
  ObstacleContact contact;
  contact.name = "shape";
  if (on_plane)
    contact.shape = Plane{frame({0.0, 0.0, -0.02}), frame({0.0, 0.0, 1.0})};
  else
    contact.shape = Cylinder{centre, axis, 0.96};
  contact.surface = {faces_of(*model.mesh, "ZMIN")};
  contact.law = {.eps_N = 40.0, .eps_T = 40.0, .mu = 0.3};
  contact.body = 0;
  model.contacts.emplace_back(contact);
  const Problem p(model, MassKind::lumped);
  const History run = march(*central(p), p.moving(frame({0.3, 0.1, -1.0})), 0.01, 150);
  EXPECT_TRUE(run.converged) << run.failure;
  EXPECT_GT(run.ledger.now().friction, 1e-3);
  EXPECT_LT(run.imbalance, 1e-13);
  EXPECT_LT(run.angular_momentum_error, 1e-12);
  std::vector<Vec3> u;
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n) u.push_back(vector_at(run.state.q, n));
  return u;
}

// Rounding of 150 steps, that contact makes grow tenfold or so: 1e-16 x 1e3 x 10.
TEST(TurnedObstacles, AreTheSameInEveryFrame) {
  for (const bool on_plane : {true, false}) {
    const std::vector<Vec3> here = after_hit(on_plane, as_it_is), there = after_hit(on_plane, in_other_frame);
    for (std::size_t n = 0; n + 4 < here.size(); ++n)  // the last four lead, and stand elsewhere in the shape
      EXPECT_LT(norm(subtract(in_other_frame(here[n]), there[n])), 1e-11) << n;
  }
}

/// A disc of triangles of radius 0.01 about the origin, in rings, its rim in the group RIM, as a Gmsh file.
std::string disc(int rings) {
  std::string nodes = "1 0 0 0\n", cells;
  int count = 0;
  std::vector<int> first{1};
  for (int k = 1, n = 2; k <= rings; ++k) {
    first.push_back(n);
    for (int j = 0; j < 6 * k; ++j, ++n) {
      const double angle = 2.0 * std::numbers::pi * j / (6 * k), r = 0.01 * k / rings;
      nodes += fmt::format("{} {:.17g} {:.17g} 0\n", n, r * std::cos(angle), r * std::sin(angle));
    }
  }
  const auto at = [&](int k, int j) { return k == 0 ? 1 : first[static_cast<std::size_t>(k)] + j % (6 * k); };
  const auto triangle = [&](int a, int b, int c) { cells += fmt::format("{} 2 2 1 1 {} {} {}\n", ++count, a, b, c); };
  for (int k = 1; k <= rings; ++k)
    for (int side = 0; side < 6; ++side)
      for (int i = 0; i < k; ++i) {
        const int out = side * k + i, in = side * (k - 1) + i;
        triangle(at(k, out), at(k, out + 1), at(k - 1, in));
        if (i + 1 < k) triangle(at(k, out + 1), at(k - 1, in + 1), at(k - 1, in));
      }
  for (int j = 0; j < 6 * rings; ++j)
    cells += fmt::format("{} 1 2 2 2 {} {}\n", ++count, at(rings, j), at(rings, j + 1));
  const int total = first.back() + 6 * rings - 1;
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"BALL\"\n1 2 \"RIM\"\n$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      total, nodes, count, cells);
}

// Two rollers that turn alike let what is between them spin in place, at -R / r times their rate: -3 x 20. A body that
// spins has twice its kinetic energy over its angular momentum as rate. Pressed by a hundredth of its radius, it rolls
// on less than its radius, and it rings about that rate by some per cent, which the mean over 60 ms leaves a tenth of.
TEST(TurnedObstacles, SpinABallBetweenTwoRollers) {
  const std::filesystem::path mesh =
      std::filesystem::temp_directory_path() / fmt::format("carom_disc_{}.msh", ::getpid());
  std::ofstream(mesh) << disc(6);
  std::string text = fmt::format(R"(units = "SI"
[mesh]
file = "{}"
[materials.rubber]
law = "neo_hookean"
E = 2.0e6
nu = 0.4
rho = 1100.0
[[part]]
name = "ball"
cells = "BALL"
material = "rubber"
section = "plane_strain"
[functions.press]
time = [0.0, 5.0e-3, 5.0e-3]
value = [1.0, 1.0, 0.0]
[functions.spin_up]
time = [0.0, 2.0e-2]
value = [0.0, 1.0]
)",
                                 mesh.string());
  for (const auto& [name, side] : {std::pair{"upper", 1.0}, std::pair{"lower", -1.0}})
    text += fmt::format(R"([[contact]]
name = "{}"
kind = "cylinder"
group = "RIM"
point = [0.0, {}, 0.0]
axis = [0.0, 0.0, 1.0]
radius = 0.03
velocity = [0.0, {}, 0.0]
function = "press"
angular_velocity = [0.0, 0.0, 20.0]
angular_function = "spin_up"
friction = 0.5
)",
                        name, 0.04 * side, -0.02 * side);
  const TemporaryCase run(text + R"([scheme]
kind = "central_differences"
[time]
end = 0.1
[output]
fields = []
curves_every = 10
[[probe]]
name = "middle"
point = [0.0, 0.0, 0.0]
quantities = ["displacement"]
)");
  ASSERT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
  const Columns energy = test::read_csv(run.result("energy.csv"));
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < energy.at("time").size(); ++i) {
    if (energy.at("time")[i] < 0.04) continue;
    sum += 2.0 * energy.at("kinetic")[i] / energy.at("angular_momentum_z")[i];
    count += 1.0;
  }
  EXPECT_NEAR(sum / count, -60.0, 0.02 * 60.0);
  const auto probe = last_row(run.result("probes.csv"));
  EXPECT_LT(std::hypot(probe.at("middle.displacement_x"), probe.at("middle.displacement_y")), 1e-4);
  std::filesystem::remove(mesh);
}

}  // namespace
}  // namespace carom::run_turned_obstacles_test
