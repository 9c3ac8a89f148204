// Rigid bodies that turn, with the time schemes: free tops, and hits.
#include <gtest/gtest.h>

#include <cmath>

#include "schemes_implicit.hpp"
#include "turning_body_fixture.hpp"

namespace carom::schemes_turning_bodies_test {
namespace {

using namespace test;

Vec3 body_angular_velocity(const TurningBody& body, const State& state) {
  const BodyFrame at = position_of(body, state.q);
  const Vec3 omega = angular_velocity(at, velocity_of(body, state.v));
  return {dot(omega, at.directors[0]), dot(omega, at.directors[1]), dot(omega, at.directors[2])};
}

State spinning(const Problem& p, const Vec3& velocity, const Vec3& omega) {
  State state = p.moving({});
  spin(p.model.turning_bodies[0], velocity, omega, state.v);
  return state;
}

std::unique_ptr<Scheme> energy_momentum(const Problem& p, double h) {
  return std::make_unique<EnergyMomentum>(p.system, ImplicitSettings{}, h,
                                          stable_step(p.system).omega_max_squared_free);
}

/// Moments A, A, C; spin omega_3 about the third axis and transverse omega_1.
constexpr double A = 2.0, C = 1.2;

/// Angle between the director 3 at the end and where the steady precession has it: d_3 turns about the angular momentum
/// L at the rate L / A (H. Goldstein, Classical Mechanics, 1980, section 5-6).
double precession_error(double h, bool implicit_steps) {
  const Vec3 omega{0.8, 0.0, 1.5};
  const double end = 6.0;
  const Problem p(lone_body(make_turning_body(3.0, {0.5, 0, 0}, {A, A, C}, {}), implicit_steps ? 1000.0 : 1.5 / h));
  const auto scheme = implicit_steps ? energy_momentum(p, h) : central(p);
  const History run = march(*scheme, spinning(p, {0.2, 0, 0}, omega), h, static_cast<int>(std::lround(end / h)));
  EXPECT_TRUE(run.converged) << run.failure;
  // Explicit: round-off of 3000 steps of a momentum near 3. Implicit: what Newton's method may leave, which is the
  // rounding of the displacement times the directors' stiffness, 1e6 x 1e-15.
  EXPECT_LT(run.angular_momentum_error, implicit_steps ? 1e-9 : 1e-12);
  EXPECT_LT(run.linear_momentum_error, 1e-12);
  EXPECT_LT(run.imbalance, implicit_steps ? 1e-9 : 1e-12);
  const Vec3 L{A * omega[0], 0.0, C * omega[2]};
  const Vec3 n = normalized(L), d{0.0, 0.0, 1.0};
  const double angle = norm(L) / A * end;
  const Vec3 expected = add(scaled(d, std::cos(angle)),
                            add(scaled(cross(n, d), std::sin(angle)), scaled(n, dot(n, d) * (1.0 - std::cos(angle)))));
  return norm(subtract(position_of(p.model.turning_bodies[0], run.state.q).directors[2], expected));
}

// Order 2: the step enters by omega^2 h^2 / 24 t, the directors' stiffness by (omega / frequency)^2 ~ h^2 alike.
TEST(TurningBodies, SymmetricTopPrecessesExactly) {
  const double coarse = precession_error(4e-3, false), fine = precession_error(2e-3, false);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
  const double coarse_em = precession_error(4e-2, true), fine_em = precession_error(2e-2, true);
  EXPECT_LT(fine_em, 2e-3);
  EXPECT_NEAR(coarse_em / fine_em, 4.0, 0.4);
}

// A body that spins about its middle axis turns over again and again; the times between are 2 K(k) / lambda (L. D.
// Landau, E. M. Lifshitz, Mechanics, section 37).
TEST(TurningBodies, SpinAboutTheMiddleAxisTurnsOver) {
  const Vec3 I{1.0, 1.5, 2.0}, start{0.2, 1.0, 0.2};
  double twice_energy = 0.0, L2 = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    twice_energy += I[i] * start[i] * start[i];
    L2 += I[i] * I[i] * start[i] * start[i];
  }
  ASSERT_GT(L2, twice_energy * I[1]);
  const double k2 = (I[1] - I[0]) * (twice_energy * I[2] - L2) / ((I[2] - I[1]) * (L2 - twice_energy * I[0]));
  const double lambda = std::sqrt((I[2] - I[1]) * (L2 - twice_energy * I[0]) / (I[0] * I[1] * I[2]));
  const double expected = 2.0 * std::comp_ellint_1(std::sqrt(k2)) / lambda;
  const double h = 2e-3;
  const Problem p(lone_body(make_turning_body(1.0, {}, I, {}), 500.0));
  const TurningBody& body = p.model.turning_bodies[0];
  for (const bool implicit_steps : {false, true}) {
    std::vector<double> flips;
    double before = start[1], energy_drift = 0.0;
    const auto scheme = implicit_steps ? energy_momentum(p, h) : central(p);
    const History run = march(*scheme, spinning(p, {}, start), h, 30000, [&](const State& state) {
      const double w = body_angular_velocity(body, state)[1];
      if (w * before < 0.0) flips.push_back(state.t - h * w / (w - before));
      before = w;
      energy_drift = std::max(energy_drift, std::abs(state.forces.stored.mechanical() / (0.5 * twice_energy) - 1.0));
    });
    ASSERT_TRUE(run.converged) << run.failure;
    ASSERT_GE(flips.size(), 4U);
    // Near the separatrix the time depends on the logarithm of the small components, whose error is h^2 / 24 x turns.
    for (std::size_t i = 1; i < flips.size(); ++i) EXPECT_NEAR(flips[i] - flips[i - 1], expected, 2e-3 * expected);
    // Explicit: T + U is off the shadow energy by (omega h)^2. Implicit: 30000 steps' rounding.
    EXPECT_LT(energy_drift, implicit_steps ? 1e-10 : 1e-5);
    EXPECT_LT(run.angular_momentum_error, implicit_steps ? 1e-10 : 1e-11);
    EXPECT_LT(p.solid.turning_bodies().largest_strain(run.state.q), 1e-4);
  }
}

/// A mass point that flies against a rigid box, off its middle, both free: velocities after an elastic hit.
struct PointHitsBox {
  Model model;
  Index point = 0;
  double point_mass = 0.4;
  Vec3 at{0.35, 0.25, -1.05}, velocity{0.0, 0.0, 1.0};  // below the face z = -1

