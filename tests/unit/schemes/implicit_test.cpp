// Every implicit scheme: order, damping of high frequencies, failures without trace, thread bits, contact.
#include <gtest/gtest.h>

#include <numbers>

#include "schemes/statics.hpp"
#include "schemes_impact_bar.hpp"
#include "schemes_implicit.hpp"

namespace carom::schemes_implicit_test {
namespace {

using namespace test;

/// The guided column of one cell: u_z of the head is an oscillator of omega^2 = C / (share rho), consistent mass, with
/// C = E (1 - nu) / ((1 + nu) (1 - 2 nu)), share 1/3 (see schemes_order_test.cpp).
Model guided_cell() {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  block(model, "BLOCK", {0, 1});
  block(model, "ZMIN", {2});
  return model;
}

const double omega = [] {
  const auto& m = unit_material;
  return std::sqrt(3.0 * m.E * (1 - m.nu) / ((1 + m.nu) * (1 - 2 * m.nu)) / m.rho);
}();

State released(const Problem& p, double height) {
  State begin = p.moving({});
  for (const Index node : p.model.mesh->nodes_of("ZMAX")) begin.q[3 * static_cast<std::size_t>(node) + 2] = height;
  return begin;
}

std::size_t head(const Problem& p) {
  return 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("ZMAX")[0]) + 2;
}

/// Error of displacement and velocity after 1.3 periods in n steps.
double error_of(const ImplicitScheme& one, int n) {
  const Problem p(guided_cell());
  const double end = 1.3 * 2.0 * std::numbers::pi / omega, h = end / n;
  const History run = march(*one.with(p, h), released(p, 0.1), h, n);
  const double u = 0.1 * std::cos(omega * end), v = -0.1 * omega * std::sin(omega * end);
  return std::max(std::abs(run.state.q[head(p)] - u), std::abs(run.state.v[head(p)] - v) / omega);
}

double expected_order(const std::string& name) {
  return name.starts_with("newmark") || name == "moreau_jean_dissipative" ? 1.0 : 2.0;
}

TEST(ImplicitSchemes, HaveTheirOrder) {
  for (const ImplicitScheme& one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    const double order = expected_order(one.name);
    const int n = order == 1.0 ? 400 : 100;  // the next term of the error changes what is observed by less than 0.05
    EXPECT_NEAR(std::log2(error_of(one, n) / error_of(one, 2 * n)), order, 0.05);
  }
}

// At omega h = 1e3 the amplification is that of infinite frequency to 1e-6: the spectral radius of the literature. More
// steps would meet the tolerance of equilibrium.
TEST(ImplicitSchemes, DampHighFrequenciesAsTheirSpectralRadiusSays) {
  const std::vector<std::pair<GeneralizedAlphaParameters, double>> cases{
      {newmark_parameters(0.25, 0.5), 1.0},
      {chung_hulbert_parameters(0.8), 0.8},
      {chung_hulbert_parameters(0.5), 0.5},
      {hht_parameters(-0.05), 0.95 / 1.05},  // (1 + alpha) / (1 - alpha) = rho_inf (Hughes 1987, section 9.3)
      {wbz_parameters(-0.05), 0.95 / 1.05}};
  const double h = 1e3 / omega;
  for (const auto& [parameters, radius] : cases) {
    const Problem p(guided_cell());
    const auto scheme = generalized_alpha(p, h, parameters);
    std::vector<double> u;
    const History run =
        march(*scheme, released(p, 0.1), h, 40, [&](const State& state) { u.push_back(std::abs(state.q[head(p)])); });
    ASSERT_TRUE(run.converged) << run.failure;
    // u_n ~ n^2 radius^n where three roots coincide: over these steps 4^(1/20) = 1.07 of the radius, and 2 % about it.
    EXPECT_NEAR(std::pow(u[40] / u[20], 1.0 / 20.0), radius, 0.09 * radius);
  }
}

// The smooth motion of the nonsmooth scheme is that of Chung and Hulbert, arranged about another acceleration; two of
// its roots coincide at infinite frequency (their eq. 25), one lies in between.
TEST(NonsmoothGeneralizedAlphaScheme, HasItsSpectralRadius) {
  const double h = 1e3 / omega;
  for (const double radius : {1.0, 0.8, 0.5}) {
    const Problem p(guided_cell());
    std::vector<double> u;
    const History run = march(*nonsmooth_scheme("", radius).with(p, h), released(p, 0.1), h, 40,
                              [&](const State& state) { u.push_back(std::abs(state.q[head(p)])); });
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_NEAR(std::pow(u[40] / u[20], 1.0 / 20.0), radius, 0.09 * radius);  // as above
  }
}

// Its dissipation is a quadratic form of da, weighted by 1 - rho_inf: nothing at all for rho_inf = 1.
TEST(NonsmoothGeneralizedAlphaScheme, KeepsTheEnergyOfALinearBodyForASpectralRadiusOfOne) {
  Model model = one_part(block_mesh({2, 2, 3}, 0.15));
  block(model, "ZMIN", {0, 1, 2});
  const Problem p(model);
  State begin = p.moving({});
  begin.v = random_vector(p.solid.dof_count(), 3);
  for (const double radius : {1.0, 0.8}) {
    double first = 0.0, last = 0.0;
    const History run = march(*nonsmooth_scheme("", radius).with(p, 0.3), begin, 0.3, 200, [&](const State& state) {
      last = state.forces.stored.mechanical();
      if (first == 0.0) first = last;
    });
    ASSERT_TRUE(run.converged) << run.failure;
    if (radius == 1.0)
      EXPECT_NEAR(last, first, 1e-10 * first);
    else
      EXPECT_LT(last, 0.9 * first);
  }
}

TEST(ImplicitSchemes, StayBoundedAtLongSteps) {
  Model model = one_part(block_mesh({2, 2, 3}, 0.15));
  block(model, "ZMIN", {0, 1, 2});
  const Problem p(model);
  State begin = p.moving({});
  begin.v = random_vector(p.solid.dof_count(), 3);
  for (const ImplicitScheme& one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    const double h = 50.0;  // periods of the block are 1 to 20
    double largest_energy = 0.0, first = 0.0;
    march(*one.with(p, h), begin, h, 200, [&](const State& state) {
      const double energy = state.forces.stored.mechanical();
      if (first == 0.0) first = energy;
      largest_energy = std::max(largest_energy, energy);
    });
    EXPECT_LT(largest_energy, 4.0 * first);  // schemes with gamma > 1/2 may lend for a step; see Krenk's identity
  }
}

/// A block that touches a plane in the first step, sliding.
Model touching() {
  Model model = one_part(block_mesh({2, 2, 2}, 0.1));
  model.contacts.emplace_back(plane_below(model, 0.005, 20.0, {10.0, 0.3}));
  return model;
}

TEST(ImplicitSchemes, LeaveTheStateWhereAStepFails) {
  for (ImplicitScheme one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    const Problem p(touching());
    one.settings.max_iterations = 0;
    const double h = 0.1;
    const auto scheme = one.with(p, h);
    State state = p.moving({0.1, 0.05, -0.2}), next;
    scheme->start(state, h);
    const State kept = state;
    const StepReport failed = scheme->step(state, {h, h, 1e-12}, next);
    EXPECT_FALSE(failed.converged);
    EXPECT_FALSE(failed.failure.empty());
    EXPECT_EQ(state, kept);
  }
}

// Made again after a longer one, steps come out the same to the bit.
TEST(ImplicitSchemes, AreNotTouchedByAStepThatIsGivenUp) {
  for (const ImplicitScheme& one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    std::vector<State> ends;
    for (const bool longer_first : {false, true}) {
      const Problem p(touching());
      const double h = 0.05;
      const auto scheme = one.with(p, h);
      State state = p.moving({0.1, 0.05, -0.2}), next;
      scheme->start(state, h);
      bool touched = false;
      for (int i = 1; i <= 4; ++i) {
        if (longer_first) {
          ASSERT_TRUE(scheme->step(state, {(i + 1) * h, 2.0 * h, 1e-14}, next).converged);
        }
        const StepReport report = scheme->step(state, {i * h, h, 1e-14}, next);
        ASSERT_TRUE(report.converged) << report.failure;
        std::swap(state, next);
        touched = touched || largest(state.forces.contact.dense()) > 0.0;
      }
      EXPECT_TRUE(touched);
      ends.push_back(state);
    }
    EXPECT_TRUE(ends[0] == ends[1]);
  }
}

// A response says which part of a force a damper gives: none of what conditions decide. Springs that act in a later
// stage would book it.
TEST(ImplicitSchemes, HaveNoDampersBesideMultipliers) {
  for (const ImplicitScheme& one : implicit_schemes()) {
    if (!traits(one.settings.enforcement).is_exact) continue;
    SCOPED_TRACE(one.name);
    const Problem p(touching());
    bool touched = false;
    const History run = march(*one.with(p, 0.05), p.moving({0.1, 0.05, -0.2}), 0.05, 2, [&](const State& state) {
      const ContactResponse& rows = state.forces.rows;
      touched = touched || largest(state.forces.contact.dense()) > 0.0;
      EXPECT_EQ(rows.damper, std::vector<double>(rows.status.size(), 0.0));
    });
    EXPECT_TRUE(run.converged) << run.failure;
    EXPECT_TRUE(touched);
  }
}

TEST(ImplicitSchemes, GiveTheSameBitsFromAnyNumberOfThreads) {
  Model model = one_part(block_mesh({6, 6, 8}, 0.15));
  model.contacts.emplace_back(plane_below(model, 0.002, 20.0, {10.0, 0.3}));
  for (const ImplicitScheme& one : implicit_schemes()) {
    if (one.name.starts_with("wbz") || one.name.starts_with("hht")) continue;  // the parameters alone differ
    SCOPED_TRACE(one.name);
    std::vector<State> states;
    for (const int threads : {1, 2, 4}) {
      set_threads(threads);
      const Problem p(model);
      const History run = march(*one.with(p, 0.05), p.moving({0.1, 0.05, -0.2}), 0.05, 2);
      EXPECT_TRUE(run.converged) << run.failure;
      states.push_back(run.state);
    }
    set_threads(0);
    EXPECT_TRUE(states[1] == states[0]);
    EXPECT_TRUE(states[2] == states[0]);
  }
}

/// Powers of two, by which every product, quotient and root of squares is as exact as in the units themselves.
struct Units {
  double length = 1.0, mass = 1.0;
  double pressure() const { return mass / length; }
  double energy() const { return mass * length * length; }
};

/// A block that comes down aslant on another one: rows that turn with their facets.
Model aslant(const char* law, const Units& unit) {
  StructuredBlock lower, upper;
  lower.size = {3, 3, 1};
  lower.divisions = {3, 3, 1};
  lower.face_groups = {"", "", "", "", "FOOT", "MASTER"};
  upper.size = {2, 2, 1};
  upper.divisions = {2, 2, 1};
  upper.origin = {0.45, 0.4, 1.01};
  upper.face_groups = {"", "", "", "", "SLAVE", ""};
  Mesh mesh = make_structured_blocks({lower, upper});
  for (Vec3& x : mesh.coordinates) {
    if (x[2] > 1.005) x[2] += 0.02 * x[0] + 0.01 * x[1];
    for (double& coordinate : x) coordinate *= unit.length;
  }
  const double density = unit.mass / (unit.length * unit.length * unit.length);
  Model model = one_part(std::move(mesh), Material(law, 1.5 * density, {{"E", 2.0 * unit.pressure()}, {"nu", 0.3}}));
  block(model, "FOOT", {0, 1, 2});
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  pair.law.eps_N = 20.0 * unit.pressure() / unit.length;
  model.contacts.emplace_back(pair);
  return model;
}

class Steps : public testing::TestWithParam<const char*> {};  // of bodies of this law

// Nothing is compared with a number that has a unit: in about megametres and picograms a motion has the same bits.
TEST_P(Steps, HaveTheSameBitsInAnyUnits) {
  const Units small{std::ldexp(1.0, -20), std::ldexp(1.0, 40)};
  const double h = 0.04;
  for (const ImplicitScheme& one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    std::vector<State> ends;
    for (const Units& unit : {Units{}, small}) {
      const Problem p(aslant(GetParam(), unit));
      State state = p.moving({}), next;
      for (std::size_t n = 0; n < p.model.mesh->node_count(); ++n)
        if (p.model.mesh->coordinates[n][2] > 1.005 * unit.length) state.v[3 * n + 2] = -0.3 * unit.length;
      const auto scheme = one.with(p, h);
      scheme->start(state, h);
      for (int i = 1; i <= 3; ++i) {
        const StepReport report = scheme->step(state, {i * h, h, 1e-9 * unit.energy()}, next);
        ASSERT_TRUE(report.converged) << report.failure;
        std::swap(state, next);
      }
      ends.push_back(state);
    }
    EXPECT_GT(largest(ends[0].forces.contact.dense()), 0.0);
    for (std::size_t i = 0; i < ends[0].q.size(); ++i) {
      EXPECT_EQ(ends[1].q[i], small.length * ends[0].q[i]);
      EXPECT_EQ(ends[1].v[i], small.length * ends[0].v[i]);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(, Steps, testing::Values("linear_elastic", "neo_hookean"),
                         [](const auto& of) { return std::string(of.param); });

// A cell that hangs from its head and whose foot is pulled onto the plane that it touches: nothing moves, and a step
// that goes on from another one at rest begins with its solution, whatever beta. Conjugate gradients count that.
TEST(ImplicitSchemes, BeginWithTheSolutionAtRestOnRows) {
  for (const GeneralizedAlphaParameters& parameters :
       {newmark_parameters(0.25, 0.5), newmark_parameters(0.4, 0.5), hht_parameters(-0.2), wbz_parameters(-0.2),
        chung_hulbert_parameters(0.5)}) {
    Model model = one_part(block_mesh({1, 1, 1}, 0.0));
    block(model, "BLOCK", {0, 1});
    block(model, "ZMAX", {2});
    model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMIN")}, -0.1, {}});
    model.contacts.emplace_back(plane_below(model, 0.0, 20.0));
    const Problem p(model);
    const double h = 0.1;
    const auto scheme = generalized_alpha(
        p, h, parameters, {.enforcement = EnforcementKind::lagrange, .solver = SolverKind::conjugate_gradients});
    State state = p.moving({}), next;
    scheme->start(state, h);
    std::vector<int> iterations;
    for (int i = 1; i <= 2; ++i) {
      const StepReport report = scheme->step(state, {i * h, h, 1e-14}, next);
      ASSERT_TRUE(report.converged) << report.failure;
      iterations.push_back(report.linear_iterations);
      std::swap(state, next);
    }
    EXPECT_GT(iterations[0], 0);
    EXPECT_EQ(iterations[1], 0) << parameters.beta;
    double force = 0.0;
    for (std::size_t i = 2; i < state.forces.contact.size(); i += 3) force += state.forces.contact[i];
    EXPECT_NEAR(force, 0.1, 1e-14) << "the pressure on a face of area 1";
  }
}

/// Figures of a one-dimensional program for this bar (100 two-node elements, Courant number 1), and the mass with which
/// they are met.
struct Reference {
  ImplicitScheme scheme;
  MassKind mass;
  double error, peak, energy;
};

std::vector<Reference> references() {
  using enum MassKind;
  const EnforcementKind plain = EnforcementKind::plain;
  std::vector<Reference> all{
      {alpha_scheme("trapezoidal", newmark_parameters(0.25, 0.5), plain), consistent, 1.43, 3.48, 10.9},
      {alpha_scheme("newmark", newmark_parameters(0.28, 0.55), plain), consistent, 0.253, 2.18, 0.954},
      {alpha_scheme("hht", hht_parameters(-0.2), plain), consistent, 0.181, 2.04, 0.981},
      {alpha_scheme("generalized_alpha", chung_hulbert_parameters(0.5), plain), consistent, 0.110, 1.50, 0.980}};
  for (const ImplicitScheme& one : implicit_schemes()) {
    if (one.name == "bathe_plain") all.push_back({one, consistent, 0.117, 1.75, 0.988});
    // What stops at the row is in the program too.
    if (one.name == "bathe_lagrange") all.push_back({one, consistent, 0.0774, 1.076, 0.988});
    if (one.name == "trapezoidal_lagrange") all.push_back({one, consistent, 0.0872, 1.155, 0.997});
    if (one.name == "contact_stabilized") all.push_back({one, lumped, 0.101, 1.12, 0.994});
    if (one.name == "moreau_jean") all.push_back({one, lumped, 0.097, 1.06, 0.993});
  }
  return all;
}

TEST(ImpactBarTable, IsReached) {
  const double h = ImpactBar::length / 100.0 / ImpactBar::wave_speed;
  for (const Reference& entry : references()) {
    SCOPED_TRACE(entry.scheme.name);
    const Problem p(ImpactBar::model(100), entry.mass);
    const ImpactBarRun run = run_impact_bar(p, *entry.scheme.with(p, h), h);
    ASSERT_TRUE(run.converged);
    // The table rounds to three digits; its L2 norm is that of another sampling of the jumps.
    EXPECT_LT(run.error, 1.01 * entry.error);
    EXPECT_NEAR(run.peak, entry.peak, 0.006);
    EXPECT_NEAR(run.energy, entry.energy, 0.006 * std::max(1.0, entry.energy));
    EXPECT_LT(run.imbalance, 1e-10);
    EXPECT_LT(run.momentum_error, 1e-9);
    // Impulses let a row stay where a step has carried it; multipliers close the gap to round-off.
    EXPECT_LT(run.penetration, entry.scheme.name == "moreau_jean" ? ImpactBar::speed * h / ImpactBar::length : 1e-11);
  }
}

/// Coarse bars in short steps, whose end node is a large part of them: nodes that were thrown back multiplied the
/// energy by up to 3.3 here. 1e-10: the tolerance of the ledger.
TEST(ImpactBarTable, WhatStopsAtTouchesMakesNoEnergy) {
  for (const ImplicitScheme& one : implicit_schemes()) {
    if (!traits(one.settings.enforcement).stops_touches || one.name == "contact_stabilized") continue;
    for (const auto& [cells, courant] : {std::pair{4, 0.15}, {5, 0.15}, {7, 0.15}, {9, 0.5}, {12, 0.5}, {12, 1.0}}) {
      for (const MassKind mass : {MassKind::consistent, MassKind::lumped}) {
        SCOPED_TRACE(one.name + ", " + std::to_string(cells) + " cells, Courant number " + std::to_string(courant));
        const double h = courant * ImpactBar::length / cells / ImpactBar::wave_speed;
        ContactLaw springs;
        springs.eps_N = 900.0 * cells / ImpactBar::length;  // E / cell; a means only
        const Problem p(ImpactBar::model(cells, springs), mass);
        const ImpactBarRun run = run_impact_bar(p, *one.with(p, h), h);
        ASSERT_TRUE(run.converged);
        EXPECT_LT(run.largest_energy, 1.0 + 1e-10);
        EXPECT_LT(run.imbalance, 1e-10);
        EXPECT_LT(run.momentum_error, 1e-9);
      }
    }
  }
}

TEST(ImpactBarTable, EnergyMomentumKeepsTheEnergyWithPenalty) {
  const double h = ImpactBar::length / 100.0 / ImpactBar::wave_speed;
  ContactLaw springs;
  springs.eps_N = 9000.0;  // E / cell
  const Problem p(ImpactBar::model(100, springs));
  for (const ImplicitScheme& one : implicit_schemes()) {
    if (one.name != "energy_momentum") continue;
    const ImpactBarRun run = run_impact_bar(p, *one.with(p, h), h);
    ASSERT_TRUE(run.converged);
    EXPECT_NEAR(run.energy, 1.0, 1e-10);  // the balance of powers, with nothing else in it
    EXPECT_LT(run.largest_energy, 1.0 + 1e-10);
    EXPECT_LT(run.error, 0.1);
  }
}

// For rho_inf = 1 (alpha_m = alpha_f = gamma = 1/2, beta = 1/4) the recurrence is that of Moreau and Jean with theta =
// 1/2: a0 + a1 = z0 + z1, v1 = v0 + h/2 (z0 + z1) + W, u1 = u0 + h/2 (v0 + v1). Two codes of one motion.
TEST(NonsmoothGeneralizedAlphaScheme, IsMoreauAndJeansForASpectralRadiusOfOne) {
  const double h = ImpactBar::length / 100.0 / ImpactBar::wave_speed;
  const Problem p(ImpactBar::model(100));
  const ImpactBarRun found = run_impact_bar(p, *nonsmooth_scheme("", 1.0).with(p, h), h);
  const ImpactBarRun expected = run_impact_bar(p, *moreau_jean_scheme("", 0.5).with(p, h), h);
  ASSERT_TRUE(found.converged && expected.converged);
  // Round-off, and what the tolerance of equilibrium leaves: 1e-12 of the energy over the run, of its root in speeds.
  EXPECT_NEAR(found.energy, expected.energy, 1e-10);
  EXPECT_NEAR(found.peak, expected.peak, 1e-6);
  EXPECT_NEAR(found.error, expected.error, 1e-6);
  EXPECT_NEAR(found.penetration, expected.penetration, 1e-10);
}

// Its force is closer to the exact one than that of generalised-alpha on multipliers, 0.110 and 1.50 at rho_inf = 0.5
// (references() above): the contact force is no part of the acceleration that the scheme carries on.
TEST(NonsmoothGeneralizedAlphaScheme, RingsLessThanMultipliers) {
  const double h = ImpactBar::length / 100.0 / ImpactBar::wave_speed;
  for (const MassKind mass : {MassKind::consistent, MassKind::lumped}) {
    const Problem p(ImpactBar::model(100), mass);
    const ImpactBarRun run = run_impact_bar(p, *nonsmooth_scheme("", 0.5).with(p, h), h);
    ASSERT_TRUE(run.converged);
    EXPECT_LT(run.error, 0.110);
    EXPECT_LT(run.peak, 1.10);
    EXPECT_LE(run.largest_energy, 1.0 + 1e-10);
    EXPECT_LT(run.imbalance, 1e-10);
    EXPECT_LT(run.momentum_error, 1e-9);
    EXPECT_LT(run.penetration, ImpactBar::speed * h / ImpactBar::length);  // one step's motion
  }
}

struct Rebound {
  double speed = 0.0, loss = 0.0, mass = 0.0;
};

/// One cell that is too stiff to deform in a step falls on a plane at 0.2, with Newton's coefficient e.
Rebound rebound(const ImplicitScheme& one, double e) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  ObstacleContact plane = plane_below(model, 0.05, 0.0);
  plane.law.restitution = e;
  model.contacts.emplace_back(plane);
  block(model, "BLOCK", {0, 1});
  const Problem p(model, MassKind::lumped);
  const double h = 0.01;
  Rebound out{.mass = p.mass.total()};
  State state = p.moving({0, 0, -0.2}), next;
  const auto scheme = one.with(p, h);
  scheme->start(state, h);
  for (int i = 1; i <= 40 && out.speed == 0.0; ++i) {
    const StepReport report = scheme->step(state, {i * h, h, 1e-14}, next);
    EXPECT_TRUE(report.converged) << report.failure;
    std::swap(state, next);
    out.loss += report.books.energy.impact;
    // The rows are those of the four lower nodes.
    if (state.forces.rows.force[0][0] > 0.0) out.speed = state.v[2];
  }
  return out;
}

// It rebounds as a rigid body by Newton's law.
TEST(MoreauJeanScheme, ReboundsWithTheRestitutionOfTheRows) {
  for (const double e : {0.0, 0.5, 1.0}) {
    const Rebound after = rebound(moreau_jean_scheme("", 0.5), e);
    EXPECT_NEAR(after.speed, 0.2 * e, 1e-10);
    // Newton's law takes (1 - e^2)/2 of m v^2 from the nodes that touch: half of the mass. Theta = 1/2 puts the mean
    // velocity of the step, (e - 1)/2 v, to the impulse (1 + e) m v.
    EXPECT_NEAR(after.loss, 0.5 * (1.0 - e * e) * 0.5 * after.mass * 0.04, 0.02 * 0.5 * after.mass * 0.04);
  }
}

TEST(NonsmoothGeneralizedAlphaScheme, ReboundsWithTheRestitutionOfTheRows) {
  for (const double radius : {0.0, 0.5, 1.0}) {
    for (const double e : {0.0, 0.5, 1.0}) EXPECT_NEAR(rebound(nonsmooth_scheme("", radius), e).speed, 0.2 * e, 1e-10);
  }
}

/// A column of length 3, E = 2, nu = 0, that stands on a plane.
Model column() {
  Model model = one_part(block_mesh({1, 1, 3}, 0.0), LinearElastic{{.E = 2.0, .nu = 0.0, .rho = 1.5}});
  model.contacts.emplace_back(plane_below(model, 0.0, 20.0));
  block(model, "BLOCK", {0, 1});
  return model;
}

// Under pressure q on its head, held by contact alone: u(head) - u(foot) = -q L / E.
TEST(StaticsScheme, FindsTheStretchOfAColumnThatContactHolds) {
  for (const EnforcementKind e : {EnforcementKind::penalty, EnforcementKind::augmented_lagrangian}) {
    SCOPED_TRACE(name(e));
    Model model = column();
    model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, 0.1, {}});
    const Problem p(model);
    Statics scheme(p.system, {.enforcement = e, .penetration = 1e-9}, stable_step(p.system).omega_max_squared_free);
    const History run = march(scheme, p.moving({}), 1.0, 2);
    ASSERT_TRUE(run.converged) << run.failure;
    const auto foot = 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("ZMIN")[0]) + 2;
    EXPECT_NEAR(run.state.q[head(p)] - run.state.q[foot], -0.1 * 3.0 / 2.0, 1e-9);
    EXPECT_NEAR(run.state.q[foot], e == EnforcementKind::penalty ? -0.1 / 20.0 : 0.0, 1e-8);
    EXPECT_EQ(largest(run.state.v), 0.0);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
  }
}

