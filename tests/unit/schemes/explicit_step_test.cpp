// ExplicitBooks, friction, restitution, failures and thread bits of the explicit schemes; the modified mass itself.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <numeric>
#include <ostream>
#include <string>

#include "contact_fixture.hpp"
#include "math/vec3.hpp"
#include "mesh/structured_block.hpp"
#include "schemes/hulbert_chung.hpp"
#include "schemes/noh_bathe.hpp"
#include "schemes/scheme_table.hpp"
#include "schemes/tchamwa_wielgosz.hpp"
#include "schemes_explicit_fixture.hpp"

namespace carom::schemes_explicit_step_test {
namespace {

using namespace test;

// ---- every scheme on every kind of contact, load and support

const TimeFunction ramp_and_fall{{0.0, 3.0, 6.0, 6.0}, {0.0, 1.0, -0.5, 0.25}};  // with a jump at 6

Model distorted_block() {
  return one_part(block_mesh({2, 2, 4}, 0.15));
}

Model on_plane() {
  Model model = distorted_block();
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0, {10.0, 0.3}));
  return model;
}

Model on_interface() {
  Mesh mesh = block_mesh({2, 2, 4}, 0.15);
  Model model = one_part(mesh);
  const std::vector<Index> cells = add_interface(mesh, "ZMIN");
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.contacts.emplace_back(InterfaceContact{"wall", cells, {.eps_N = 20.0, .eps_T = 10.0, .mu = 0.3}});
  block(model, "WALL", {0, 1, 2});
  return model;
}

Model loaded() {
  Model model = on_plane();
  model.loads.emplace_back(Gravity{{0.01, 0, -0.05}, ramp_and_fall});
  model.loads.emplace_back(Pressure{{faces_of(*model.mesh, "ZMAX")}, 0.1, ramp_and_fall});
  model.loads.emplace_back(NodalForce{{3, 30}, {0.1, 0.02, 0.05}, ramp_and_fall});
  return model;
}

Model driven(MotionKind kind) {
  Model model = on_plane();
  model.motions.push_back({"drive", model.mesh->nodes_of("ZMAX"), 2, kind, {{0.0, 3.0, 6.0}, {0.0, -0.3, 0.1}}});
  model.motions.push_back({"shake", model.mesh->nodes_of("ZMAX"), 0, kind, {{0.0, 2.0, 9.0}, {0.0, -0.2, 0.3}}});
  return model;
}

Model finite_strain() {
  Model model = on_plane();
  model.parts[0].material = NeoHookean{unit_material};
  return model;
}

struct Scenario {
  std::string name;
  std::function<Model()> model;
  Vec3 velocity{};
  bool linear = true;
};

std::vector<Scenario> scenarios() {
  return {
      {"plane_with_friction", on_plane, {0.15, 0.05, -0.2}},
      {"interface_with_friction", on_interface, {0.1, 0.0, -0.2}},
      {"loads", loaded, {0, 0, -0.1}},
      {"driven_displacement", [] { return driven(MotionKind::displacement); }, {}},
      {"driven_velocity", [] { return driven(MotionKind::velocity); }, {}},
      {"driven_acceleration", [] { return driven(MotionKind::acceleration); }, {}},
      {"finite_strain", finite_strain, {0.15, 0.05, -0.2}, false},
  };
}

/// A scheme with all that it stands on.
struct Bench {
  std::unique_ptr<Problem> plain;
  std::unique_ptr<ModifiedProblem> modified;
  std::unique_ptr<Scheme> scheme;
  SchemeSettings settings;

  const System& system() const { return plain ? plain->system : modified->system; }
  double stable() const { return stable_step(system(), stability_limit(settings), settings.enforcement).dt; }
};

template <class Make>
Bench plain_bench(Model model, MassKind kind, const SchemeSettings& settings, const Make& make, Isa isa) {
  Bench out;
  out.plain = std::make_unique<Problem>(std::move(model), kind, isa);
  out.scheme = make(out.plain->system);
  out.settings = settings;
  return out;
}

struct Kind {
  std::string name;
  bool exact;  ///< contact by multipliers
  std::function<Bench(Model, Isa)> make;
};

