// The books of both schemes close on every kind of load, support and contact.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <string>

#include "contact_fixture.hpp"
#include "math/vec3.hpp"
#include "schemes_implicit.hpp"
#include "solid/cell_values.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_ledger_test {
namespace {

using namespace test;

constexpr double end = 12.0;  // about two round trips of a wave through three cells of length 1 at speed 1.34

Model distorted_block() {
  return one_part(block_mesh({2, 2, 3}, 0.15));
}

const TimeFunction ramp_and_fall{{0.0, 3.0, 6.0, 6.0}, {0.0, 1.0, -0.5, 0.25}};  // with a jump at 6

struct Scenario {
  std::string name;
  std::function<Model()> model;
  Vec3 velocity{};
  double height = 0.0;  ///< initial displacement of the body along z
};

void PrintTo(const Scenario& scenario, std::ostream* out) {
  *out << scenario.name;
}

Model on_plane(const Friction& friction) {
  Model model = distorted_block();
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0, friction));
  return model;
}

Model on_interface() {
  Mesh mesh = block_mesh({2, 2, 3}, 0.15);
  Model model = one_part(mesh);
  const std::vector<Index> cells = add_interface(mesh, "ZMIN");
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.contacts.emplace_back(InterfaceContact{"wall", cells, {.eps_N = 20.0, .eps_T = 10.0, .mu = 0.3}});
  block(model, "WALL", {0, 1, 2});
  return model;
}

Model on_stop(double damping, DamperActs acts = DamperActs::compression) {
  Model model = distorted_block();
  model.contacts.emplace_back(StopContact{"stop", model.mesh->nodes_of("ZMIN"), {0, 0, 1}, 0.05, 3.0, damping, acts});
  return model;
}

/// A point mass at one corner, and a spring across the body along the line of its ends.
Model with_attached() {
  Model model = distorted_block();
  model.point_masses.push_back({{3, 30}, 0.4});
  const Vec3 n = normalized(subtract(model.mesh->coordinates[30], model.mesh->coordinates[3]));
  model.springs.push_back({{3, 30}, {scaled(n, 2.0 * n[0]), scaled(n, 2.0 * n[1]), scaled(n, 2.0 * n[2])}});
  model.loads.push_back(NodalForce{{3}, {0.1, 0.02, 0.05}, ramp_and_fall});
  return model;
}

Model loaded(const Load& load) {
  Model model = distorted_block();
  block(model, "ZMIN", {0, 1, 2});
  model.loads.push_back(load);
  return model;
}

Model driven(MotionKind kind) {
  Model model = distorted_block();
  model.motions.push_back({"drive", model.mesh->nodes_of("ZMIN"), 2, kind, {{0.0, 3.0, 6.0}, {0.0, 0.3, -0.1}}});
  model.motions.push_back({"shake", model.mesh->nodes_of("ZMIN"), 0, kind, {{0.0, 2.0, 9.0}, {0.0, -0.2, 0.3}}});
  return model;
}

/// Two tied blocks whose undersides, tied nodes among them, touch a plane.
Model tied_on_plane() {
  Model model = tied_blocks(0.02);
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0, {10.0, 0.3}));
  return model;
}

std::vector<Scenario> scenarios() {
  return {
      {"plane", [] { return on_plane({}); }, {0, 0, -0.2}},
      {"plane_with_friction",
       [] {
         return on_plane({10.0, 0.3});
       },
       {0.15, 0.05, -0.2}},
      {"interface_with_friction", on_interface, {0.1, 0.0, -0.2}, 0.05},
      {"stop", [] { return on_stop(0.0); }, {0, 0, -0.2}},
      {"damped_stop", [] { return on_stop(0.5); }, {0, 0, -0.2}},
      {"stop_that_pulls", [] { return on_stop(5.0, DamperActs::two_sided); }, {0, 0, -0.2}},
      {"attached", with_attached},
      {"tied", tied_on_plane, {0.15, 0.05, -0.2}},
      {"gravity",
       [] {
         return loaded(Gravity{{0.01, 0, -0.05}, ramp_and_fall});
       }},
      {"pressure",
       [] {
         return loaded(Pressure{{faces_of(*distorted_block().mesh, "ZMAX")}, 0.1, ramp_and_fall});
       }},
      {"nodal_force",
       [] {
         return loaded(NodalForce{{3, 30}, {0.1, 0.02, 0.05}, ramp_and_fall});
       }},
      {"driven_displacement", [] { return driven(MotionKind::displacement); }},
      {"driven_velocity", [] { return driven(MotionKind::velocity); }},
      {"driven_acceleration", [] { return driven(MotionKind::acceleration); }},
  };
}

