// Parts that are rigid bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "math/vec3.hpp"
#include "model/turning_body.hpp"
#include "parallel/threads.hpp"
#include "run/run.hpp"
#include "run_fixture.hpp"
#include "solid/part_inertia.hpp"

namespace carom::run_rigid_parts_test {
namespace {

using namespace test;

/// A brick of 1 x 2 x 3 and mass 12 that is rigid; `rest` adds or ends the sections.
std::string brick(const std::string& rest, const std::string& more = "") {
  return R"(units = "SI"
[[mesh.block]]
origin = [-0.5, -1.0, -1.5]
size = [1.0, 2.0, 3.0]
divisions = [2, 2, 3]
groups = { cells = "BRICK", xmin = "X0", xmax = "X1", ymin = "Y0", ymax = "Y1", zmin = "Z0", zmax = "Z1" }
[materials.hard]
law = "j2"
E = 2.0e3
nu = 0.3
rho = 2.0
yield_stress = 1.0
[[part]]
name = "brick"
cells = "BRICK"
material = "hard"
[[rigid_body]]
name = "brick"
parts = ["brick"]
)" + more +
         rest;
}

const TurningBody& body_of(const Simulation& simulation) {
  return simulation.model().turning_bodies.front();
}

/// Omega of the body about its own axes.
Vec3 spin_of(const Simulation& simulation, const State& state) {
  const TurningBody& body = body_of(simulation);
  std::array<Vec3, 4> x = nodal_values(body, state.q);
  for (std::size_t a = 0; a < 4; ++a) x[a] = add(x[a], corner(body, a));
  const BodyFrame now = body_frame(body, x), rate = body_frame(body, nodal_values(body, state.v));
  const Vec3 omega = angular_velocity(now, rate);
  Vec3 own{};
  for (std::size_t i = 0; i < 3; ++i) own = add(own, scaled(body.axes[i], dot(omega, now.directors[i])));
  return own;
}

// Closed form: a brick a x b x c has I_xx = m (b^2 + c^2) / 12; two of them by Steiner's theorem. To rounding.
TEST(RigidParts, HaveTheInertiaOfTheirCells) {
  const Simulation simulation(
      parse_case(brick("[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n"), "case.toml"));
  const Part& part = simulation.model().parts.front();
  const std::array<const Part*, 1> one{&part};
  const PartInertia own = inertia_of(simulation.mesh(), one);
  EXPECT_NEAR(own.mass, 12.0, 1e-13);
  EXPECT_NEAR(norm(own.centre), 0.0, 1e-14);
  EXPECT_NEAR(own.moments[0], 4.0 + 9.0, 1e-13);
  EXPECT_NEAR(own.moments[1], 1.0 + 9.0, 1e-13);
  EXPECT_NEAR(own.moments[2], 1.0 + 4.0, 1e-13);
  EXPECT_NEAR(norm(own.products), 0.0, 1e-13);
  EXPECT_EQ(part.material.law->history.size(), 0U);  // what yields has nothing to remember where it is rigid
}

TEST(RigidParts, OfSeveralPartsAreOneBody) {
  const std::string two = R"(units = "SI"
[[mesh.block]]
size = [2.0, 1.0, 1.0]
divisions = [2, 1, 1]
groups = { cells = "LONG" }
[[mesh.block]]
origin = [0.0, 1.0, 0.0]
size = [1.0, 2.0, 1.0]
divisions = [1, 3, 2]
groups = { cells = "HIGH" }
[materials.light]
law = "linear_elastic"
E = 1.0
nu = 0.3
rho = 1.0
[materials.heavy]
law = "linear_elastic"
E = 1.0
nu = 0.3
rho = 3.0
[[part]]
name = "long"
cells = "LONG"
material = "light"
[[part]]
name = "high"
cells = "HIGH"
material = "heavy"
[[rigid_body]]
name = "angle"
parts = ["long", "high"]
[scheme]
kind = "central_differences"
[time]
end = 1.0
)";
  const Simulation simulation(parse_case(two, "case.toml"));
  const std::array<const Part*, 2> both{&simulation.model().parts[0], &simulation.model().parts[1]};
  const PartInertia own = inertia_of(simulation.mesh(), both);
  const double m_1 = 2.0, m_2 = 6.0, x = (m_1 * 1.0 + m_2 * 0.5) / 8.0, y = (m_1 * 0.5 + m_2 * 2.0) / 8.0;
  EXPECT_NEAR(own.mass, 8.0, 1e-14);
  EXPECT_NEAR(own.centre[0], x, 1e-14);
  EXPECT_NEAR(own.centre[1], y, 1e-14);
  EXPECT_NEAR(own.centre[2], 0.5, 1e-14);
  const auto square = [](double a) { return a * a; };
  const double I_zz = m_1 * (4.0 + 1.0) / 12.0 + m_1 * (square(1.0 - x) + square(0.5 - y)) + m_2 * (1.0 + 4.0) / 12.0 +
                      m_2 * (square(0.5 - x) + square(2.0 - y));
  EXPECT_NEAR(own.moments[2], I_zz, 1e-13);
  EXPECT_NEAR(own.products[0], -(m_1 * (1.0 - x) * (0.5 - y) + m_2 * (0.5 - x) * (2.0 - y)), 1e-13);
  EXPECT_EQ(simulation.model().turning_bodies.size(), 1U);
  const Simulation moving(
      parse_case(two + "[[initial]]\npart = \"long\"\nvelocity = [0.0, 3.0, 0.0]\n[[initial]]\npart = "
                       "\"high\"\nvelocity = [0.0, 3.0, 0.0]\n",
                 "case.toml"));
  const State first = moving.initial_state();
  for (const Vec3& v : nodal_values(body_of(moving), first.v))
    EXPECT_NEAR(norm(subtract(v, Vec3{0.0, 3.0, 0.0})), 0.0, 1e-14);
}