  PointHitsBox(double frequency, double stiffness) {
    Mesh mesh;
    mesh.coordinates.push_back(at);
    mesh.node_numbers.push_back(1);
    TurningBody body = make_turning_body(2.0, {}, {0.9, 1.0, 0.8}, {});
    body.name = "box";
    body.frequency = frequency;
    add_nodes(mesh, body);
    model.mesh = std::make_shared<const Mesh>(std::move(mesh));
    model.turning_bodies.push_back(body);
    model.rigid_bodies.push_back({"point", point, point_mass});
    ObstacleContact contact;
    contact.name = "box";
    contact.shape = Box{{-0.5, -0.5, -1.0}, {0.5, 0.5, 1.0}};
    contact.measure = RowMeasure::per_node;
    contact.nodes = {point};
    contact.law.eps_N = stiffness;
    contact.body = 0;
    model.contacts.emplace_back(contact);
  }
};

// Impulse J = 2 v / (1/m1 + 1/m + (r x n) . I^-1 (r x n)) for an elastic hit without friction (W. Goldsmith, Impact,
// 1960, section 1.4). The hit lasts pi / omega_hit with omega_hit^2 = stiffness x (the bracket); that it takes time
// lets the box turn meanwhile, by 1 / omega_hit, and the directors ring by (omega_hit / frequency)^2.
TEST(TurningBodies, AreHitOffTheirMiddleAsRigidBodies) {
  const Vec3 I{0.9, 1.0, 0.8}, n{0, 0, -1};
  for (const bool implicit_steps : {false, true}) {
    PointHitsBox hit(2e4, 1e5);
    const Vec3 r{hit.at[0], hit.at[1], -1.0}, arm = cross(r, n);
    double inverse = 1.0 / hit.point_mass + 1.0 / 2.0;
    for (std::size_t c = 0; c < 3; ++c) inverse += arm[c] * arm[c] / I[c];
    const double J = 2.0 / inverse;
    const Problem p(hit.model);
    State state = p.moving({});
    state.v[2] = 1.0;
    const double h = implicit_steps ? 4e-5 : 8e-5;
    const auto scheme = implicit_steps ? energy_momentum(p, h) : central(p);
    const History run = march(*scheme, state, h, static_cast<int>(0.08 / h));
    ASSERT_TRUE(run.converged) << run.failure << " t " << run.state.t << " z " << run.state.q[2];
    const TurningBody& body = p.model.turning_bodies[0];
    const Vec3 omega = body_angular_velocity(body, run.state), v = velocity_of(body, run.state.v).centre;
    constexpr double tolerance = 2e-3;  // 1 / omega_hit = 1.5e-3 of an angle
    EXPECT_NEAR(run.state.v[2], 1.0 - J / hit.point_mass, tolerance);
    EXPECT_NEAR(v[2], J / 2.0, tolerance);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(omega[c], -J * arm[c] / I[c], tolerance);
    // Implicit: the directors' forces of 2e8 round to 2e-8, in every step for h.
    EXPECT_LT(run.linear_momentum_error, implicit_steps ? 1e-9 : 1e-12);
    EXPECT_LT(run.angular_momentum_error, implicit_steps ? 1e-9 : 1e-12);
  }
}

/// A block of rubber, 2 x 2 x 2 cells, that flies obliquely against a corner region of a free box and rubs there.
struct BlockHitsBox {
  Model model;

