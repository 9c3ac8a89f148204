// Rigid bodies that turn: mass and inertia of the four nodes, and the forces that hold the directors.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "solid/cell_values.hpp"
#include "solid/stability.hpp"
#include "solid_fixture.hpp"
#include "turning_body_fixture.hpp"

namespace carom::solid_turning_bodies_test {
namespace {

using namespace test;

/// Inertia 2, 3, 4 along axes turned by 0.6 about (1, 2, 2) / 3, as a tensor.
const Vec3 moments{2.0, 3.0, 4.0};

struct Tensor {
  Vec3 diagonal{}, off{};
};

/// sum over k of I_k e_k e_k with the axes e_k = R of the fixture.
Tensor turned_inertia() {
  const Vec3 n{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  Tensor t;
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 e{};
    e[k] = 1.0;
    const Vec3 r = add(scaled(e, std::cos(0.6)),
                       add(scaled(cross(n, e), std::sin(0.6)), scaled(n, dot(n, e) * (1.0 - std::cos(0.6)))));
    for (std::size_t i = 0; i < 3; ++i) {
      t.diagonal[i] += moments[k] * r[i] * r[i];
      t.off[i] += moments[k] * r[i] * r[(i + 1) % 3];  // xy, yz, zx
    }
  }
  return t;
}

TurningBody turned_body() {
  const Tensor t = turned_inertia();
  return make_turning_body(5.0, {0.3, -0.2, 0.1}, t.diagonal, t.off);
}

// sum of m/4 (|r|^2 1 - r r) over the four corners is the inertia that was given; their mean is the centre.
TEST(TurningBody, HasTheInertiaThatWasGiven) {
  const TurningBody body = turned_body();
  const Tensor wanted = turned_inertia();
  Tensor found;
  Vec3 mean{};
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 r = subtract(corner(body, a), body.centre);
    mean = add(mean, scaled(r, 0.25));
    for (std::size_t i = 0; i < 3; ++i) {
      found.diagonal[i] += 0.25 * body.mass * (dot(r, r) - r[i] * r[i]);
      found.off[i] -= 0.25 * body.mass * r[i] * r[(i + 1) % 3];
    }
  }
  EXPECT_LT(norm(mean), 1e-15);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.diagonal[i], wanted.diagonal[i], 1e-14);
    EXPECT_NEAR(found.off[i], wanted.off[i], 1e-14);
  }
  EXPECT_NEAR(dot(body.axes[0], cross(body.axes[1], body.axes[2])), 1.0, 1e-14);
}

TEST(TurningBody, RefusesAnInertiaThatNoBodyHas) {
  EXPECT_NO_THROW(make_turning_body(1.0, {}, {1.0, 1.0, 1.9}, {}));
  for (const Vec3& I : {Vec3{1.0, 1.0, 2.0}, Vec3{1.0, 1.0, 3.0}, Vec3{-1.0, 1.0, 1.0}, Vec3{0.0, 1.0, 1.0}}) {
    try {
      make_turning_body(1.0, {}, I, {});
      FAIL() << I[2];
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("principal moments of inertia"), std::string::npos);
    }
  }
}

/// A turned, shifted and slightly strained state.
std::vector<double> some_state(const Model& model, unsigned seed) {
  std::vector<double> u =
      affine(*model.mesh, {{{-0.4, -0.8, 0.1}, {0.8, -0.4, 0.2}, {-0.2, 0.1, 0.05}}}, {1.0, -2.0, 0.5});
  const std::vector<double> noise = random_vector(u.size(), seed);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] += 0.1 * noise[i];
  return u;
}

// By central differences of steps 1e-5: errors of 1e-10 of quantities near 1e2 (third derivatives) and 1e-16 / 1e-5 of
// them.
TEST(TurningBody, ForceAndTangentAreDerivatives) {
  const Model model = lone_body(turned_body(), 3.0);
  const Solid solid(model);
  EXPECT_FALSE(solid.is_linear());
  const std::vector<double> u = some_state(model, 1), f = internal_force(solid, u);
  const auto K = dense(solid.tangent(u));
  const std::vector<double> diagonal = solid.tangent_diagonal(u);
  constexpr double h = 1e-5, tolerance = 2e-7;
  for (std::size_t j = 0; j < u.size(); ++j) {
    std::vector<double> up = u, down = u, unit(u.size(), 0.0), action(u.size());
    up[j] += h;
    down[j] -= h;
    unit[j] = 1.0;
    EXPECT_NEAR((strain_energy(solid, up) - strain_energy(solid, down)) / (2.0 * h), f[j], tolerance);
    const std::vector<double> f_up = internal_force(solid, up), f_down = internal_force(solid, down);
    solid.tangent_action(u, unit, action);
    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_NEAR((f_up[i] - f_down[i]) / (2.0 * h), K[i][j], tolerance);
      EXPECT_NEAR(action[i], K[i][j], 1e-12);
    }
    EXPECT_NEAR(diagonal[j], K[j][j], 1e-12);
  }
}

