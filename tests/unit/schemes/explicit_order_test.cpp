// Observed order and limit of stability of the explicit schemes.
#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "schemes/hulbert_chung.hpp"
#include "schemes/noh_bathe.hpp"
#include "schemes/scheme_table.hpp"
#include "schemes/tchamwa_wielgosz.hpp"
#include "schemes_explicit_fixture.hpp"

namespace carom::schemes_explicit_order_test {
namespace {

using namespace test;

/// Columns of unit cells guided laterally whose only motion with inertia is one node layer's u_z:
///   omega^2 = C / (share rho),  C = E (1 - nu) / ((1 + nu) (1 - 2 nu)).
/// One cell, the foot clamped: half of it moves. Two bars (C = E), the head clamped and the foot, without mass,
/// hanging: the middle, and with it the foot, moves with the mass of one and a half bars on one bar's stiffness.
struct Oscillator {
  std::unique_ptr<Problem> lumped;
  std::unique_ptr<ModifiedProblem> modified;
  double share = 0.5;

  const System& system() const { return lumped ? lumped->system : modified->system; }
  double frequency() const {
    const auto& m = unit_material;
    const double modulus = lumped ? m.E * (1 - m.nu) / ((1 + m.nu) * (1 - 2 * m.nu)) : m.E;
    return std::sqrt(modulus / (share * m.rho));
  }
  std::vector<std::size_t> moving() const {
    return lumped ? std::vector<std::size_t>{4, 5, 6, 7} : std::vector<std::size_t>{0, 1};
  }
  std::size_t dof() const { return 3 * moving().back() + 2; }
  State displaced(double u) const {
    State state;
    state.q.assign(system().solid.dof_count(), 0.0);
    state.v = state.q;
    for (const std::size_t n : moving()) state.q[3 * n + 2] = u;
    state.contact.resize(system().contact.slots());
    return state;
  }
};

Oscillator guided_cell() {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  block(model, "BLOCK", {0, 1});
  block(model, "ZMIN", {2});
  Oscillator out;
  out.lumped = std::make_unique<Problem>(std::move(model), MassKind::lumped);
  return out;
}

/// Two bars under each other, so that nothing but their axial motion is there.
Oscillator hanging_bars() {
  StructuredBlock line;
  line.kind = StructuredBlock::Kind::bar;
  line.end = {0, 0, 2};
  line.divisions = {2, 1, 1};
  Model model;
  model.mesh = std::make_shared<const Mesh>(make_structured_blocks({line}));
  model.parts.push_back(
      {.name = "bars", .cells = {0, 1}, .material = unit_material, .type = CellType::line2, .section = Section::bar});
  block(model, "BLOCK", {0, 1});
  block(model, "END", {2});
  ObstacleContact floor;
  floor.name = "floor";
  floor.shape = Plane{{0, 0, -10}, {0, 0, 1}};  // never touched
  floor.measure = RowMeasure::per_node;
  floor.nodes = model.mesh->nodes_of("START");
  model.contacts.emplace_back(floor);
  Oscillator out;
  out.modified = std::make_unique<ModifiedProblem>(std::move(model), MassModification{.layers = 1});
  out.share = 1.5;
  return out;
}

struct Explicit {
  std::string name;
  SchemeSettings settings;
  int order;
  std::function<std::unique_ptr<Scheme>(const System&)> make;
  Oscillator (*oscillator)() = guided_cell;
};

void PrintTo(const Explicit& scheme, std::ostream* out) {
  *out << scheme.name;
}

std::vector<Explicit> schemes() {
  std::vector<Explicit> list;
  list.push_back({"central_differences", {.kind = SchemeKind::central_differences}, 2, [](const System& s) {
                    return std::make_unique<CentralDifferences>(s);
                  }});
  list.push_back({"cd_lagrange",
                  {.kind = SchemeKind::central_differences, .enforcement = EnforcementKind::impulse},
                  2,
                  [](const System& s) { return std::make_unique<CentralDifferences>(s, impulse_contact(s)); }});
  list.push_back({"modified_mass",
                  {.kind = SchemeKind::modified_mass},
                  2,
                  [](const System& s) { return std::make_unique<SemiExplicit>(s); },
                  hanging_bars});
  for (const double rho : {1.0, 0.8, 0.5, 0.3, 0.0}) {
    list.push_back({"hulbert_chung_" + std::to_string(static_cast<int>(10 * rho)),
                    {.kind = SchemeKind::hulbert_chung, .parameters = SpectralRadius{rho}},
                    2,
                    [rho](const System& s) { return std::make_unique<HulbertChung>(s, SpectralRadius{rho}); }});
  }
  for (const double p : {0.5, 0.54, 0.6}) {
    list.push_back({"noh_bathe_" + std::to_string(static_cast<int>(100 * p)),
                    {.kind = SchemeKind::noh_bathe, .parameters = NohBatheParameters{p}},
                    2,
                    [p](const System& s) { return std::make_unique<NohBathe>(s, NohBatheParameters{p}); }});
  }
  list.push_back(
      {"tchamwa_wielgosz",
       {.kind = SchemeKind::tchamwa_wielgosz, .parameters = TchamwaWielgoszParameters{1.033}},
       1,
       [](const System& s) { return std::make_unique<TchamwaWielgosz>(s, TchamwaWielgoszParameters{1.033}); }});
  return list;
}

struct ExplicitScheme : testing::TestWithParam<Explicit> {
  Oscillator oscillator = GetParam().oscillator();

