// Ties that tear: what they dissipate, what they bear, and what is left of them, in every scheme whose forces need not
// be those of a stored energy.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contact/tie_rows.hpp"
#include "model/compatibility.hpp"
#include "schemes/scheme_table.hpp"
#include "solid/point_history.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_tearing_test {
namespace {

using namespace test;

constexpr CohesiveLaw glue{
    .normal_strength = 0.01, .shear_strength = 0.006, .normal_energy = 2e-4, .shear_energy = 3e-4, .stiffness = 10.0};

MassKind mass_of(SchemeKind scheme) {
  return is_explicit(scheme) ? MassKind::lumped : MassKind::consistent;
}
std::unique_ptr<Scheme> scheme_on(const Problem& p, SchemeKind kind, EnforcementKind enforcement, double h) {
  const SchemeSettings settings{.kind = kind, .enforcement = enforcement, .solver = SolverKind::cholesky};
  return make_scheme({p.system, settings, h, stable_step(p.system).omega_max_squared_free});
}

/// The tied blocks of the fixture (faces of 4 in all), their tie made one that tears, and contact between the same
/// faces where it is asked for.
Model glued(Model model, bool touches) {
  const TieContact tie = std::get<TieContact>(model.contacts.front());
  CohesiveZone zone;
  zone.name = "glue";
  zone.law = glue;
  zone.rows = cohesive_rows(model, tie, zone.notes);
  model.cohesive.push_back(std::move(zone));
  model.contacts.clear();
  if (!touches) return model;
  PairContact pair;
  pair.name = "glue";
  pair.slave = tie.slave;
  pair.master = tie.master;
  pair.law.eps_N = 2.0;
  model.contacts.emplace_back(std::move(pair));
  return model;
}

bool is_of_second(const Mesh& mesh, std::size_t n) {
  return mesh.coordinates[n][0] > 2.0 + 1e-9;
}

/// All nodes of the second block, those of its tied face among them.
std::vector<Index> second_block(const Mesh& mesh) {
  std::vector<Index> nodes = mesh.nodes_of("SLAVE");
  for (std::size_t n = 0; n < mesh.node_count(); ++n)
    if (is_of_second(mesh, n)) nodes.push_back(static_cast<Index>(n));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// The whole second block moved by `by`, in time 1, the first being held: a separation that is the same everywhere.
struct Pulled {
  explicit Pulled(const Vec3& by, TimeFunction path = {{0.0, 1.0}, {0.0, 1.0}}) : model(tied_blocks(0.0, 2, 0.0)) {
    const std::vector<Index> moved = second_block(*model.mesh);
    std::vector<Index> held;
    for (std::size_t n = 0; n < model.mesh->node_count(); ++n)
      if (!std::binary_search(moved.begin(), moved.end(), static_cast<Index>(n))) held.push_back(static_cast<Index>(n));
    for (int c = 0; c < 3; ++c) {
      TimeFunction along = path;
      for (double& value : along.value) value *= by[static_cast<std::size_t>(c)];
      model.motions.push_back({"pulled", moved, c, MotionKind::displacement, along});
      model.motions.push_back({"held", held, c});
    }
    model = glued(std::move(model), false);
  }
  Model model;
};

double fracture(const Vec3& by, int steps) {
  const Problem p(Pulled(by).model);
  const History run = march(*scheme_on(p, SchemeKind::statics, EnforcementKind::penalty, 1.0 / steps), p.moving({}),
                            1.0 / steps, steps);
  EXPECT_TRUE(run.converged) << run.failure;
  // One step that goes past it all has no force at either end, and no work by the trapezoidal rule.
  EXPECT_LE(run.imbalance, 1e-12 * run.ledger.scale());
  return run.ledger.now().fracture;
}

// Pulled apart in any direction: energy per area, 4 of it, by the linear criterion of the shares c^2 and s^2, whatever
// the steps; rounding of sums of some 1e2 terms.
TEST(Tearing, TakesItsEnergyPerAreaInAnyMode) {
  for (const int steps : {1, 7, 64}) {
    SCOPED_TRACE(steps);
    EXPECT_NEAR(fracture({0.2, 0.0, 0.0}, steps), 4.0 * glue.normal_energy, 1e-15);
    EXPECT_NEAR(fracture({0.0, 0.2, 0.0}, steps), 4.0 * glue.shear_energy, 1e-15);
    EXPECT_NEAR(fracture({0.0, -0.12, 0.16}, steps), 4.0 * glue.shear_energy, 1e-15);
    const double mixed = 1.0 / (0.36 / glue.normal_energy + 0.64 / glue.shear_energy);
    EXPECT_NEAR(fracture({0.12, 0.16, 0.0}, steps), 4.0 * mixed, 1e-15);
  }
}

// Torn by half and evaluated again from what it has become, glue bears what it bore, and no more of it is gone.
TEST(Tearing, IsNotDoneAgainByAStepThatIsOver) {
  const Problem p(Pulled({0.02, 0.01, 0.0}).model);
  std::vector<double> u(p.solid.dof_count(), 0.0), f(u.size()), g(u.size());
  for (const Index n : second_block(*p.model.mesh)) u[3 * static_cast<std::size_t>(n)] = 0.02;
  std::vector<double> history = initial_history(p.solid), end(history.size()), again(history.size());
  const double before = p.solid.evaluate(u, {.dt = 1.0, .history = history}, f, end).strain;
  const double later = p.solid.evaluate(u, {.dt = 1.0, .history = end, .is_over = true}, g, again).strain;
  EXPECT_GT(p.solid.cohesive().dissipated(end), 0.0);
  EXPECT_LT(p.solid.cohesive().dissipated(end), 4.0 * glue.normal_energy) << "the energy of the whole";
  EXPECT_EQ(again, end);
  EXPECT_EQ(g, f);
  EXPECT_EQ(later, before);
  EXPECT_GT(largest(f), 0.0);
  for (double& x : u) x *= 1.5;
  p.solid.evaluate(u, {.dt = 1.0, .history = end, .is_over = true}, g, again);
  EXPECT_EQ(again, end) << "at any displacement";
}

// Pressed, and pressed and sheared by less than it bears: nothing is lost. Pressed and sheared by more: what shear
// takes.
TEST(Tearing, IsNotDoneByPressing) {
  EXPECT_EQ(fracture({-0.3, 0.0, 0.0}, 3), 0.0);
  EXPECT_EQ(fracture({-0.3, 0.9 * glue.shear_strength / glue.stiffness, 0.0}, 3), 0.0);
  EXPECT_NEAR(fracture({-0.1, 0.2, 0.0}, 7), 4.0 * glue.shear_energy, 1e-15);
}

// Half torn, let back, pulled again: the force goes straight back to zero and comes back as straight, and the whole
// takes no more than without.
TEST(Tearing, LetsBackStraight) {
  const double opening = 0.02;  // between S / k = 0.001 and 2 G / S = 0.04
  const Problem p(Pulled({opening, 0.0, 0.0}, {{0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 1.0, 0.0, 0.5, 4.0}}).model);
  const auto scheme = scheme_on(p, SchemeKind::statics, EnforcementKind::penalty, 0.25);
  const std::vector<Index> pulled = second_block(*p.model.mesh);
  std::vector<double> force, lost;
  const History run = march(*scheme, p.moving({}), 0.25, 16, [&](const State& now) {
    double sum = 0.0;
    for (const Index n : pulled) sum += now.forces.internal[3 * static_cast<std::size_t>(n)];
    force.push_back(sum);
    lost.push_back(now.forces.stored.fracture);
  });
  ASSERT_TRUE(run.converged) << run.failure;
  const double start = glue.normal_strength / glue.stiffness, full = 2.0 * glue.normal_energy / glue.normal_strength;
  const double borne = 4.0 * glue.normal_strength * (full - opening) / (full - start);
  EXPECT_NEAR(force[4], borne, 1e-15);
  EXPECT_NEAR(force[6], 0.5 * borne, 1e-15);
  EXPECT_NEAR(force[8], 0.0, 1e-15);
  EXPECT_NEAR(force[12], 0.5 * borne, 1e-15);
  EXPECT_NEAR(force[16], 0.0, 1e-15);
  EXPECT_EQ(lost[4], lost[12]);
  EXPECT_NEAR(lost[16], 4.0 * glue.normal_energy, 1e-15);
}

struct Pair {
  SchemeKind scheme;
  EnforcementKind enforcement;
};

std::vector<Pair> tearing_schemes() {
  std::vector<Pair> all;
  for (const SchemeTraits& scheme : scheme_table) {
    const bool has_inertia = scheme.kind != SchemeKind::statics && scheme.kind != SchemeKind::modified_mass;
    if (!has_inertia || !scheme.takes_history) continue;
    for (const EnforcementTraits& enforcement : enforcement_table)
      if (takes(scheme.kind, enforcement.kind)) all.push_back({scheme.kind, enforcement.kind});
  }
  return all;
}

class TearingSchemes : public testing::TestWithParam<Pair> {};

// Two blocks that turn fast and move apart: the tie tears everywhere, takes its energy, and the momenta stay.
TEST_P(TearingSchemes, TakesItsEnergyAndNoMomentum) {
  const auto [kind, enforcement] = GetParam();
  for (const bool touches : {false, true}) {
    SCOPED_TRACE(touches ? "with contact" : "alone");
    Model model = tied_blocks(0.0, 2, 0.0);
    model.parts[0].material = NeoHookean{unit_material};
    const Problem p(glued(std::move(model), touches), mass_of(kind));
    State begin = p.moving({});
    const std::vector<Index> second = second_block(*p.model.mesh);
    for (std::size_t n = 0; n < p.model.mesh->node_count(); ++n) {
      const Vec3& X = p.model.mesh->coordinates[n];
      Vec3 v = cross({0.0, 0.0, 0.1}, subtract(X, {2.0, 1.0, 1.0}));
      v[0] += std::binary_search(second.begin(), second.end(), static_cast<Index>(n)) ? 0.05 : -0.05;
      std::copy(v.begin(), v.end(), begin.v.begin() + 3 * static_cast<std::ptrdiff_t>(n));
    }
    const double h = is_explicit(kind) ? 0.5 * stable_step(p.system).dt : 0.02;
    const History run = march(*scheme_on(p, kind, enforcement, h), begin, h, static_cast<int>(3.0 / h));
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_NEAR(run.ledger.now().fracture, 4.0 * glue.normal_energy, 0.03 * glue.normal_energy);  // nearly no shear
    for (const double damage : p.solid.cohesive().nodal_damage(run.state.points, p.model.mesh->node_count()))
      EXPECT_TRUE(damage == -1.0 || damage == 1.0);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    const double momentum = std::sqrt(2.0 * p.mass.total() * run.ledger.scale());
    EXPECT_LT(run.linear_momentum_error, 1e-9 * momentum);
    if (traits(kind).angular_momentum == AngularMomentum::exactly) {
      EXPECT_LT(run.angular_momentum_error, 1e-9 * momentum);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TearingSchemes, testing::ValuesIn(tearing_schemes()), [](const auto& of) {
  return std::string(traits(of.param.scheme).name) + "_" + std::string(traits(of.param.enforcement).name);
});

// A bar of length 4 that is pushed at its end for a time 1 at 0.05, five times the strength; the push comes back from
// the free end as a pull of the same size (one dimension, c = 1) and tears the tie, which is 1 from that end: what
// flies off has the momentum that is caught between them, 2 x stress x A x time of the push that is in there. A push of
// length 1 is all in the last 1 of the bar when its front and its tail meet at the tie: its momentum p = 0.05 A stays
// there, less what the tie gives on as it tears (its strength over the time that the opening takes).
TEST(Tearing, SpallsABarWhosePushComesBack) {
  StructuredBlock left, right;
  left.size = {3.0, 1.0, 1.0};
  right.size = {1.0, 1.0, 1.0};
  left.divisions = {60, 1, 1};
  right.divisions = {20, 1, 1};
  right.origin = {3.0, 0.0, 0.0};
  left.face_groups = {"XMIN", "MASTER", "", "", "", ""};
  right.face_groups = {"SLAVE", "XMAX", "", "", "", ""};
  Model model = one_part(make_structured_blocks({left, right}));
  model.parts[0].material = LinearElastic{{.E = 1.0, .nu = 0.0, .rho = 1.0}};
  TieContact tie;
  tie.name = "glue";
  tie.slave.facets = faces_of(*model.mesh, "SLAVE");
  tie.master.facets = faces_of(*model.mesh, "MASTER");
  model.contacts.emplace_back(std::move(tie));
  model = glued(std::move(model), true);
  model.cohesive[0].law.normal_energy = 2e-5;
  model.cohesive[0].law.stiffness = 200.0;
  std::get<PairContact>(model.contacts[0]).law.eps_N = 20.0;
  model.loads.push_back(
      Pressure{{faces_of(*model.mesh, "XMIN")}, 0.05, TimeFunction{{0.0, 1.0, 1.0001, 10.0}, {1.0, 1.0, 0.0, 0.0}}});
  const Problem p(std::move(model), MassKind::lumped);
  const double h = 0.8 * stable_step(p.system).dt;
  const auto scheme = scheme_on(p, SchemeKind::central_differences, EnforcementKind::penalty, h);
  const History run = march(*scheme, p.moving({}), h, static_cast<int>(7.0 / h));
  ASSERT_TRUE(run.converged) << run.failure;
  EXPECT_NEAR(run.ledger.now().fracture, 2e-5, 1e-18);
  EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
  double spalled = 0.0;
  for (const Index n : second_block(*p.model.mesh)) {
    const auto k = static_cast<std::size_t>(n);
    if (p.model.mesh->coordinates[k][0] < 3.0 - 1e-9) continue;
    spalled += p.mass.node_diagonal()[k] * run.state.v[3 * k];
  }
  EXPECT_GT(spalled, 0.5 * 0.05);
  const Momentum& total = run.ledger.momentum();
  EXPECT_NEAR(total.linear[0], 0.05, 1e-3);  // the push, as steps of 0.02 see its end
}

}  // namespace
}  // namespace carom::schemes_tearing_test