std::vector<Kind> kinds() {
  const auto plain = [](std::string name, SchemeSettings settings, MassKind mass, auto make) {
    return Kind{std::move(name), settings.enforcement != EnforcementKind::penalty,
                [=](Model model, Isa isa) { return plain_bench(std::move(model), mass, settings, make, isa); }};
  };
  const auto impulse = [](const System& s) { return std::make_unique<CentralDifferences>(s, impulse_contact(s)); };
  const auto increments = [](const System& s) {
    return std::make_unique<CentralDifferences>(s, forward_increment_contact(s));
  };
  const SchemeSettings cd_lagrange{.kind = SchemeKind::central_differences, .enforcement = EnforcementKind::impulse};
  const SchemeSettings forward{.kind = SchemeKind::central_differences, .enforcement = EnforcementKind::lagrange};
  return {
      plain("hulbert_chung", {.kind = SchemeKind::hulbert_chung, .parameters = SpectralRadius{0.6}}, MassKind::lumped,
            [](const System& s) { return std::make_unique<HulbertChung>(s, SpectralRadius{0.6}); }),
      plain("noh_bathe", {.kind = SchemeKind::noh_bathe, .parameters = NohBatheParameters{0.54}}, MassKind::lumped,
            [](const System& s) { return std::make_unique<NohBathe>(s, NohBatheParameters{0.54}); }),
      plain("tchamwa_wielgosz", {.kind = SchemeKind::tchamwa_wielgosz, .parameters = TchamwaWielgoszParameters{1.1}},
            MassKind::consistent,
            [](const System& s) { return std::make_unique<TchamwaWielgosz>(s, TchamwaWielgoszParameters{1.1}); }),
      plain("cd_lagrange", cd_lagrange, MassKind::lumped, impulse),
      plain("cd_lagrange_consistent", cd_lagrange, MassKind::consistent, impulse),
      plain("forward_increment", forward, MassKind::lumped, increments),
      {"modified_mass", true,
       [](Model model, Isa isa) {
         Bench out;
         out.modified = std::make_unique<ModifiedProblem>(std::move(model), MassModification{}, isa);
         out.scheme = std::make_unique<SemiExplicit>(out.modified->system);
         out.settings = {.kind = SchemeKind::modified_mass, .enforcement = EnforcementKind::lagrange};
         return out;
       }},
  };
}

Bench make_bench(const std::string& kind, Model model, Isa isa = chosen_isa()) {
  const std::vector<Kind> list = kinds();
  return std::find_if(list.begin(), list.end(), [&](const Kind& k) { return k.name == kind; })
      ->make(std::move(model), isa);
}

State moving(const System& system, const Vec3& v0) {
  State state;
  state.q.assign(system.solid.dof_count(), 0.0);
  for (std::size_t i = 0; i < state.q.size(); ++i) state.v.push_back(v0[i % 3]);
  state.contact.resize(system.contact.slots());
  return state;
}

/// Largest |r_T| - mu r_n over all rows: the cone of Coulomb.
double outside_cone(const State& state) {
  const ContactResponse& response = state.forces.rows;
  double worst = -1.0;
  for (std::size_t r = 0; r < response.force.size(); ++r) {
    const Vec3& f = response.force[r];
    worst = std::max({worst, std::hypot(f[1], f[2]) - response.rows->law[r].mu * f[0], -f[0]});
  }
  return worst;
}

struct ExplicitBooks : testing::TestWithParam<std::tuple<Kind, Scenario>> {};