const char* const tumbling = R"([[initial]]
part = "brick"
velocity = [0.2, 0.0, 0.0]
angular_velocity = [1.0e-3, 2.0, 1.0e-3]
centre = [0.0, 0.0, 0.0]
)";

// A free brick that spins about its middle axis turns over again and again (Dzhanibekov; L. Poinsot 1834), with the
// momenta that it had: their changes are rounding of some thousand steps. What it has of energy the energy-momentum
// scheme keeps to the residual of its iterations, central differences to the order of the step.
TEST(RigidParts, TurnOverAboutTheMiddleAxisWithTheirMomentaAndEnergy) {
  struct Row {
    const char* scheme;
    const char* step;
    double energy;
  };
  for (const Row& row : {Row{"central_differences", "", 1e-4}, Row{"energy_momentum", "step = 0.02\n", 1e-10}}) {
    SCOPED_TRACE(row.scheme);
    const Simulation simulation(parse_case(
        brick(std::string(tumbling) + "[scheme]\nkind = \"" + row.scheme + "\"\n[time]\nend = 30.0\n" + row.step),
        "case.toml"));
    March march(simulation);
    march.start();
    const EnergyTerms first = march.ledger().now();
    const Momentum before = march.ledger().momentum();
    EXPECT_NEAR(first.kinetic, 0.5 * 12.0 * 0.04 + 0.5 * 10.0 * 4.0, 1e-3);
    bool has_turned_over = false;
    double back = 0.0;
    while (!march.at_end()) {
      march.step();
      ASSERT_FALSE(march.has_failed()) << march.message();
      const double y = spin_of(simulation, march.state())[1];
      has_turned_over = has_turned_over || y < -1.9;
      if (has_turned_over) back = std::max(back, y);
    }
    EXPECT_TRUE(has_turned_over);
    EXPECT_GT(back, 1.9);
    const Momentum& after = march.ledger().momentum();
    EXPECT_LE(norm(subtract(after.linear, before.linear)), 1e-11);
    EXPECT_LE(norm(subtract(after.angular, before.angular)), 1e-10 * 20.0);
    EXPECT_LE(std::abs(march.ledger().imbalance()), 1e-10 * first.kinetic);
    const EnergyTerms& last = march.ledger().now();
    EXPECT_LE(std::abs(last.kinetic + last.strain - first.kinetic), row.energy * first.kinetic);
    EXPECT_LE(march.body_strain(), 1e-3);
  }
}

