// Ties in every scheme with every enforcement that it takes: what they join moves as one.
#include <gtest/gtest.h>

#include <string>

#include "model/compatibility.hpp"
#include "rows/admissible.hpp"
#include "schemes/scheme_table.hpp"
#include "system/bonded_mass.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_tie_test {
namespace {

using namespace test;

/// Exact, or by springs or an iteration that leaves something.
bool is_exact(SchemeKind scheme, EnforcementKind enforcement) {
  return is_explicit(scheme) || traits(enforcement).is_exact;
}

MassKind mass_of(SchemeKind scheme) {
  return is_explicit(scheme) ? MassKind::lumped : MassKind::consistent;
}

std::unique_ptr<Scheme> scheme_on(const Problem& p, SchemeKind kind, EnforcementKind enforcement, double h) {
  const SchemeSettings settings{.kind = kind, .enforcement = enforcement, .solver = SolverKind::cholesky};
  return make_scheme({p.system, settings, h, stable_step(p.system).omega_max_squared_free});
}

double step_of(const Problem& p, SchemeKind kind) {
  return is_explicit(kind) ? 0.5 * stable_step(p.system).dt_free : 0.1;
}

/// Schemes that take ties: all but the one whose contact nodes have no mass.
std::vector<SchemeTraits> tying_schemes() {
  std::vector<SchemeTraits> all(scheme_table.begin(), scheme_table.end());
  std::erase_if(all, [](const SchemeTraits& t) { return t.kind == SchemeKind::modified_mass; });
  return all;
}

class Ties : public testing::TestWithParam<SchemeTraits> {
 protected:
  template <class Try>
  void with_each_enforcement(const Try& attempt) {
    for (const EnforcementTraits& enforcement : enforcement_table) {
      if (!takes(GetParam().kind, enforcement.kind)) continue;
      SCOPED_TRACE(std::string(enforcement.name));
      attempt(GetParam().kind, enforcement.kind);
    }
  }
};

/// A block of 2 x 2 x 4 cells in one, held at one end and pulled askew at the other; the same of two tied blocks.
Model loaded(Model model) {
  block(model, "XMIN", {0, 1, 2});
  model.loads.push_back(NodalForce{model.mesh->nodes_of("XMAX"), {0.01, 0.004, -0.006}, {{0.0, 1.0}, {0.0, 1.0}}});
  return model;
}
Model whole() {
  StructuredBlock one;
  one.size = {4.0, 2.0, 2.0};
  one.divisions = {4, 2, 2};
  return loaded(one_part(make_structured_blocks({one})));
}

/// Displacement of the loaded corner.
Vec3 corner(const Model& model, const State& state) {
  for (const Index n : model.mesh->nodes_of("XMAX")) {
    const Vec3& X = model.mesh->coordinates[static_cast<std::size_t>(n)];
    const double* u = state.q.data() + 3 * static_cast<std::size_t>(n);
    if (X[1] == 2.0 && X[2] == 2.0) return {u[0], u[1], u[2]};
  }
  return {};
}

TEST_P(Ties, OfMatchingMeshesAreOneMesh) {
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    // Refused by Stage: there multipliers alone would hold the second block.
    if (kind == SchemeKind::statics && enforcement == EnforcementKind::lagrange) return;
    const Problem one(whole(), mass_of(kind)), two(loaded(tied_blocks(0.0, 2, 0.0)), mass_of(kind));
    const double h = step_of(one, kind);
    const int steps = static_cast<int>(4.0 / h);
    const History a = march(*scheme_on(one, kind, enforcement, h), one.moving({}), h, steps);
    const History b = march(*scheme_on(two, kind, enforcement, h), two.moving({}), h, steps);
    ASSERT_TRUE(a.converged && b.converged) << a.failure << b.failure;
    const Vec3 wanted = corner(one.model, a.state), got = corner(two.model, b.state);
    ASSERT_GT(norm(wanted), 1e-3);
    // Exact: what a residual of 1e-12 of the energy leaves. By springs of 1000 cells: a quarter of the length gives way
    // by 1/1000 of a cell, more in bending.
    const double share = is_exact(kind, enforcement) ? 1e-9 : 3e-3;
    EXPECT_LT(norm(subtract(got, wanted)), share * norm(wanted));
    EXPECT_LT(parting(two.contact, b.state.q), is_exact(kind, enforcement) ? 1e-13 : 1e-3 * norm(wanted));
    EXPECT_EQ(b.ledger.now().impact, 0.0);
    EXPECT_EQ(b.ledger.now().friction, 0.0);
    EXPECT_LT(b.imbalance, 1e-10 * b.ledger.scale());
  });
}

