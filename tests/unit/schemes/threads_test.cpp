// The same bits from any number of threads, for every instruction set of this processor.
#include <gtest/gtest.h>

#include "enforcement/explicit_contact.hpp"
#include "schemes/moreau_jean.hpp"
#include "schemes_fixture.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_threads_test {
namespace {

using namespace test;

/// 640 cells and 2673 dofs, so that the loops are cut into several chunks; touches in the first step, with friction.
/// Few steps: four threads on two cores wait long for each other.
Model impact() {
  Model model = one_part(block_mesh({8, 8, 10}, 0.15));
  model.contacts.emplace_back(plane_below(model, 0.002, 20.0, {10.0, 0.3}));
  return model;
}

using MakeScheme = std::unique_ptr<Scheme> (*)(const Problem&);
constexpr double h = 0.05;

State run_with(int threads, Isa isa, MassKind kind, int steps, MakeScheme make) {
  set_threads(threads);
  const Problem p(impact(), kind, isa);
  const History run = march(*make(p), p.moving({0.1, 0.05, -0.2}), h, steps);
  EXPECT_TRUE(run.converged);
  double tangential = 0.0;  // of springs or multipliers: contact and friction act
  for (const RowHistory& row : run.state.contact)
    tangential = std::max({tangential, std::abs(row.slip[0]), std::abs(row.multiplier[0])});
  EXPECT_GT(tangential, 0.0);
  return run.state;
}

void expect_same_bits(Isa isa, MassKind kind, int steps, MakeScheme make) {
  const State one = run_with(1, isa, kind, steps, make);
  EXPECT_TRUE(run_with(2, isa, kind, steps, make) == one) << name(isa);
  EXPECT_TRUE(run_with(4, isa, kind, steps, make) == one) << name(isa);
  set_threads(0);
}

TEST(Threads, CentralDifferences) {
  for (const Isa isa : available_isas()) expect_same_bits(isa, MassKind::lumped, 3, central);
}

TEST(Threads, CentralDifferencesWithConsistentMass) {
  expect_same_bits(chosen_isa(), MassKind::consistent, 2, central);
}

TEST(Threads, NewmarkWithConjugateGradients) {
  expect_same_bits(chosen_isa(), MassKind::consistent, 1,
                   [](const Problem& p) { return newmark(p, h, {}, {.solver = SolverKind::conjugate_gradients}); });
}

TEST(Threads, NewmarkWithMultigrid) {
  expect_same_bits(chosen_isa(), MassKind::consistent, 1,
                   [](const Problem& p) { return newmark(p, h, {}, {.solver = SolverKind::multigrid}); });
}

TEST(Threads, NewmarkWithCholesky) {
  expect_same_bits(chosen_isa(), MassKind::consistent, 1,
                   [](const Problem& p) { return newmark(p, h, {}, {.solver = SolverKind::cholesky}); });
}

TEST(Threads, NewmarkWithMultipliers) {
  expect_same_bits(chosen_isa(), MassKind::consistent, 1, [](const Problem& p) {
    return generalized_alpha(p, h, newmark_parameters(0.25, 0.5), {.enforcement = EnforcementKind::lagrange});
  });
}

TEST(Threads, MoreauJeanWithImpulses) {
  expect_same_bits(chosen_isa(), MassKind::lumped, 2, [](const Problem& p) -> std::unique_ptr<Scheme> {
    return std::make_unique<MoreauJean>(p.system, MoreauJeanParameters{0.5},
                                        ImplicitSettings{.enforcement = EnforcementKind::impulse}, h,
                                        stable_step(p.system).omega_max_squared_free);
  });
}

TEST(Threads, CentralDifferencesWithImpulses) {
  expect_same_bits(chosen_isa(), MassKind::lumped, 3, [](const Problem& p) -> std::unique_ptr<Scheme> {
    return std::make_unique<CentralDifferences>(p.system, impulse_contact(p.system));
  });
}

/// Ties of 400 nodes in front of multipliers and springs, and among multipliers.
TEST(Threads, Ties) {
  const auto run_tied = [](int threads, MassKind kind, const MakeScheme& make) {
    set_threads(threads);
    Model model = tied_blocks(0.02, 19, 0.0);
    model.contacts.emplace_back(plane_below(model, 0.002, 20.0, {10.0, 0.3}));
    const Problem p(std::move(model), kind);
    const History run = march(*make(p), p.moving({0.1, 0.05, -0.2}), 0.02, 3);
    EXPECT_TRUE(run.converged) << run.failure;
    return run.state;
  };
  const auto with_impulses = [](const Problem& p) -> std::unique_ptr<Scheme> {
    return std::make_unique<CentralDifferences>(p.system, impulse_contact(p.system));
  };
  for (const MakeScheme& make : {MakeScheme{central}, MakeScheme{with_impulses}}) {
    const State one = run_tied(1, MassKind::lumped, make);
    EXPECT_TRUE(run_tied(2, MassKind::lumped, make) == one);
    EXPECT_TRUE(run_tied(4, MassKind::lumped, make) == one);
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::schemes_threads_test