// Every node is where the rigid motion of the body has it: its distances from all others stay, but for the strain of
// the body.
TEST(RigidParts, NodesFollowTheBody) {
  const Simulation simulation(parse_case(
      brick(std::string(tumbling) + "[scheme]\nkind = \"central_differences\"\n[time]\nend = 5.0\n"), "case.toml"));
  March march(simulation);
  march.start();
  while (!march.at_end()) march.step();
  const State& state = march.state();
  const std::vector<Vec3>& X = simulation.mesh().coordinates;
  const std::size_t nodes = 36;
  double turned = 0.0;
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Vec3 before = subtract(X[a], X[b]);
      const Vec3 now = add(before, subtract(vector_at(state.q, a), vector_at(state.q, b)));
      EXPECT_NEAR(norm(now), norm(before), 2.0 * march.body_strain() * norm(before));
      turned = std::max(turned, norm(subtract(now, before)));
      // v_a - v_b is normal to the line between them
      EXPECT_NEAR(dot(subtract(vector_at(state.v, a), vector_at(state.v, b)), now), 0.0,
                  1e-2 * norm(before) * norm(before));
    }
  EXPECT_GT(turned, 1.0);
}

// A pressure p on a face of area A and a force on each node of the other: the acceleration is their sum over m, and the
// moment of the accelerations of the four masses about the centre that of the forces. To rounding.
TEST(RigidParts, LoadsMoveAndTurnThem) {
  const std::string text = brick(R"([[load]]
pressure = 3.0
group = "X0"
[[load]]
force = [0.0, 0.0, 0.5]
group = "X1"
[scheme]
kind = "central_differences"
[time]
end = 0.01
)");
  const Simulation simulation(parse_case(text, "case.toml"));
  March march(simulation);
  march.start();
  const TurningBody& body = body_of(simulation);
  const BodyFrame rate = body_frame(body, nodal_values(body, march.state().a));
  const double upward = 0.5 * 12.0;  // on each of 12 nodes at x = 0.5
  EXPECT_NEAR(rate.centre[0], 3.0 * 6.0 / 12.0, 1e-12);
  EXPECT_NEAR(rate.centre[2], upward / 12.0, 1e-12);
  Vec3 moment{};
  for (std::size_t a = 0; a < 4; ++a)
    moment = add(moment, cross(corner(body, a),
                               scaled(vector_at(march.state().a, static_cast<std::size_t>(body.nodes[a])), 3.0)));
  EXPECT_NEAR(moment[1], -0.5 * upward, 1e-12);
  EXPECT_NEAR(moment[0], 0.0, 1e-12);
}

/// A block of soft cells under a hammer of another part or under a rigid box of the same size, mass and inertia.
std::string hit(bool by_part, const std::string& spin, const std::string& scheme) {
  const std::string block = R"(units = "SI"
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [2, 2, 2]
groups = { cells = "BLOCK", zmin = "FOOT", zmax = "HEAD" }
)";
  const std::string hammer = R"([[mesh.block]]
origin = [-0.5, -0.75, 1.005]
size = [2.0, 2.5, 0.5]
divisions = [1, 1, 1]
groups = { cells = "HAMMER", zmin = "FACE" }
[[part]]
name = "hammer"
cells = "HAMMER"
material = "steel"
[materials.steel]
law = "linear_elastic"
E = 2.0e3
nu = 0.3
rho = 8.0
[[rigid_body]]
name = "hammer"
parts = ["hammer"]
rigidity = 0.5
[[initial]]
part = "hammer"
velocity = [0.0, 0.0, -0.5]
)";
  const std::string soft = R"([materials.soft]
law = "linear_elastic"
E = 10.0
nu = 0.3
rho = 1.0
[[part]]
name = "block"
cells = "BLOCK"
material = "soft"
[[support]]
nodes = "FOOT"
blocked = ["x", "y", "z"]
)";
  const std::string turn = spin.empty() ? "" : "angular_velocity = " + spin + "\n";
  const std::string end = "[scheme]\n" + scheme + "[time]\nend = 1.0\nstep = 5.0e-4\n";
  if (by_part)
    return block + hammer + (spin.empty() ? "" : turn + "centre = [0.5, 0.5, 1.255]\n") + soft +
           "[[contact]]\nname = \"c\"\nkind = \"pair\"\nmethod = \"node_to_surface\"\ngroup = \"HEAD\"\nmaster = "
           "\"FACE\"\n" +
           end;
  return block + soft +
         "[[contact]]\nname = \"c\"\nkind = \"box\"\ngroup = \"HEAD\"\nlower = [-0.5, -0.75, 1.005]\nupper = [1.5, "
         "1.75, 1.505]\nmass = 20.0\ninertia = [10.833333333333334, 7.083333333333333, 17.083333333333332]\n"
         "velocity = [0.0, 0.0, -0.5]\n" +
         turn + end;
}