TEST_P(ExplicitBooks, Close) {
  const auto& [kind, scenario] = GetParam();
  const Bench bench = kind.make(scenario.model(), chosen_isa());
  const double h = 0.8 * bench.stable();
  double cone = -1.0;
  const History run = march(*bench.scheme, moving(bench.system(), scenario.velocity), h, static_cast<int>(12.0 / h),
                            [&](const State& state) { cone = std::max(cone, outside_cone(state)); });
  ASSERT_TRUE(run.converged);
  const double scale = run.ledger.scale();
  ASSERT_GT(scale, 1e-3);                   // something has happened
  EXPECT_LT(run.imbalance, 1e-10 * scale);  // what a case promises (verdict: energy balance)
  const double momentum = std::sqrt(2.0 * bench.system().mass.total() * scale);
  EXPECT_LT(run.linear_momentum_error, 1e-9 * momentum);  // as for the other schemes: 1e-9 of what energy could carry
  if (scenario.linear) {
    EXPECT_LT(run.angular_momentum_error, 1e-9 * momentum);
  }
  EXPECT_LT(cone, 1e-9);  // forces are of order 1
  if (kind.exact && scenario.linear) {
    EXPECT_LT(std::abs(run.ledger.now().quadrature), 1e-10 * scale);
    EXPECT_EQ(run.ledger.now().contact_stored, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(, ExplicitBooks, testing::Combine(testing::ValuesIn(kinds()), testing::ValuesIn(scenarios())),
                         [](const auto& one) {
                           return std::get<0>(one.param).name + "_" + std::get<1>(one.param).name;
                         });

// ---- laws of contact

// A row that is closed leaves with -e times its velocity (Newton's law), and with e = 0 stays.
TEST(CdLagrange, ObeysNewtonsLawOfRestitution) {
  for (const double e : {0.0, 0.5, 1.0}) {
    Model model = one_part(block_mesh({2, 2, 2}, 0.1));
    ObstacleContact plane = plane_below(model, 0.05, 0.0);
    plane.law.restitution = e;
    model.contacts.emplace_back(plane);
    const Problem p(std::move(model), MassKind::lumped);
    CentralDifferences scheme(p.system, impulse_contact(p.system));
    const double h = 0.1;
    State state = p.moving({0, 0, -0.2}), next;
    scheme.start(state, h);
    std::vector<double> z{0.0}, rates;
    int hits = 0;
    for (int i = 1; i <= 8; ++i) {
      ASSERT_TRUE(scheme.step(state, {i * h, h, 0.0}, next).converged);
      std::swap(state, next);
      z.push_back(state.q[2]);
      rates.push_back((z.back() - z[z.size() - 2]) / h);
      if (rates.size() < 2 || z[z.size() - 2] > -0.05) continue;  // the foot had not closed at the end of the last step
      const double before = rates[rates.size() - 2];
      if (before >= 0.0) continue;
      EXPECT_NEAR(rates.back(), -e * before, 1e-12);
      ++hits;
    }
    EXPECT_GE(hits, 1);
  }
}

/// A block that slides on a plane, mu = 0.3, under a weight that comes up in 14, about two of its periods.
Model sliding_block() {
  Model model = one_part(block_mesh({2, 2, 2}, 0.0));
  model.contacts.emplace_back(plane_below(model, 0.0, 20.0, {10.0, 0.3}));
  model.loads.emplace_back(Gravity{{0, 0, -0.05}, {{0.0, 14.0}, {0.0, 1.0}}});
  return model;
}

// A rigid block comes to v1 = v0 - mu g T / 2 in the time T of the ramp, on a way of v0 T - mu g T^2 / 6, and stops
// after v1 / (mu g) more, on a way of v1^2 / (2 mu g). This one shears by mu rho g H^2 / (2 G), 4 % of the whole way,
// and keeps the vibration of the stop.
TEST(Friction, StopsASlidingBlock) {
  const double v0 = 0.2, mu_g = 0.3 * 0.05, T = 14.0, v1 = v0 - 0.5 * mu_g * T;
  const double stop = T + v1 / mu_g, way = v0 * T - mu_g * T * T / 6 + 0.5 * v1 * v1 / mu_g;
  for (const char* kind : {"cd_lagrange", "forward_increment", "modified_mass"}) {
    const Bench bench = make_bench(kind, sliding_block());
    const double h = 0.5 * bench.stable();
    const History run = march(*bench.scheme, moving(bench.system(), {v0, 0, 0}), h, static_cast<int>(1.5 * stop / h));
    ASSERT_TRUE(run.converged) << kind;
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    EXPECT_NEAR(run.state.q[0], way, 0.05 * way) << kind;
    const double kinetic = 0.5 * bench.system().mass.total() * v0 * v0;
    EXPECT_NEAR(run.ledger.now().friction, kinetic, 0.05 * kinetic) << kind;
  }
}

// A mass of 1 kg on a spring of 1e4 N/m, a bar, presses on a floor with 10 N, mu = 0.1: released at 0.85 mm it turns at
// -0.65, 0.45, -0.25 and 0.05 mm, losing 2 mu N / k at each, and then sticks, since the spring's 0.5 N are less than mu
// N.
TEST(Friction, TurnsAnOscillatorAndHoldsIt) {
  const double k = 1e4, half_period = std::numbers::pi / std::sqrt(k), turns[] = {-0.65e-3, 0.45e-3, -0.25e-3, 0.05e-3};
  for (const auto& contact : {impulse_contact, forward_increment_contact}) {
    StructuredBlock line;
    line.kind = StructuredBlock::Kind::bar;
    line.end = {1, 0, 0};
    Model model;
    model.mesh = std::make_shared<const Mesh>(make_structured_blocks({line}));
    model.parts.push_back({.name = "spring",
                           .cells = {0},
                           .material = LinearElastic{{.E = k, .nu = 0.0, .rho = 2.0}},
                           .type = CellType::line2,
                           .section = Section::bar});
    block(model, "START", {0, 1, 2});
    ObstacleContact floor;
    floor.name = "floor";
    floor.measure = RowMeasure::per_node;
    floor.nodes = model.mesh->nodes_of("END");
    floor.law.mu = 0.1;
    model.contacts.emplace_back(floor);
    model.loads.emplace_back(NodalForce{floor.nodes, {0, 0, -10}, {}});
    const Problem p(std::move(model), MassKind::lumped);
    CentralDifferences scheme(p.system, contact(p.system));
    const std::size_t i = 3 * static_cast<std::size_t>(p.model.mesh->nodes_of("END")[0]);
    State begin = p.moving({});
    begin.q[i] = 0.85e-3;
    constexpr int steps = 10000;  // per half period: extremes are missed by (pi / 20000)^2 / 2 of the amplitude
    std::vector<double> u;
    const History run =
        march(scheme, begin, half_period / steps, 10 * steps, [&](const State& state) { u.push_back(state.q[i]); });
    ASSERT_TRUE(run.converged);
    EXPECT_LT(run.imbalance, 1e-10 * run.ledger.scale());
    for (int turn = 0; turn < 4; ++turn) {
      const auto first = u.begin() + static_cast<std::ptrdiff_t>((turn + 0.5) * steps);
      const auto [low, high] = std::minmax_element(first, first + steps);
      EXPECT_NEAR(turn % 2 == 0 ? *low : *high, turns[turn], 1e-6 * 0.85e-3);
    }
    for (std::size_t n = 5 * steps; n < u.size(); ++n) ASSERT_NEAR(u[n], u[5 * steps], 1e-15);
  }
}

// ---- failures and threads

struct Failure : testing::TestWithParam<const char*> {};

TEST_P(Failure, LeavesNoTrace) {
  const Bench bench = make_bench(GetParam(), on_plane());
  const double h = 0.8 * bench.stable();
  State state = moving(bench.system(), {0.1, 0, -0.2}), next;
  Scheme& scheme = *bench.scheme;
  scheme.start(state, h);
  int i = 0;
  for (; state.forces.rows.status[0] == RowStatus::open && i < 1000; ++i) {
    ASSERT_TRUE(scheme.step(state, {(i + 1) * h, h, 0.0}, next).converged);
    std::swap(state, next);
  }
  ASSERT_LT(i, 1000);
  State broken = state;
  broken.v[2] = std::numeric_limits<double>::quiet_NaN();
  const State kept = state;
  const StepReport failed = scheme.step(broken, {(i + 1) * h, h, 0.0}, next);
  EXPECT_FALSE(failed.converged);
  EXPECT_NE(failed.failure.find("finite"), std::string::npos) << failed.failure;
  EXPECT_EQ(state, kept);
  const StepReport again = scheme.step(state, {(i + 1) * h, h, 0.0}, next);
  EXPECT_TRUE(again.converged);
  EXPECT_LT(std::abs(again.books.energy.imbalance()), 1e-12);
}

// Made again after a longer one, a step is the same to the bit; contact closes in it.
TEST(LongerStep, LeavesNoTrace) {
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    std::vector<State> ends;
    for (const bool longer_first : {false, true}) {
      const Bench bench = kind.make(on_plane(), chosen_isa());
      const double h = 0.4 * bench.stable();
      State state = moving(bench.system(), {0.15, 0.05, -0.2}), next;
      bench.scheme->start(state, h);
      for (int i = 1; i <= 12; ++i) {
        const double t = state.t;
        if (longer_first) {
          ASSERT_TRUE(bench.scheme->step(state, {t + 2.0 * h, 2.0 * h, 0.0}, next).converged);
        }
        ASSERT_TRUE(bench.scheme->step(state, {t + h, h, 0.0}, next).converged);
        std::swap(state, next);
      }
      EXPECT_GT(largest(state.forces.contact.dense()), 0.0);
      ends.push_back(state);
    }
    EXPECT_TRUE(ends[0] == ends[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(, Failure,
                         testing::Values("cd_lagrange", "cd_lagrange_consistent", "forward_increment", "modified_mass"),
                         [](const auto& one) { return std::string(one.param); });

/// 640 cells and 2673 dofs, so that the loops are cut into several chunks; touches in the first step, with friction.
Model wide_impact() {
  Model model = one_part(block_mesh({8, 8, 10}, 0.15));
  model.contacts.emplace_back(plane_below(model, 0.002, 20.0, {10.0, 0.3}));
  return model;
}

TEST(Threads, DoNotChangeABit) {
  for (const Kind& kind : kinds()) {
    if (kind.name == "cd_lagrange_consistent") continue;  // 81 x 3 solves per step
    std::vector<State> states;
    for (const int threads : {1, 2, 4}) {
      set_threads(threads);
      const Bench bench = kind.make(wide_impact(), chosen_isa());
      const History run = march(*bench.scheme, moving(bench.system(), {0.1, 0.05, -0.2}), 0.05, 3);
      EXPECT_TRUE(run.converged);
      EXPECT_GT(std::abs(run.ledger.now().impact) + run.ledger.now().contact_stored, 0.0) << kind.name;
      states.push_back(run.state);
    }
    EXPECT_TRUE(states[1] == states[0]) << kind.name;
    EXPECT_TRUE(states[2] == states[0]) << kind.name;
    set_threads(0);
  }
}

// ---- the modified mass

double total(const Mass& mass) {
  return std::accumulate(mass.node_diagonal().begin(), mass.node_diagonal().end(), 0.0);
}

TEST(ModifiedMass, KeepsTheTotalAndEmptiesContactNodes) {
  for (const MassSpread spread : {MassSpread::layers, MassSpread::least_squares}) {
    const Model model = on_plane();
    const Solid solid(model);
    const Mass before = solid.mass(MassKind::lumped);
    const ModifiedMass after = modify_mass(solid, model, {.spread = spread});
    EXPECT_NEAR(total(after.mass), total(before), 1e-14 * total(before));
    EXPECT_EQ(after.shift.contact_nodes, 9U);
    for (std::size_t n = 0; n < before.node_diagonal().size(); ++n) {
      const bool in_contact = model.mesh->coordinates[n][2] == 0.0;
      EXPECT_EQ(after.mass.node_diagonal()[n] == 0.0, in_contact);
      EXPECT_GE(after.mass.node_diagonal()[n], in_contact ? 0.0 : 0.25 * before.node_diagonal()[n]);
    }
    EXPECT_EQ(describe(after.shift).size(), 4U);
  }
}

/// Total, first and second moments of the masses.
std::array<double, 10> moments(const Mesh& mesh, const Mass& mass) {
  std::array<double, 10> sums{};
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const auto& [x, y, z] = mesh.coordinates[n];
    const std::array<double, 10> p{1, x, y, z, x * x, y * y, z * z, x * y, y * z, z * x};
    for (std::size_t i = 0; i < 10; ++i) sums[i] += mass.node_diagonal()[n] * p[i];
  }
  return sums;
}

TEST(ModifiedMass, KeepsCentreAndInertiaByLeastSquares) {
  // Four cells high: masses fall to their floor; twelve: none does.
  for (const int height : {4, 12}) {
    Model model = one_part(block_mesh({2, 2, height}, 0.15));
    model.contacts.emplace_back(plane_below(model, 0.05, 20.0));
    const Solid solid(model);
    const ModifiedMass after = modify_mass(solid, model, {.spread = MassSpread::least_squares});
    const auto wanted = moments(*model.mesh, solid.mass(MassKind::lumped)), got = moments(*model.mesh, after.mass);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-12 * wanted[6]);  // z^2 is the largest
    EXPECT_LT(norm(after.shift.centre), 1e-12);
    EXPECT_LT(after.shift.inertia, 1e-12);
    EXPECT_LE(after.shift.largest_loss, 0.75 + 1e-12);
  }
}

// A column of ten cells: half a cell's mass moves from z = 0 to the mean of z = 1 ... 4, of ten cells in all.
TEST(ModifiedMass, SaysByHowMuchTheCentreShifts) {
  Model model = one_part(block_mesh({1, 1, 10}, 0.0));
  model.contacts.emplace_back(plane_below(model, 0.05, 20.0));
  const Solid solid(model);
  const MassShift shift = modify_mass(solid, model, {.layers = 4}).shift;
  EXPECT_NEAR(shift.moved / shift.total, 0.05, 1e-14);
  EXPECT_NEAR(shift.centre[2], 0.05 * 2.5, 1e-13);
  EXPECT_NEAR(shift.largest_gain, 0.125, 1e-13);
}

TEST(ModifiedMass, TakesBothSidesOfAPairAndKeepsEachBodysMass) {
  StructuredBlock lower, upper;
  lower.size = upper.size = {1, 1, 4};
  lower.divisions = {1, 1, 4};
  upper.divisions = {1, 1, 8};
  upper.origin = {0, 0, 4.1};
  lower.face_groups = {"", "", "", "", "", "MASTER"};
  upper.face_groups = {"", "", "", "", "SLAVE", ""};
  Model model = one_part(make_structured_blocks({lower, upper}));
  PairContact pair;
  pair.name = "pair";
  pair.slave.facets = faces_of(*model.mesh, "SLAVE");
  pair.master.facets = faces_of(*model.mesh, "MASTER");
  model.contacts.emplace_back(pair);
  const Solid solid(model);
  const ModifiedMass after = modify_mass(solid, model, {});
  EXPECT_EQ(after.shift.contact_nodes, 8U);
  double below = 0.0;
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n) {
    const double z = model.mesh->coordinates[n][2];
    if (z < 4.05) below += after.mass.node_diagonal()[n];
    EXPECT_EQ(after.mass.node_diagonal()[n] == 0.0, z == 4.0 || z == 4.1);
  }
  EXPECT_NEAR(below, unit_material.rho * 4.0, 1e-13);
}

TEST(ModifiedMass, RefusesABodyOfContactNodesAlone) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  ObstacleContact plane = plane_below(model, 0.1, 1.0);
  for (const Facet& facet : faces_of(*model.mesh, "ZMAX")) plane.surface.facets.push_back(facet);
  model.contacts.emplace_back(plane);
  const Solid solid(model);
  EXPECT_THROW(modify_mass(solid, model, {}), std::invalid_argument);
  EXPECT_THROW(modify_mass(solid, model, {.spread = MassSpread::least_squares}), std::invalid_argument);
}

/// A column of cells all of whose skin is in contact.
Model column_in_contact(const std::array<int, 3>& cells) {
  Model model = one_part(block_mesh(cells, 0.0));
  ObstacleContact plane = plane_below(model, 0.1, 1.0);
  plane.surface.facets.clear();
  for (const char* group : {"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"}) {
    for (const Facet& facet : faces_of(*model.mesh, group)) plane.surface.facets.push_back(facet);
  }
  model.contacts.emplace_back(plane);
  return model;
}

// The skin's mass stays at its height: each inner section holds one cell's height of the column, the first and the last
// the half cell at the end besides. (Spread over the whole patch, all nine would hold 10/9.) A section's skin, 5/9 of
// it, goes up, level and down as 1 : 4 : 1, but at the first one, which has nothing below, 1/5 goes up for 1/6 that
// comes.
TEST(ModifiedMass, StaysWhereItIsAlongABodyWhoseWholeSkinIsInContact) {
  const Model model = column_in_contact({3, 3, 10});
  const Solid solid(model);
  const ModifiedMass after = modify_mass(solid, model, {});
  std::map<long, double> sections;
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n)
    sections[std::lround(model.mesh->coordinates[n][2])] += after.mass.node_diagonal()[n];
  const double of_cells = unit_material.rho * 9.0;
  for (const auto& [z, mass] : sections) {
    const long from_end = std::min(z, 10 - z);
    const double change = 5.0 / 9.0 * (1.0 / 5.0 - 1.0 / 6.0);
    const double wanted = from_end == 0 ? 0.0 : from_end == 1 ? 1.5 - change : from_end == 2 ? 1.0 + change : 1.0;
    EXPECT_NEAR(mass, wanted * of_cells, 1e-13 * 10.0 * of_cells) << z;
  }
}

// Multipliers move nodes without mass only. Where a row closes between two that have kept theirs, the step says so.
TEST(ModifiedMass, NamesContactBetweenNodesThatHaveKeptTheirMass) {
  StructuredBlock lower, upper;
  lower.size = upper.size = {1.0, 1.0, 1.0};
  upper.origin = {0.0, 0.0, 0.99};
  lower.face_groups = {"", "", "", "", "", "TOP"};
  upper.face_groups = {"", "", "", "", "BOTTOM", ""};
  Model model = one_part(make_structured_blocks({lower, upper}));
  PairContact pair;
  pair.slave.facets = faces_of(*model.mesh, "BOTTOM");
  pair.master.facets = faces_of(*model.mesh, "TOP");
  model.contacts.emplace_back(pair);
  const Problem problem(model, MassKind::lumped);
  SemiExplicit scheme(problem.system);
  State state = problem.moving({0.0, 0.0, 0.0});
  try {
    scheme.start(state, 1e-3);
    ADD_FAILURE() << "a row without compliance has closed";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("Choose another scheme"), std::string::npos) << e.what();
  }
}