  /// At the end of 1.3 periods, released from rest at 0.1, with n steps.
  double error_with(int n) const {
    const double omega = oscillator.frequency(), end = 1.3 * 2.0 * std::numbers::pi / omega;
    const auto scheme = GetParam().make(oscillator.system());
    const State state = march(*scheme, oscillator.displaced(0.1), end / n, n).state;
    const std::size_t i = oscillator.dof();
    return std::max(std::abs(state.q[i] - 0.1 * std::cos(omega * end)),
                    std::abs(state.v[i] + 0.1 * omega * std::sin(omega * end)) / omega);
  }

  /// The same with n pairs of steps, the second of each a quarter of the first.
  double error_with_pairs(int n) const {
    const double omega = oscillator.frequency(), end = 1.3 * 2.0 * std::numbers::pi / omega;
    const auto scheme = GetParam().make(oscillator.system());
    State state = oscillator.displaced(0.1), next;
    const double pair = end / n;
    scheme->start(state, 0.8 * pair);
    for (int i = 0; i < n; ++i) {
      for (const auto& [from, to] : {std::pair{0.0, 0.8}, std::pair{0.8, 1.0}}) {
        EXPECT_TRUE(scheme->step(state, {(i + to) * pair, (to - from) * pair, 0.0}, next).converged);
        std::swap(state, next);
      }
    }
    const std::size_t i = oscillator.dof();
    return std::max(std::abs(state.q[i] - 0.1 * std::cos(omega * end)),
                    std::abs(state.v[i] + 0.1 * omega * std::sin(omega * end)) / omega);
  }