TEST(TurningBody, ForcesHaveNoResultantNoMomentAndWorkWhatTheyStore) {
  const Model model = lone_body(turned_body(), 3.0);
  const Solid solid(model);
  const std::vector<double> u_0 = some_state(model, 1), u_1 = some_state(model, 2);
  std::vector<double> f(u_0.size());
  solid.discrete_gradient_force(u_0, u_1, f);
  double work = 0.0;
  Vec3 force{}, moment{};
  for (std::size_t n = 0; n < f.size() / 3; ++n) {
    Vec3 at{}, p{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * n + c;
      work += f[i] * (u_1[i] - u_0[i]);
      at[c] = model.mesh->coordinates[n][c] + 0.5 * (u_0[i] + u_1[i]);
      p[c] = f[i];
    }
    force = add(force, p);
    moment = add(moment, cross(at, p));
  }
  EXPECT_GT(largest(f), 0.1);
  EXPECT_NEAR(work, strain_energy(solid, u_1) - strain_energy(solid, u_0), 1e-12);
  EXPECT_LT(norm(force), 1e-13);
  EXPECT_LT(norm(moment), 1e-12);
}

// K x = omega^2 M x with six eigenvalues omega^2 and six zeros; M = m / 4.
TEST(TurningBody, AllVibrationsOfTheDirectorsHaveOneFrequency) {
  const Model model = lone_body(turned_body(), 3.0);
  const Solid solid(model);
  auto K = dense(solid.tangent(std::vector<double>(12, 0.0)));
  for (auto& row : K)
    for (double& k : row) k /= 5.0 / 4.0;
  const std::vector<double> values = eigenvalues(K);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_NEAR(values[i], i < 6 ? 0.0 : 9.0, 1e-12) << i;
  const Mass mass = solid.mass(MassKind::consistent);
  EXPECT_NEAR(mass.total(), 5.0, 1e-14);
  for (const double m : mass.node_diagonal()) EXPECT_EQ(m, 5.0 / 4.0);
}

TEST(TurningBody, TakesHalfTheLargestFrequencyOfTheMesh) {
  Mesh mesh = block_mesh({2, 2, 2}, 0.1);
  TurningBody body = make_turning_body(5.0, {9, 9, 9}, moments, {});
  add_nodes(mesh, body);
  Model model = one_part(std::move(mesh));
  model.turning_bodies.push_back(body);
  const Solid solid(model);
  const std::vector<double> bounds = cell_frequency_bounds(solid);
  const double expected = 0.25 * *std::max_element(bounds.begin(), bounds.end());
  // A uniform stretch of the first axis by e: W = 1/2 k_11 E_11^2, k_11 = omega^2 m r_1^2, E_11 = e + e^2/2.
  const double e = 1e-3, strain = e + 0.5 * e * e;
  std::vector<double> u(solid.dof_count(), 0.0);
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 r = subtract(corner(body, a), body.centre);
    for (std::size_t c = 0; c < 3; ++c)
      u[3 * static_cast<std::size_t>(body.nodes[a]) + c] = e * dot(r, body.axes[0]) * body.axes[0][c];
  }
  const double k = 5.0 * body.radii[0] * body.radii[0] * expected;
  EXPECT_NEAR(strain_energy(solid, u), 0.5 * k * strain * strain, 1e-12 * k);
  EXPECT_NEAR(solid.turning_bodies().largest_strain(u), strain, 1e-15);
}

TEST(TurningBody, KeepsItsMassWhereCellsAreScaled) {
  Mesh mesh = block_mesh({2, 1, 1}, 0.1);
  TurningBody body = make_turning_body(5.0, {9, 9, 9}, moments, {});
  add_nodes(mesh, body);
  Model model = one_part(std::move(mesh));
  model.turning_bodies.push_back(body);
  const Solid solid(model);
  const std::vector<double> factors(solid.cells().size(), 1.0);
  EXPECT_EQ(solid.lumped_mass(factors).node_diagonal(), solid.mass(MassKind::lumped).node_diagonal());
}

}  // namespace
}  // namespace carom::solid_turning_bodies_test
