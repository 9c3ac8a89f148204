// A step is a function of the state at its beginning: the same bits whatever was made in between, and from a scheme
// made anew, for every scheme with every enforcement that it takes.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/compatibility.hpp"
#include "schemes/scheme_table.hpp"
#include "schemes_explicit_fixture.hpp"
#include "schemes_fixture.hpp"
#include "tie_fixture.hpp"

namespace carom::schemes_purity_test {
namespace {

using namespace test;

struct Body {
  const char* name;
  Material material;
  Formulation formulation = Formulation::full;
  Viscosity viscosity{};
  double distortion_control = 0.0;
};
const std::vector<Body>& bodies() {
  static const Material j2("j2", 1.5, {{"E", 2.0}, {"nu", 0.3}, {"yield_stress", 0.05}, {"hardening_modulus", 1.0}});
  static const std::vector<Body> all{
      {"linear", unit_material},
      {"neo-Hookean", NeoHookean{unit_material}},
      {"J2", j2},
      {"J2, one point", j2, Formulation::one_point},
      {"viscous, one point",
       NeoHookean{unit_material},
       Formulation::one_point,
       {.linear = 0.1, .quadratic = 1.2, .hourglass = 0.1}},
      // so near to 1 that it acts on what hardly deforms
      {"neo-Hookean, distortion control", NeoHookean{unit_material}, Formulation::stabilised, {}, 0.9999}};
  return all;
}

void make_of(Part& part, const Body& body) {
  part.material = body.material;
  part.formulation = body.formulation;
  part.viscosity = body.viscosity;
  part.distortion_control = body.distortion_control;
}

/// A block that falls obliquely onto a plane and turns, so that its nodes touch one after the other.
Model on_plane(const Body& body) {
  Model model = one_part(block_mesh({2, 2, 2}, 0.1));
  make_of(model.parts[0], body);
  model.contacts.emplace_back(plane_below(model, 0.004, 20.0, {10.0, 0.3}));
  model.loads.emplace_back(Gravity{{0.004, 0.0, -0.04}, {}});
  return model;
}

/// A block on a wider one that is held; its head is driven down and to the side, by motions with kinks.
Model sliding_pair(const Body& body) {
  StructuredBlock lower, upper;
  lower.size = {3.0, 3.0, 2.0};
  lower.divisions = {2, 2, 1};
  lower.face_groups = {"", "", "", "", "BASE", "MASTER"};
  upper.size = {1.5, 1.5, 2.0};
  upper.divisions = {2, 2, 2};
  upper.origin = {0.4, 0.3, 2.001};
  upper.face_groups = {"", "", "", "", "SLAVE", "HEAD"};
  Model model = one_part(make_structured_blocks({lower, upper}));
  make_of(model.parts[0], body);
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  pair.law = {.eps_N = 20.0, .eps_T = 10.0, .mu = 0.3};
  model.contacts.emplace_back(pair);
  block(model, "BASE", {0, 1, 2});
  const std::vector<Index> head = model.mesh->nodes_of("HEAD");
  model.motions.push_back({"press", head, 2, MotionKind::displacement, {{0.0, 0.2, 4.0}, {0.0, -0.03, -0.2}}});
  model.motions.push_back({"slide", head, 0, MotionKind::velocity, {{0.0, 0.3, 4.0}, {0.1, 0.2, 0.1}}});
  return model;
}

/// Two tied blocks whose undersides, tied nodes among them, fall obliquely onto a plane.
Model tied_on_plane(const Body& body) {
  Model model = tied_blocks(0.02);
  make_of(model.parts[0], body);
  model.contacts.emplace_back(plane_below(model, 0.004, 20.0, {10.0, 0.3}));
  model.loads.emplace_back(Gravity{{0.004, 0.0, -0.04}, {}});
  return model;
}

struct Scene {
  const char* name;
  Model (*model)(const Body&);
  double above;  ///< height from which on nodes move at first
};
constexpr std::array scenes{Scene{"plane", on_plane, 0.0}, Scene{"sliding pair", sliding_pair, 2.0005},
                            Scene{"tied on plane", tied_on_plane, -1.0}};

/// The bodies and their system, with the mass that the scheme wants.
struct Bench {
  std::unique_ptr<Problem> problem;
  std::unique_ptr<ModifiedProblem> modified;
  const System& system() const { return modified ? modified->system : problem->system; }
};

Bench make_bench(const Model& model, SchemeKind kind) {
  Bench bench;
  if (kind == SchemeKind::modified_mass)
    bench.modified = std::make_unique<ModifiedProblem>(model);
  else
    bench.problem = std::make_unique<Problem>(model, is_explicit(kind) ? MassKind::lumped : MassKind::consistent);
  return bench;
}

/// Free nodes above a height fall and turn; statics knows no velocities.
State falling_obliquely(const System& system, SchemeKind kind, double above) {
  State state;
  state.q.assign(system.solid.dof_count(), 0.0);
  state.v = state.q;
  state.contact.resize(system.contact.slots());
  if (kind == SchemeKind::statics) return state;
  for (std::size_t n = 0; n < system.mesh.node_count(); ++n) {
    const Vec3& x = system.mesh.coordinates[n];
    if (x[2] < above || system.supports.is_prescribed(static_cast<Index>(3 * n))) continue;
    state.v[3 * n] = 0.15 - 0.1 * x[1];
    state.v[3 * n + 1] = 0.1 * x[0];
    state.v[3 * n + 2] = -0.1 - 0.05 * x[0];
  }
  return state;
}

bool acts(const ContactResponse& response) {
  return std::any_of(response.status.begin(), response.status.end(), [](RowStatus s) { return s != RowStatus::open; });
}

struct Way {
  std::vector<State> states;
  std::vector<StepReport> reports;
};

constexpr int steps = 4;

/// Which edges make rows depends on what holds them; as a case's model has it (build/simulation.cpp).
void set_hold(const SchemeSettings& settings, Model& model) {
  for (ContactDefinition& definition : model.contacts) {
    auto* pair = std::get_if<PairContact>(&definition);
    if (pair == nullptr || settings.enforcement == EnforcementKind::penalty) continue;
    if (settings.enforcement == EnforcementKind::impulse)
      pair->law.hold = RowHold::impulses;
    else
      pair->law.hold = is_explicit(settings.kind) ? RowHold::increments : RowHold::multipliers;
  }
}

/// Purity of one combination.
class Purity {
 public:
  Purity(const Scene& scene, const Body& body, const SchemeSettings& settings)
      : model_(scene.model(body)), settings_(settings) {
    set_hold(settings, model_);
    const Bench bench = make_bench(model_, settings.kind);
    const StableStep stable = stable_step(bench.system());
    omega_max_squared_ = stable.omega_max_squared_free;
    h_ = is_explicit(settings.kind) ? 0.4 * stable.dt : 0.08;
    begin_ = falling_obliquely(bench.system(), settings.kind, scene.above);
  }