/// A free body of two that do not match and are a little apart turns and rings.
TEST_P(Ties, KeepTogetherWhatTurns) {
  if (GetParam().kind == SchemeKind::statics) GTEST_SKIP() << "without inertia";
  with_each_enforcement([](SchemeKind kind, EnforcementKind enforcement) {
    Model model = tied_blocks(0.03);
    model.parts[0].material = NeoHookean{unit_material};
    const Problem p(std::move(model), mass_of(kind));
    State begin = p.moving({});
    for (std::size_t n = 0; n < (*p.model.mesh).node_count(); ++n) {
      const Vec3 v = cross({0.1, 0.2, 0.4}, (*p.model.mesh).coordinates[n]);
      std::copy(v.begin(), v.end(), begin.v.begin() + 3 * static_cast<std::ptrdiff_t>(n));
    }
    const double h = step_of(p, kind);
    const History run = march(*scheme_on(p, kind, enforcement, h), begin, h, static_cast<int>(8.0 / h));
    ASSERT_TRUE(run.converged) << run.failure;
    EXPECT_GT(norm(Vec3{run.state.q[0], run.state.q[1], run.state.q[2]}) + largest(run.state.q), 1.0);  // it has turned
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    const double momentum = std::sqrt(2.0 * p.mass.total() * run.ledger.scale());
    EXPECT_LT(run.linear_momentum_error, 1e-9 * momentum);
    // Schemes that keep the moment of momentum to their order only do so for what is tied.
    if (traits(kind).angular_momentum == AngularMomentum::exactly) {
      EXPECT_LT(run.angular_momentum_error, 1e-9 * momentum);
    }
    if (!is_exact(kind, enforcement)) return;
    EXPECT_LT(parting(p.contact, run.state.q), 1e-12);
    EXPECT_LT(parting(p.contact, run.state.v), 1e-12);
  });
}

INSTANTIATE_TEST_SUITE_P(AllSchemes, Ties, testing::ValuesIn(tying_schemes()),
                         [](const auto& of) { return std::string(of.param.name); });

// The patch test: a linear field passes meshes that do not match unchanged, since means over the overlaps carry uniform
// tractions exactly; and surfaces that do not meet with little change.
TEST(TiePatch, LinearFieldsPass) {
  struct Meshes {
    double gap, distortion, tolerance;
  };
  // Rectangles: rounding of 0.04. Shape functions are no polynomials on overlaps of distorted faces: 1e-6 that their
  // quadrature leaves. Across a gap the place of the glue strains as the cells behind do, without their stress.
  for (const auto& [gap, distortion, tolerance] :
       {Meshes{0.0, 0.0, 1e-13}, Meshes{0.0, 0.1, 1e-7}, Meshes{0.04, 0.1, 2e-3}}) {
    SCOPED_TRACE(tolerance);
    Model model = tied_blocks(gap, 3, distortion);
    std::get<TieContact>(model.contacts.front()).method = TieMethod::surface_to_surface;
    // Stretched along x, nu = 0.3 of the material making it narrower; a turn; the sides are free.
    const auto wanted = [](const Vec3& X) {
      return Vec3{0.01 * X[0] - 0.002 * X[1], -0.003 * X[1] + 0.002 * X[0], -0.003 * X[2]};
    };
    for (std::size_t n = 0; n < model.mesh->node_count(); ++n) {
      const Vec3& X = model.mesh->coordinates[n];
      if (X[0] != 0.0 && X[0] != 4.0 + gap) continue;
      const Vec3 u = wanted(X);
      for (int c = 0; c < 3; ++c)
        model.motions.push_back({"patch",
                                 {static_cast<Index>(n)},
                                 c,
                                 MotionKind::displacement,
                                 {{0.0, 1.0}, {0.0, u[static_cast<std::size_t>(c)]}}});
    }
    const Problem p(std::move(model));
    const History run = march(*scheme_on(p, SchemeKind::statics, EnforcementKind::lagrange, 1.0), p.moving({}), 1.0, 1);
    ASSERT_TRUE(run.converged) << run.failure;
    for (std::size_t n = 0; n < (*p.model.mesh).node_count(); ++n) {
      const Vec3 u = wanted((*p.model.mesh).coordinates[n]);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(run.state.q[3 * n + c], u[c], tolerance);
    }
  }
}