// Its head pushed down by d: the plane answers with E d / L, at any number of steps.
TEST(StaticsScheme, FindsTheForceOnAPushedColumn) {
  for (const EnforcementKind e : {EnforcementKind::augmented_lagrangian, EnforcementKind::lagrange}) {
    SCOPED_TRACE(name(e));
    Model model = column();
    model.motions.push_back(
        {"push", model.mesh->nodes_of("ZMAX"), 2, MotionKind::displacement, {{0.0, 2.0}, {0.0, -0.15}}});
    const Problem p(model);
    Statics scheme(p.system, {.enforcement = e, .penetration = 1e-9}, stable_step(p.system).omega_max_squared_free);
    double force = 0.0;
    const History run = march(scheme, p.moving({}), 1.0, 2, [&](const State& state) {
      force = 0.0;
      for (std::size_t i = 2; i < state.forces.contact.size(); i += 3) force += state.forces.contact[i];
    });
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_NEAR(force, 2.0 * 0.15 / 3.0, 1e-7);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
  }
}

TEST(StaticsScheme, FailsWhereNothingHoldsTheBody) {
  Model model = one_part(block_mesh({1, 1, 2}, 0.0));
  model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, -0.1, {}});
  const Problem p(model);
  Statics scheme(p.system, {}, stable_step(p.system).omega_max_squared_free);
  State state = p.moving({}), next;
  scheme.start(state, 1.0);
  EXPECT_FALSE(scheme.step(state, {1.0, 1.0, 1e-12}, next).converged);
}

}  // namespace
}  // namespace carom::schemes_implicit_test