  void check() {
    const Bench bench = make_bench(model_, settings_.kind);
    go_through(bench);
    if (testing::Test::HasFailure()) return;
    disturb(bench);
    begin_anew();
  }

 private:
  std::unique_ptr<Scheme> scheme_on(const Bench& bench) const {
    return make_scheme({bench.system(), settings_, h_, omega_max_squared_});
  }
  /// Number 3 is shorter, so that operators change on the way.
  StepRequest request(const State& begin, int number) const {
    const double h = number == 3 ? 0.6 * h_ : h_;
    return {begin.t + h, h, 1e-14};
  }
  void expect_same(int i, const State& end, const StepReport& report) const {
    EXPECT_TRUE(end == way_.states[static_cast<std::size_t>(i)]) << "step " << i;
    const StepReport& wanted = way_.reports[static_cast<std::size_t>(i)];
    EXPECT_EQ(report.iterations, wanted.iterations) << "step " << i;
    EXPECT_EQ(report.linear_iterations, wanted.linear_iterations) << "step " << i;
    EXPECT_TRUE(report.books.energy == wanted.books.energy && report.books.impulse == wanted.books.impulse);
  }

  /// The way that the others are compared with; its ledger closes, and contact acts.
  void go_through(const Bench& bench) {
    const auto scheme = scheme_on(bench);
    State state = begin_;
    scheme->start(state, h_);
    EnergyLedger ledger(state.forces.stored, state.forces.total_momentum, 1.0);
    way_.states.push_back(state);
    way_.reports.emplace_back();
    bool touches = false, resists = model_.parts[0].distortion_control == 0.0;
    for (int i = 1; i <= steps; ++i) {
      State end;
      const StepReport report = scheme->step(state, request(state, i), end);
      ASSERT_TRUE(report.converged) << report.failure;
      ledger.add(report.books, end.forces.total_momentum);
      EXPECT_LT(std::abs(ledger.imbalance()), 1e-10 * ledger.scale());
      touches = touches || acts(end.forces.rows) || acts(end.within.rows);
      resists = resists || end.forces.stored.distortion > 0.0;
      way_.states.push_back(end);
      way_.reports.push_back(report);
      state = std::move(end);
    }
    EXPECT_TRUE(touches);
    EXPECT_TRUE(resists);
    if (settings_.kind != SchemeKind::statics) {  // which yields under its weight alone
      EXPECT_EQ(ledger.now().sum(TermKind::spent) > 0.0, !state.points.empty());
    }
  }