  /// Largest displacement in 2000 steps of omega h from 1e-8; stops at 1e-2.
  double growth(double omega_h) const {
    const auto scheme = GetParam().make(oscillator.system());
    const double h = omega_h / oscillator.frequency();
    State state = oscillator.displaced(1e-8), next;
    state.v[oscillator.dof()] = 1e-8;
    scheme->start(state, h);
    for (int i = 1; i <= 2000 && largest(state.q) < 1e-2; ++i) {
      EXPECT_TRUE(scheme->step(state, {i * h, h, 0.0}, next).converged);
      std::swap(state, next);
    }
    return largest(state.q);
  }
};

// e(h) = c h^p (1 + O(h)): from 200 steps on the next term changes the observed order by less than 0.05.
TEST_P(ExplicitScheme, HasItsOrder) {
  double coarse = error_with(200);
  for (const int n : {400, 800, 1600}) {
    const double fine = error_with(n);
    EXPECT_NEAR(std::log2(coarse / fine), GetParam().order, 0.05) << n << " steps";
    coarse = fine;
  }
}

// Contact cuts steps where it closes: what a scheme carries over is of the last step's length. The errors of Hulbert
// and Chung's scheme nearly cancel, so that their next term matters up to 800 pairs.
TEST_P(ExplicitScheme, HasItsOrderWhereStepsChange) {
  double coarse = error_with_pairs(800);
  for (const int n : {1600, 3200}) {
    const double fine = error_with_pairs(n);
    EXPECT_NEAR(std::log2(coarse / fine), GetParam().order, 0.05) << n << " pairs of steps";
    coarse = fine;
  }
}

// Just below the limit the motion stays within 1e-8 times the amplitudes of the recurrence, which grow as the roots of
// its amplification meet (below 1000 at 0.999 of the limit); just above it a root of 1.01 or more makes 1e-2 of it.
TEST_P(ExplicitScheme, IsStableUpToItsLimit) {
  const double limit = stability_limit(GetParam().settings);
  EXPECT_LT(growth(0.999 * limit), 1e-5);
  EXPECT_GE(growth(1.01 * limit), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(, ExplicitScheme, testing::ValuesIn(schemes()),
                         [](const auto& one) { return one.param.name; });

// Hulbert and Chung 1996, eq. 38, and Noh and Bathe 2013 give 1.549 to 2 and 3.746: fits that are up to 0.4 % above the
// limits of the recurrences, which IsStableUpToItsLimit measures.
TEST(StabilityLimit, IsAsPublished) {
  const double rho[] = {1.0, 0.8, 0.5, 0.3, 0.0}, limit[] = {2.0, 1.978, 1.873, 1.762, 1.549};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(stability_limit({.kind = SchemeKind::hulbert_chung, .parameters = SpectralRadius{rho[i]}}), limit[i],
                4e-3 * limit[i]);
  }
  EXPECT_NEAR(stability_limit({.kind = SchemeKind::noh_bathe, .parameters = NohBatheParameters{0.54}}), 3.746, 2e-3);
  EXPECT_DOUBLE_EQ(
      stability_limit({.kind = SchemeKind::tchamwa_wielgosz, .parameters = TchamwaWielgoszParameters{1.0}}), 2.0);
}

// The difference equation of Newmark on u'' = -w^2 u has a root at -1 at w^2 h^2 = 1 / (gamma/2 - beta).
TEST(StabilityLimit, OnlyExplicitSchemesHaveOneAndANewmarkOfSmallBeta) {
  for (const SchemeTraits& scheme : scheme_table)
    EXPECT_EQ(std::isfinite(stability_limit({.kind = scheme.kind})), is_explicit(scheme.kind)) << scheme.name;
  const auto newmark = [](double beta, double gamma) {
    return stability_limit({.kind = SchemeKind::newmark, .parameters = NewmarkParameters{beta, gamma}});
  };
  EXPECT_DOUBLE_EQ(newmark(1.0 / 6.0, 0.5), std::sqrt(12.0));  // linear acceleration
  EXPECT_FALSE(std::isfinite(newmark(0.275, 0.55)));
}

// T + U - h^2/8 a.Ma of central differences; phi = 1 dissipates nothing in the mean: T + U stays within the bounds of a
// symplectic Euler step, and both give the algorithmic energy of their books.
TEST(TchamwaWielgosz, DissipatesWithPhiAboveOne) {
  const Oscillator oscillator = guided_cell();
  const double h = 0.5 / oscillator.frequency();
  double kept[2];
  for (const int k : {0, 1}) {
    TchamwaWielgosz scheme(oscillator.system(), {.phi = k == 0 ? 1.0 : 1.05});
    const History run = march(scheme, oscillator.displaced(0.1), h, 2000);
    kept[k] = run.ledger.now().mechanical() / run.ledger.initial().mechanical();
    EXPECT_LT(run.imbalance, 1e-12 * run.ledger.scale());
  }
  EXPECT_GT(kept[0], 0.7);   // 1 -+ omega h / 2 to first order
  EXPECT_LT(kept[1], 1e-6);  // a root of modulus sqrt(1 - 0.05 (omega h)^2) ^ 2000 steps
}

}  // namespace
}  // namespace carom::schemes_explicit_order_test