// Two cells across leave one line of inner nodes, around which the skin would turn without inertia; held, it does not.
TEST(ModifiedMass, RefusesABodyWhoseMassIsLeftOnALine) {
  for (const auto& [across, turns] : {std::pair{2, true}, {3, false}}) {
    Model model = column_in_contact({across, across, 6});
    const Solid solid(model);
    if (turns) {
      EXPECT_THROW(modify_mass(solid, model, {}), std::invalid_argument);
    } else {
      EXPECT_NO_THROW(modify_mass(solid, model, {}));
    }
    block(model, "ZMAX", {0, 1, 2});
    EXPECT_NO_THROW(modify_mass(solid, model, {}));
  }
}

// ---- the stable step through a run

// The sum of the squares of both frequencies bounds that of the sum, and is at most twice as large (Weyl).
TEST(StableStepWatch, StaysOnTheSafeSideOfTheLinearLimit) {
  for (const MassKind kind : {MassKind::lumped, MassKind::consistent}) {
    const Problem p(on_plane(), kind);
    const std::vector<double> zero(p.solid.dof_count(), 0.0);
    const StableStep start = stable_step(p.system);
    const StableStepWatch watch(RestFrequencies(p.system), 2.0, EnforcementKind::penalty);
    const StableStep now = watch.with(*p.rows(), zero);
    EXPECT_LE(now.dt, 1.001 * start.dt);  // 1e-3: the tolerance of stable_step itself
    const double least =
        kind == MassKind::lumped ? 0.7 : 0.2;  // of a consistent mass the bound takes 1/8 of the diagonal
    EXPECT_GE(now.dt, least * start.dt);
    EXPECT_EQ(now.dt_closing, start.dt_closing);
    const StableStepWatch exact(RestFrequencies(p.system), 2.0, EnforcementKind::lagrange);
    EXPECT_NEAR(exact.with(*p.rows(), zero).advised(), start.dt_free, 1e-3 * start.dt_free);
  }
}

// Crushed to a quarter of its height along z, a neo-Hookean block is stiffer; the watch was started at rest.
TEST(StableStepWatch, SeesTheBodyChange) {
  Model model = finite_strain();
  const Problem p(std::move(model), MassKind::lumped);
  const std::vector<double> zero(p.solid.dof_count(), 0.0);
  StableStepWatch watch(RestFrequencies(p.system), 2.0, EnforcementKind::lagrange),
      fresh(RestFrequencies(p.system), 2.0, EnforcementKind::lagrange);
  const auto step_at = [&](StableStepWatch& of, const std::vector<double>& u) {
    of.follow_bodies(state_at(u));
    return of.with({}, u).dt;
  };
  const double at_rest = step_at(watch, zero);
  double now = at_rest;
  std::vector<double> u = zero;
  for (int k = 1; k <= 15; ++k) {
    u = affine(*p.model.mesh, {Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{0, 0, -0.05 * k}});
    now = step_at(watch, u);
  }
  EXPECT_LT(now, 0.7 * at_rest);
  EXPECT_NEAR(now, step_at(fresh, u), 0.03 * now);
}

}  // namespace
}  // namespace carom::schemes_explicit_step_test