// The same body two ways. Where it does not turn all operations are the same sums, to rounding; where it turns, faces
// turn about points that are half a step apart.
TEST(RigidParts, HitAsTheFreeBoxDoes) {
  struct Row {
    const char* spin;
    double tolerance;
  };
  for (const Row& row : {Row{"", 1e-12}, Row{"[0.02, 0.05, 0.0]", 1e-6}}) {
    SCOPED_TRACE(row.spin);
    const std::string scheme = "kind = \"central_differences\"\nenforcement = \"impulse\"\n";
    const Simulation part(parse_case(hit(true, row.spin, scheme), "part.toml")),
        box(parse_case(hit(false, row.spin, scheme), "box.toml"));
    March a(part), b(box);
    a.start();
    b.start();
    double most = 0.0;
    while (!a.at_end()) {
      a.step();
      b.step();
      ASSERT_FALSE(a.has_failed() || b.has_failed());
      EXPECT_NEAR(a.ledger().now().kinetic, b.ledger().now().kinetic, row.tolerance * 2.5);
      EXPECT_NEAR(a.ledger().now().strain, b.ledger().now().strain, row.tolerance * 2.5);
      most = std::max(most, a.ledger().now().strain);
    }
    EXPECT_GT(most, 0.5);
    EXPECT_LE(norm(subtract(a.ledger().momentum().linear, b.ledger().momentum().linear)), row.tolerance * 10.0);
  }
}

std::string refusal(const std::string& rest, const std::string& more = "") {
  return case_error(brick(rest, more)).what();
}

TEST(RigidParts, RefuseWhatTheyCannotDo) {
  const std::string end = "[scheme]\nkind = \"central_differences\"\n[time]\nend = 1.0\n";
  const auto says = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  says(refusal("[[support]]\nnodes = \"X0\"\nblocked = [\"x\"]\n" + end),
       "12 of the 36 nodes of rigid body \"brick\" in \"X0\"; expected all nodes of a rigid body, or none");
  says(refusal("[[initial]]\nnodes = \"X0\"\nvelocity = [1.0, 0.0, 0.0]\n" + end), "12 of the 36 nodes of rigid body");
  says(refusal("[[initial]]\npart = \"brick\"\nvelocity_field = [\"0.1 * x\", \"0\", \"0\"]\n" + end),
       "velocities that no rigid body has, by 0.05");
  says(refusal("[scheme]\nkind = \"statics\"\n[time]\nend = 1.0\nstep = 0.5\n"), "a rigid body, with statics");
  says(refusal("[[erosion]]\npart = \"brick\"\ntime = 0.5\n" + end), "whose cells go by [[erosion]]");
  says(refusal(end, "[[rigid_body]]\nname = \"again\"\nparts = [\"brick\"]\n"), "\"brick\" in two rigid bodies");
  says(refusal(end, "mass = 3.0\ninertia = [1.0, 1.0, 5.0]\n"), "one is not smaller than the sum of the others");
  says(refusal("[scheme]\nkind = \"modified_mass\"\n[time]\nend = 1.0\n"), "a rigid body, with modified_mass");
  says(refusal("[[contact]]\nname = \"floor\"\nkind = \"plane\"\ngroup = \"Z0\"\npoint = [0.0, 0.0, -2.0]\nnormal = "
               "[0.0, 0.0, 1.0]\n[scheme]\nkind = \"cd_lagrange\"\n[time]\nend = 1.0\n"),
       "\"floor\" between sides neither of which deforms, with exact contact");
  says(refusal("[[spring]]\nnodes = \"X0\"\nstiffness = [1.0, 1.0, 1.0]\n" + end), "a spring");
  says(refusal("[[point_mass]]\nnodes = \"X0\"\nmass = 1.0\n" + end), "a point mass");
}