  explicit BlockHitsBox(double mu) {
    Mesh mesh = block_mesh({2, 2, 2}, 0.0);
    const auto nodes = mesh.node_count();
    TurningBody body = make_turning_body(6.0, {1.9, 1.6, -0.8}, {1.6, 1.9, 2.1}, {0.1, 0.0, -0.1});
    body.name = "box";
    body.rigidity = 20.0;  // cells are large: their highest frequency is near those of the hit
    add_nodes(mesh, body);
    model = one_part(std::move(mesh));
    model.parts[0].material = StVenantKirchhoff{{.E = 20.0, .nu = 0.3, .rho = 0.5}};
    model.turning_bodies.push_back(body);
    ObstacleContact contact;
    contact.name = "box";
    contact.shape = Box{{0.5, 0.2, -1.55}, {3.3, 3.0, -0.05}};
    contact.measure = RowMeasure::per_node;
    for (std::size_t n = 0; n < nodes; ++n)
      if (model.mesh->coordinates[n][2] == 0.0) contact.nodes.push_back(static_cast<Index>(n));
    contact.law = {.eps_N = 40.0, .eps_T = 40.0, .mu = mu};
    contact.body = 0;
    model.contacts.emplace_back(contact);
  }
};

struct AfterHit {
  Vec3 velocity{}, omega{};
  Momentum change{};
};

AfterHit hit(const Problem& p, Scheme& scheme, double h, double linear_limit, double angular_limit) {
  State state = p.moving({0.3, 0.1, -1.0});
  spin(p.model.turning_bodies[0], {}, {0.0, 0.2, 0.1}, state.v);
  const History run = march(scheme, state, h, static_cast<int>(std::lround(2.5 / h)));
  EXPECT_TRUE(run.converged) << run.failure;
  EXPECT_LT(run.linear_momentum_error, linear_limit);
  EXPECT_LT(run.angular_momentum_error, angular_limit);
  EXPECT_LT(p.solid.turning_bodies().largest_strain(run.state.q), 1e-3);
  const TurningBody& body = p.model.turning_bodies[0];
  return {velocity_of(body, run.state.v).centre, body_angular_velocity(body, run.state), run.ledger.momentum()};
}

// Momentum of the whole: 4 x (0.3, 0.1, -1), nothing from outside. Central differences keep both momenta to round-off.
// Implicit equations are solved to what the directors' stiffness makes of the rounding of displacements; the
// energy-momentum scheme keeps the angular momentum as well, Moreau-Jean to the order of its step.
TEST(TurningBodies, HitByABlockKeepTheMomentaOfTheWhole) {
  const BlockHitsBox both(0.3);
  const Problem lumped(both.model, MassKind::lumped);
  const double h = 0.5 * stable_step(lumped.system).dt;
  const AfterHit explicit_hit = hit(lumped, *central(lumped), h, 1e-12, 1e-12);
  const AfterHit mean_hit = hit(lumped, *energy_momentum(lumped, h), h, 1e-9, 1e-9);
  const auto moreau_jean = std::make_unique<MoreauJean>(lumped.system, MoreauJeanParameters{0.5},
                                                        ImplicitSettings{.enforcement = EnforcementKind::impulse}, h,
                                                        stable_step(lumped.system).omega_max_squared_free);
  const AfterHit impulsive = hit(lumped, *moreau_jean, h, 1e-9, 1e-2);
  EXPECT_LT(explicit_hit.velocity[2], -0.3);  // the box has been hit and turns
  EXPECT_GT(norm(subtract(explicit_hit.omega, {0.0, 0.2, 0.1})), 0.1);
  // The same forces, mass and step: they differ by the schemes' errors alone, of order 2, and by when a row closes.
  EXPECT_LT(norm(subtract(explicit_hit.velocity, mean_hit.velocity)), 0.01 * norm(explicit_hit.velocity));
  EXPECT_LT(norm(subtract(explicit_hit.omega, mean_hit.omega)), 0.01 * norm(explicit_hit.omega));
  // Impulses without restitution take the energy of what stops.
  EXPECT_LT(norm(subtract(explicit_hit.velocity, impulsive.velocity)), 0.2 * norm(explicit_hit.velocity));
}

}  // namespace
}  // namespace carom::schemes_turning_bodies_test