State start_of(const Scenario& scenario, const Problem& p) {
  State state = p.moving(scenario.velocity);
  for (const CellRef& ref : p.model.mesh->cell_groups.at("BLOCK")) {
    for (std::size_t a = 0; a < 8; ++a) {
      const Index n = p.model.mesh->block(CellType::hexa8)->connectivity[8 * static_cast<std::size_t>(ref.cell) + a];
      state.q[3 * static_cast<std::size_t>(n) + 2] = scenario.height;
    }
  }
  return state;
}

struct Ledger : testing::TestWithParam<Scenario> {
  void expect_closed(const Problem& p, Scheme& scheme, double h) {
    const History run = march(scheme, start_of(GetParam(), p), h, static_cast<int>(end / h));
    ASSERT_TRUE(run.converged) << run.failure;
    const double scale = run.ledger.scale();
    ASSERT_GT(scale, 1e-3);                   // something has happened
    EXPECT_LT(run.imbalance, 1e-10 * scale);  // what a case promises (verdict: energy balance)
    // 1e-9 of the momentum that the energy could carry: the work tolerance leaves forces of about 1e-12.
    const double momentum = std::sqrt(2.0 * p.mass.total() * scale);
    EXPECT_LT(run.linear_momentum_error, 1e-9 * momentum);
    EXPECT_LT(run.angular_momentum_error, 1e-9 * momentum);
  }
};

TEST_P(Ledger, ClosesWithNewmarkAndCholesky) {
  const Problem p(GetParam().model());
  expect_closed(p, *newmark(p, 0.1, {}, {.solver = SolverKind::cholesky}), 0.1);
}

TEST_P(Ledger, ClosesWithNewmarkAndConjugateGradientsAndLumpedMass) {
  const Problem p(GetParam().model(), MassKind::lumped);
  expect_closed(p, *newmark(p, 0.1, {}, {.solver = SolverKind::conjugate_gradients}), 0.1);
}

TEST_P(Ledger, ClosesWithDissipativeNewmark) {
  const Problem p(GetParam().model());
  expect_closed(p, *newmark(p, 0.1, {.beta = 0.28, .gamma = 0.55}), 0.1);
}

TEST_P(Ledger, ClosesWithCentralDifferences) {
  for (const MassKind kind : {MassKind::lumped, MassKind::consistent}) {
    const Problem p(GetParam().model(), kind);
    expect_closed(p, *central(p), 0.8 * stable_step(p.system).dt);
  }
}