// Drift: 1e5 steps of a body that rings. Rounding of the positions (4), of which every step leaves 1e-16 of a motion.
TEST(TieDrift, DoesNotGrow) {
  Model model = tied_blocks();
  const Problem p(std::move(model), MassKind::lumped);
  const double h = 0.9 * stable_step(p.system).dt_free;
  State begin = p.moving({});
  for (std::size_t n = 0; n < (*p.model.mesh).node_count(); ++n)
    begin.v[3 * n] = 0.1 * ((*p.model.mesh).coordinates[n][0] - 2.0);
  const auto scheme = scheme_on(p, SchemeKind::central_differences, EnforcementKind::penalty, h);
  double most = 0.0;
  const History run =
      march(*scheme, begin, h, 20000, [&](const State& now) { most = std::max(most, parting(p.contact, now.q)); });
  EXPECT_LT(most, 1e-14);
  EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
}

// What rows beside bonds answer, sparse but for those that share nodes with bonds, is what the operator itself makes of
// forces on them, one after the other. Masses and rows are of about 1, their sums round at 1e-16.
TEST(TieCompliance, IsThatOfTheBodiesTogether) {
  Model model = tied_blocks(0.02);
  model.contacts.emplace_back(plane_below(model, 0.004, 20.0, {10.0, 0.3}));
  const Problem p(std::move(model), MassKind::lumped);
  MassSolver mass(p.system);
  BondedMass bonds(p.system, mass);
  const ContactOperator of_bodies = bonds.contact_operator();
  const auto rows = p.rows();
  std::vector<std::size_t> chosen;
  for (std::size_t r = 0; r < rows->size(); ++r)
    if (!is_bond(rows->law[r])) chosen.push_back(r);
  const Delassus W = of_bodies.delassus(*rows, chosen);
  ASSERT_EQ(W.rows, chosen);
  ASSERT_LT(W.entries(), chosen.size() * chosen.size());  // some share nothing with bonds
  std::vector<Vec3> force(chosen.size()), answer(chosen.size());
  for (std::size_t j = 0; j < chosen.size(); ++j) {
    for (std::size_t c = 0; c < 3; ++c) {
      force[j][c] = 1.0;
      W.apply(force, answer);
      std::vector<double> x(p.solid.dof_count(), 0.0);
      rows->scatter(chosen[j], force[j], x);
      of_bodies.inverse(x);
      for (std::size_t i = 0; i < chosen.size(); ++i)
        EXPECT_LT(norm(subtract(answer[i], rows->relative(chosen[i], x))), 1e-12 * norm(answer[j]));
      force[j] = {};
    }
  }
}

// Bonds restrict motions, and so raise no frequency (Rayleigh's quotient): the step of the bodies is stable.
TEST(TieStep, IsThatOfTheBodies) {
  const Problem p(tied_blocks(), MassKind::lumped);
  EXPECT_EQ(stable_step(p.system).dt, stable_step(p.system).dt_free);
}

}  // namespace
}  // namespace carom::schemes_tie_test