// Contact of all with all knows which parts a row is between, also where it sees the four nodes of a body: what the
// places of contact.csv have given is the momentum that the hammer has lost.
TEST(RigidParts, HaveTheImpulsesOfTheirPairsOfParts) {
  const std::string text = replaced(
      hit(true, "", "kind = \"central_differences\"\n"),
      "[[contact]]\nname = \"c\"\nkind = \"pair\"\nmethod = \"node_to_surface\"\ngroup = \"HEAD\"\nmaster = \"FACE\"\n",
      "[[contact]]\nname = \"c\"\nkind = \"all\"\n");
  const TemporaryCase one(text + "[[probe]]\nname = \"hammer\"\npart = \"hammer\"\nquantities = [\"momentum\"]\n");
  one.run();
  const std::map<std::string, double> contact = last_row(one.result("contact.csv"));
  const double momentum = last_row(one.result("probes.csv")).at("hammer.momentum_z");
  double impulse = 0.0;
  for (const auto& [name, value] : contact)
    if (name.find("impulse_z") != std::string::npos) impulse += value;
  EXPECT_GT(std::abs(impulse), 1.0);
  EXPECT_NEAR(std::abs(impulse), std::abs(momentum + 20.0 * 0.5), 1e-9);  // of mass 20, thrown at -0.5
}

// A body of two parts begins with the velocity that both have been given; what drives all of its nodes has a reaction,
// the inertia of the body: mass 12 at an acceleration of 2 (velocity 2 t).
TEST(RigidParts, HaveReactionsWhereTheyAreDriven) {
  const TemporaryCase one(
      brick("[functions.ramp]\nkind = \"table\"\ntime = [0.0, 1.0]\nvalue = [0.0, 2.0]\n[[support]]\nnodes = "
            "\"BRICK\"\nvelocity = { z = 1.0, function = \"ramp\" }\n[scheme]\nkind = "
            "\"central_differences\"\n[time]\nend = 0.5\n[[probe]]\nname = \"tool\"\ngroup = "
            "\"BRICK\"\nquantities = [\"displacement\", \"reaction\"]\n"));
  one.run();
  const std::map<std::string, double> row = last_row(one.result("probes.csv"));
  EXPECT_NEAR(row.at("tool.reaction_z"), 24.0, 1e-9);
  EXPECT_NEAR(row.at("tool.displacement_z"), 0.25, 1e-12);
}

// All nodes together are held and led as any others.
TEST(RigidParts, AreLedByWhatIsImposedOnAllOfTheirNodes) {
  const Simulation simulation(
      parse_case(brick("[functions.ramp]\nkind = \"table\"\ntime = [0.0, 1.0]\nvalue = [0.0, 2.0]\n[[support]]\nnodes "
                       "= \"BRICK\"\nblocked = "
                       "[\"x\", \"y\"]\nvelocity = { z = 1.0, function = \"ramp\" }\n[scheme]\nkind = "
                       "\"central_differences\"\n[time]\nend = 1.0\n"),
                 "case.toml"));
  March march(simulation);
  march.start();
  while (!march.at_end()) march.step();
  for (std::size_t n = 0; n < 36; ++n) {
    EXPECT_NEAR(march.state().q[3 * n + 2], 1.0, 1e-12);  // the integral of 2 t
    EXPECT_NEAR(march.state().q[3 * n], 0.0, 1e-14);
  }
}

// A run that has been stopped goes on with the same bits, and one of two threads has those of one.
TEST(RigidParts, GoOnFromASnapshotAndOnTwoThreadsToTheBit) {
  const std::string text = hit(true, "[0.3, 0.4, 0.0]", "kind = \"central_differences\"\n");
  const Simulation simulation(parse_case(text, "case.toml"));
  const auto end_of = [&](int threads, bool stops) {
    set_threads(threads);
    carom::Run run(simulation, "", {});
    run.begin();
    for (int i = 0; i < 500; ++i) run.step();
    const std::shared_ptr<const Snapshot> snapshot = run.save();
    carom::Run other(simulation, "", {});
    other.restore(*snapshot);
    carom::Run& last = stops ? other : run;
    for (int i = 0; i < 500; ++i) last.step();
    return last.march().state().q;
  };
  const std::vector<double> whole = end_of(1, false);
  EXPECT_EQ(end_of(2, false), whole);
  EXPECT_EQ(end_of(1, true), whole);
  set_threads(0);
}

}  // namespace
}  // namespace carom::run_rigid_parts_test