TEST_P(Ledger, ClosesWithEveryImplicitScheme) {
  const Problem p(GetParam().model());
  for (const ImplicitScheme& one : implicit_schemes()) {
    SCOPED_TRACE(one.name);
    expect_closed(p, *one.with(p, 0.1), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(, Ledger, testing::ValuesIn(scenarios()),
                         [](const testing::TestParamInfo<Scenario>& one) { return one.param.name; });

// T + U - h^2/8 a.Ma is constant for central differences on a linear system (e.g. Hairer, Lubich and Wanner, Geometric
// Numerical Integration, section I.5: a quadratic invariant of the Stoermer-Verlet map).
TEST(ShadowEnergy, OfCentralDifferencesIsConstantWhileContactDoesNotChange) {
  for (const MassKind kind : {MassKind::lumped, MassKind::consistent}) {
    Model model = distorted_block();
    block(model, "ZMIN", {2});
    const Problem p(model, kind);
    State begin = p.moving({});
    begin.v = random_vector(p.solid.dof_count(), 7);
    const History run = march(*central(p), begin, 0.9 * stable_step(p.system).dt, 500);
    EXPECT_LT(run.shadow_change, 1e-10 * run.ledger.scale());
    EXPECT_LT(std::abs(run.ledger.imbalance()), 1e-10 * run.ledger.scale());
  }
}

TEST(ShadowEnergy, ChangesWithContact) {
  const Problem p(on_plane({}), MassKind::lumped);
  const History run = march(*central(p), p.moving({0, 0, -0.2}), 0.9 * stable_step(p.system).dt, 30);
  EXPECT_GT(run.shadow_change, 1e-6 * run.ledger.scale());  // so that the test above can fail
}

// The energies of a run, once more from their definitions: sums over steps of means times differences.
TEST(Books, AgreeWithIndependentSums) {
  const Problem p(on_plane({10.0, 0.3}));
  const NewmarkParameters parameters{.beta = 0.28, .gamma = 0.55};
  const double h = 0.1;
  const std::size_t n = p.solid.dof_count();
  State before;
  std::vector<double> F_before, C_before, F(n), C(n), work(n);
  AsterTerms sums;
  const auto observe = [&](const State& now) {
    p.solid.internal_force(now.q, F);
    C = now.forces.contact.dense();
    if (!before.q.empty()) {
      for (std::size_t i = 0; i < n; ++i) work[i] = now.v[i] - before.v[i];
      std::vector<double> M_dv(n);
      p.mass.apply(work, M_dv);
      for (std::size_t i = 0; i < n; ++i) {
        const double du = now.q[i] - before.q[i];
        sums.ENER_CIN += 0.5 * (now.v[i] + before.v[i]) * M_dv[i];
        sums.ENER_TOT += 0.5 * (F[i] + F_before[i]) * du;
        sums.TRAV_LIAI -= 0.5 * (C[i] + C_before[i]) * du;
      }
    }
    before = now;
    F_before = F;
    C_before = C;
  };
  const History run = march(*newmark(p, h, parameters), p.moving({0.15, 0.05, -0.2}), h, 80, observe);
  ASSERT_TRUE(run.converged);
  const double tolerance = 1e-12 * run.ledger.scale();  // round-off of 80 steps
  EXPECT_NEAR(run.ledger.aster().ENER_CIN, sums.ENER_CIN, tolerance);
  EXPECT_NEAR(run.ledger.aster().ENER_TOT, sums.ENER_TOT, tolerance);
  EXPECT_NEAR(run.ledger.aster().TRAV_LIAI, sums.TRAV_LIAI, tolerance);
  const EnergyTerms now = run.ledger.now();
  EXPECT_NEAR(now.strain, strain_energy(p.solid, run.state.q), tolerance);
  std::vector<double> Mv(n);
  p.mass.apply(run.state.v, Mv);
  EXPECT_NEAR(now.kinetic, 0.5 * dot(run.state.v, Mv), tolerance);
  EXPECT_GT(now.friction, 1e-3 * run.ledger.scale());
  // Code_Aster's balance: what the scheme dissipates there is `algorithmic`, since ENER_TOT and TRAV_LIAI are the
  // trapezoidal works in which `quadrature` lives.
  EXPECT_NEAR(run.ledger.aster().DISS_SCH(), now.algorithmic, 1e-10 * run.ledger.scale());
}

// A block that slides on and off a plane: the trapezoidal work is that of the smooth path to order 2 (architecture.md),
// touches and ends of touches too. Friction counted by the force at the end of a step alone misplaces its change over
// the step times the slip, which is of order 1, and lost where pressure falls.
TEST(Books, QuadratureOfSlidingIsOfOrderTwo) {
  const Problem p(on_plane({10.0, 0.3}), MassKind::lumped);
  const double h = 0.4 * stable_step(p.system).dt;
  const auto misplaced = [&](int parts) {
    const History run = march(*central(p), p.moving({1.5, 0.5, -0.2}), h / parts, parts * static_cast<int>(end / h));
    EXPECT_GT(run.ledger.now().friction, 0.01 * run.ledger.scale());
    return std::abs(run.ledger.now().quadrature);
  };
  EXPECT_GT(misplaced(1), 3.0 * misplaced(2));  // 4 in the limit
  EXPECT_GT(misplaced(2), 3.0 * misplaced(4));
}

// Krenk (Comput. Methods Appl. Mech. Engrg. 195, 2006, eq. 11) for a linear system: with kappa = h^2 (beta - gamma/2),
//   d(T + U + kappa/2 a.Ma) = -(gamma - 1/2) (du . K du + kappa da . M da).
TEST(Books, AlgorithmicEnergyIsKrenksIdentity) {
  Model model = distorted_block();
  block(model, "ZMIN", {0, 1, 2});
  const Problem p(model);
  const NewmarkParameters parameters{.beta = 0.31, .gamma = 0.6};
  const double h = 0.3, kappa = h * h * (0.31 - 0.3);
  const std::size_t n = p.solid.dof_count();
  State before, begin = p.moving({});
  begin.v = random_vector(n, 3);
  double dissipated = 0.0, first = 0.0, last = 0.0;
  const auto observe = [&](const State& now) {
    const double correction = 0.5 * kappa * dot(now.a, now.forces.inertia);
    if (before.q.empty()) {
      first = correction;
    } else {
      std::vector<double> du(n), da(n), K_du(n), M_da(n);
      for (std::size_t i = 0; i < n; ++i) {
        du[i] = now.q[i] - before.q[i];
        da[i] = now.a[i] - before.a[i];
      }
      p.solid.internal_force(du, K_du);
      p.mass.apply(da, M_da);
      dissipated += 0.1 * (dot(du, K_du) + kappa * dot(da, M_da));
    }
    last = correction;
    before = now;
  };
  const History run = march(*newmark(p, h, parameters), begin, h, 100, observe);
  EXPECT_NEAR(run.ledger.now().algorithmic, dissipated + last - first, 1e-11 * run.ledger.scale());
  EXPECT_GT(dissipated, 0.1 * run.ledger.scale());
}

}  // namespace
}  // namespace carom::schemes_ledger_test