  /// One scheme for all; before every step one of another length, and one from the state before.
  void disturb(const Bench& bench) const {
    const auto scheme = scheme_on(bench);
    State end;
    for (int i = 1; i <= steps; ++i) {
      const State& begin = way_.states[static_cast<std::size_t>(i - 1)];
      scheme->step(begin, {begin.t + 1.7 * h_, 1.7 * h_, 1e-14}, end);
      if (i > 1) {
        const State& before = way_.states[static_cast<std::size_t>(i - 2)];
        scheme->step(before, {before.t + h_, h_, 1e-14}, end);
      }
      const StepReport report = scheme->step(begin, request(begin, i), end);
      expect_same(i, end, report);
    }
  }

  /// From a copy of every state on, to the next one and once to the end, with bodies, contact and scheme made anew.
  void begin_anew() const {
    for (int first = 0; first < steps; ++first) {
      const Bench bench = make_bench(model_, settings_.kind);
      const auto scheme = scheme_on(bench);
      const int last = first == 1 ? steps : first + 1;
      State state = way_.states[static_cast<std::size_t>(first)], end;
      for (int i = first + 1; i <= last; ++i) {
        const StepReport report = scheme->step(state, request(state, i), end);
        expect_same(i, end, report);
        std::swap(state, end);
      }
    }
  }

  Model model_;
  SchemeSettings settings_;
  double h_ = 0.0, omega_max_squared_ = 0.0;
  State begin_;
  Way way_;
};

/// One-point cells where contact is simplest, since it knows nothing of them. Conjugate gradients on one body in each
/// scene; they need not find the equilibrium of what friction alone holds.
bool is_tried(SchemeKind scheme, EnforcementKind enforcement, const Scene& scene, const Body& body, SolverKind solver) {
  // It takes no ties; statics none between bodies that only contact holds.
  const bool takes_scene = scheme != SchemeKind::modified_mass && scheme != SchemeKind::statics;
  if (!takes_scene && scene.model == tied_on_plane) return false;
  const bool remembers = !body.material.law->history.empty() || body.viscosity.is_any();
  if ((remembers || body.distortion_control > 0.0) && !traits(scheme).takes_history) return false;
  if (body.formulation != Formulation::full && enforcement != EnforcementKind::penalty) return false;
  if (solver == SolverKind::cholesky) return true;
  if (is_explicit(scheme) || scheme == SchemeKind::statics) return false;
  if (enforcement == EnforcementKind::augmented_lagrangian) return false;  // nothing that the penalty has not
  return &body == &bodies()[&scene == &scenes[0] ? 1 : 0];
}

class PurityOf : public testing::TestWithParam<SchemeTraits> {};

TEST_P(PurityOf, Holds) {
  const SchemeTraits& scheme = GetParam();
  for (const EnforcementTraits& enforcement : enforcement_table) {
    if (!takes(scheme.kind, enforcement.kind)) continue;
    for (const Scene& scene : scenes) {
      for (const Body& body : bodies()) {
        for (const SolverKind solver : {SolverKind::cholesky, SolverKind::conjugate_gradients, SolverKind::multigrid}) {
          if (!is_tried(scheme.kind, enforcement.kind, scene, body, solver)) continue;
          SCOPED_TRACE(std::string(enforcement.name) + ", " + scene.name + ", " + body.name + ", solver " +
                       std::to_string(static_cast<int>(solver)));
          const SchemeSettings settings{.kind = scheme.kind, .enforcement = enforcement.kind, .solver = solver};
          Purity(scene, body, settings).check();
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllSchemes, PurityOf, testing::ValuesIn(scheme_table),
                         [](const auto& of) { return std::string(of.param.name); });

}  // namespace
}  // namespace carom::schemes_purity_test
