// Distortion control: the energy of corners that nearly fold, and what follows from it.
#include <gtest/gtest.h>

#include <cmath>

#include "linalg/dense.hpp"
#include "mesh/cell_topology.hpp"
#include "parallel/threads.hpp"
#include "solid/distortion_control.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_distortion_test {
namespace {

constexpr double limit = 0.2, modulus = 3.0;

/// One cell of a type, of size 1, with its volume at rest.
struct Cell {
  std::shared_ptr<const Mesh> mesh;
  std::vector<Index> nodes;
  double volume = 0.5;

  explicit Cell(CellType type)
      : mesh(std::make_shared<const Mesh>(
            with_cells(dimension(type) == 2 ? quad_mesh(1, 1, 0.0) : block_mesh({1, 1, 1}, 0.0), type))) {
    const auto& connectivity = mesh->block(type)->connectivity;
    nodes.assign(connectivity.begin(), connectivity.begin() + node_count(type));
  }
  DistortionControl control(CellType type) const {
    return {mesh, type, nodes, std::vector<double>{volume}, limit, modulus};
  }
  std::size_t dofs() const { return 3 * mesh->node_count(); }
};

/// One of the corners goes to a share `at` of its height over its other neighbours, and everything is disturbed.
std::vector<double> flattened(const Cell& cell, CellType type, double share, double noise) {
  std::vector<double> u = random_vector(cell.dofs(), 5);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] *= dimension(type) == 2 && i % 3 == 2 ? 0.0 : noise;
  const CornerFrame frame = cell_corners(type)[0];
  const auto& X = cell.mesh->coordinates;
  for (std::size_t i = 0; i < 3; ++i)
    u[3 * at(cell.nodes[frame.a]) + i] +=
        (share - 1.0) * (X[at(cell.nodes[frame.a])][i] - X[at(cell.nodes[frame.corner])][i]);
  return u;
}

double energy(const DistortionControl& control, const std::vector<double>& u) {
  std::vector<double> f(u.size(), 0.0);
  return control.add_force(0, u, f);
}

/// Central differences of fourth order.
template <class Function>
double slope(const Function& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

TEST(Distortion, TheEnergyOfACornerIsTheFormula) {
  const CornerEnergy at_limit(limit, limit), half(0.5 * limit, limit), flat(0.0, limit), beyond(-limit, limit);
  EXPECT_EQ(at_limit.energy, 0.0);
  EXPECT_EQ(at_limit.slope, 0.0);
  EXPECT_NEAR(at_limit.stiffness, 1.0 / limit, 1e-14);
  EXPECT_NEAR(half.energy, limit * (std::log(2.0) - 0.5), 1e-15);
  EXPECT_NEAR(half.slope, -1.0, 1e-14);
  EXPECT_NEAR(flat.slope, -19.0, 1e-13);
  EXPECT_NEAR(beyond.slope, -119.0, 1e-12);
  // w and its derivatives are continuous where the parabola begins; 1e-9 of J off it they differ by w'' of it.
  const CornerEnergy above(0.1 * limit * (1.0 + 1e-9), limit), below(0.1 * limit * (1.0 - 1e-9), limit);
  EXPECT_NEAR(above.energy, below.energy, 1e-8);
  EXPECT_NEAR(above.slope, below.slope, 1e-6);
  EXPECT_NEAR(above.stiffness, below.stiffness, 1e-5);
}

class DistortionOf : public testing::TestWithParam<CellType> {};

// Corners on both sides of where the parabola begins. Errors of the differences: 1e-16 of energies near 1 over steps of
// 1e-4, and h^4 of fifth derivatives near 1e6.
TEST_P(DistortionOf, ForceAndStiffnessAreDerivatives) {
  const Cell cell(GetParam());
  const DistortionControl control = cell.control(GetParam());
  for (const double share : {0.6 * limit, 0.03 * limit, -0.5 * limit}) {
    const std::vector<double> u = flattened(cell, GetParam(), share, 0.004);
    std::vector<double> f(u.size(), 0.0);
    ASSERT_GT(control.add_force(0, u, f), 0.0);
    const std::size_t n = 3 * cell.nodes.size();
    std::vector<double> K(n * n, 0.0);
    ASSERT_TRUE(control.add_stiffness(0, u, K));
    for (std::size_t s = 0; s < n; ++s) {
      const std::size_t j = 3 * at(cell.nodes[s / 3]) + s % 3;
      const auto moved = [&](double h) {
        std::vector<double> v = u;
        v[j] += h;
        return v;
      };
      if (dimension(GetParam()) == 2 && s % 3 == 2) continue;
      const double size = largest(f);
      EXPECT_NEAR(slope([&](double h) { return energy(control, moved(h)); }, 1e-4), f[j], 1e-9 * size);
      std::vector<double> unit(u.size(), 0.0), action(u.size(), 0.0);
      unit[j] = 1.0;
      control.add_tangent_action(0, u, unit, action);
      for (std::size_t r = 0; r < n; ++r) {
        const std::size_t i = 3 * at(cell.nodes[r / 3]) + r % 3;
        const auto force = [&](double h) {
          std::vector<double> g(u.size(), 0.0);
          control.add_force(0, moved(h), g);
          return g[i];
        };
        EXPECT_NEAR(slope(force, 1e-4), action[i], 1e-8 * largest(K));
        EXPECT_NEAR(K[n * r + s], action[i], 1e-14 * largest(K));
        EXPECT_NEAR(K[n * r + s], K[n * s + r], 1e-13 * largest(K));
      }
    }
  }
}

TEST_P(DistortionOf, RigidMotionsChangeNothingAndForcesBalance) {
  const Cell cell(GetParam());
  const DistortionControl control = cell.control(GetParam());
  const std::vector<double> u = flattened(cell, GetParam(), 0.3 * limit, 0.01);
  const double c = std::cos(0.7), s = std::sin(0.7);
  std::vector<double> turned(u.size()), f(u.size(), 0.0), g(u.size(), 0.0);
  for (std::size_t n = 0; n < u.size() / 3; ++n) {
    const Vec3 X = cell.mesh->coordinates[n], x = add(X, vector_at(u, n));
    const Vec3 y{c * x[0] - s * x[1] + 3.0, s * x[0] + c * x[1] - 2.0, x[2]};
    for (std::size_t i = 0; i < 3; ++i) turned[3 * n + i] = y[i] - X[i];
  }
  const double W = control.add_force(0, u, f);
  EXPECT_NEAR(control.add_force(0, turned, g), W, 1e-12 * W);
  Vec3 force{}, moment{};
  for (std::size_t n = 0; n < u.size() / 3; ++n) {
    const Vec3 p = vector_at(f, n), q = vector_at(g, n);
    force = add(force, p);
    moment = add(moment, cross(add(cell.mesh->coordinates[n], vector_at(u, n)), p));
    EXPECT_LT(norm(subtract(q, {c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]})), 1e-11 * largest(f));
  }
  EXPECT_LT(norm(force), 1e-14 * largest(f));
  EXPECT_LT(norm(moment), 1e-14 * largest(f));
}

// All corners of a cell that is crushed alike to a share J have it: W = V M w(J). Above the limit nothing acts at all.
TEST_P(DistortionOf, ActsBelowTheLimitAlone) {
  const Cell cell(GetParam());
  const DistortionControl control = cell.control(GetParam());
  const auto crushed = [&](double J) {
    return affine(*cell.mesh, {{{0.0, 0.0, 0.0}, {0.0, J - 1.0, 0.0}, {0.0, 0.0, 0.0}}});
  };
  EXPECT_NEAR(energy(control, crushed(0.5 * limit)), cell.volume * modulus * limit * (std::log(2.0) - 0.5), 1e-14);
  std::vector<double> f(cell.dofs(), 0.0), K(9 * cell.nodes.size() * cell.nodes.size(), 0.0);
  EXPECT_EQ(control.add_force(0, crushed(1.001 * limit), f), 0.0);
  EXPECT_FALSE(control.add_stiffness(0, crushed(1.001 * limit), K));
  EXPECT_EQ(largest(f), 0.0);
  EXPECT_EQ(largest(K), 0.0);
}

TEST_P(DistortionOf, TheBoundOfItsFrequencyHolds) {
  const Cell cell(GetParam());
  const DistortionControl control = cell.control(GetParam());
  const std::size_t n = cell.nodes.size();
  std::vector<double> mass = random_vector(n, 8);
  for (double& m : mass) m = 1.5 + m;
  for (const double share : {0.999 * limit, 0.3 * limit, 0.01 * limit}) {
    const std::vector<double> u = flattened(cell, GetParam(), share, 0.0);
    std::vector<double> K(9 * n * n, 0.0);
    control.add_stiffness(0, u, K);
    std::vector<std::vector<double>> A(3 * n, std::vector<double>(3 * n));
    for (std::size_t r = 0; r < 3 * n; ++r)
      for (std::size_t s = 0; s < 3 * n; ++s) A[r][s] = K[3 * n * r + s] / std::sqrt(mass[r / 3] * mass[s / 3]);
    const double largest_of_all = eigenvalues(A).back(), bound = control.frequency_bound(0, u, mass);
    EXPECT_GE(bound, largest_of_all * (1.0 - 1e-12));
    EXPECT_LT(bound, 4.0 * largest_of_all) << "far too careful";
  }
}

INSTANTIATE_TEST_SUITE_P(AllCells, DistortionOf,
                         testing::Values(CellType::hexa8, CellType::tetra4, CellType::penta6, CellType::pyra5,
                                         CellType::quad4, CellType::tria3, CellType::hexa20, CellType::tetra10,
                                         CellType::quad8, CellType::penta15, CellType::pyra13),
                         [](const auto& of) { return std::string(name(of.param)); });

/// A block of 3 x 3 x 3 cells, with an inner node pushed through the corner of a cell.
struct Body {
  Model model;
  std::vector<double> u;
};
Body folding(double limit_of_part) {
  Body body{one_part(block_mesh({3, 3, 3}, 0.1), NeoHookean{unit_material}), {}};
  body.model.parts[0].distortion_control = limit_of_part;
  body.u = random_vector(3 * body.model.mesh->node_count(), 3);
  for (double& entry : body.u) entry *= 0.05;
  const auto& X = body.model.mesh->coordinates;
  for (std::size_t n = 0; n < X.size(); ++n)
    if (norm(subtract(X[n], {1.0, 1.0, 1.0})) < 0.3)
      for (std::size_t i = 0; i < 3; ++i) body.u[3 * n + i] += 0.55;
  return body;
}

// What distortion control adds to the bodies: the same in force, energy, action, matrix, diagonal and section force.
TEST(Distortion, IsPartOfAllSumsOfTheSolid) {
  const Body with = folding(0.4), without = folding(0.0);
  const Solid controlled(with.model), free(without.model);
  const std::vector<double>& u = with.u;
  std::vector<double> f(u.size()), f_free(u.size()), f_of(u.size(), 0.0), action(u.size()),
      x = random_vector(u.size(), 7);
  const SolidEnergies energies = controlled.evaluate(u, {}, f, {}), plain = free.evaluate(u, {}, f_free, {});
  EXPECT_GT(energies.distortion, 1e-3);
  EXPECT_EQ(plain.distortion, 0.0);
  EXPECT_EQ(energies.strain, plain.strain);
  EXPECT_GT(largest_difference(f, f_free), 0.1);
  EXPECT_EQ(internal_force(controlled, u), f);
  std::vector<Index> all(controlled.cells().size());
  std::iota(all.begin(), all.end(), Index{0});
  controlled.add_internal_force_of(all, u, f_of);
  EXPECT_LT(largest_difference(f_of, f), 1e-12);
  const auto along = [&](double h) {
    std::vector<double> moved = u;
    for (std::size_t i = 0; i < u.size(); ++i) moved[i] += h * x[i];
    return moved;
  };
  const auto W = [&](double h) {
    std::vector<double> g(u.size());
    const SolidEnergies of = controlled.evaluate(along(h), {}, g, {});
    return of.strain + of.hourglass + of.distortion;
  };
  double power = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) power += f[i] * x[i];
  EXPECT_NEAR(slope(W, 1e-4), power, 1e-9 * std::abs(power));
  controlled.tangent_action(u, x, action);
  const auto K = dense(controlled.tangent(u));
  const std::vector<double> diagonal = controlled.tangent_diagonal(u);
  const double size = largest(diagonal);
  for (std::size_t i = 0; i < u.size(); ++i) {
    double product = 0.0;
    for (std::size_t j = 0; j < u.size(); ++j) product += K[i][j] * x[j];
    EXPECT_NEAR(product, action[i], 1e-12 * size);
    EXPECT_NEAR(slope([&](double h) { return internal_force(controlled, along(h))[i]; }, 1e-4), action[i], 1e-8 * size);
    EXPECT_NEAR(diagonal[i], K[i][i], 1e-12 * size);
  }
}

TEST(Distortion, SameBitsForAnyNumberOfThreads) {
  Model model = one_part(block_mesh({16, 16, 16}, 0.2), NeoHookean{unit_material});  // 4096 cells: 8 chunks
  model.parts[0].distortion_control = 0.9;
  const Solid solid(model);
  std::vector<double> u = random_vector(solid.dof_count(), 5), f(u.size()), g(u.size());
  for (double& entry : u) entry *= 0.1;
  set_threads(1);
  const double energy = solid.evaluate(u, {}, f, {}).distortion;
  EXPECT_GT(energy, 0.0);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    EXPECT_EQ(solid.evaluate(u, {}, g, {}).distortion, energy) << threads;
    EXPECT_EQ(g, f) << threads;
  }
  set_threads(0);
}

TEST(Distortion, ShortensTheStableStepWhereItActsAndIsNotThereElsewhere) {
  const Body with = folding(0.4), without = folding(0.0);
  const Solid controlled(with.model), free(without.model);
  std::vector<double> growth(free.cells().size()), plain(free.cells().size());
  frequency_growth(controlled, with.u, {}, growth);
  frequency_growth(free, with.u, {}, plain);
  double most = 0.0;
  for (std::size_t k = 0; k < growth.size(); ++k) {
    EXPECT_GE(growth[k], plain[k]);
    most = std::max(most, growth[k] - plain[k]);
  }
  EXPECT_GT(most, 1.0);
  std::vector<double> half = with.u;
  for (double& entry : half) entry *= 0.3;  // no corner is below the limit
  EXPECT_EQ(internal_force(controlled, half), internal_force(free, half));
  frequency_growth(controlled, half, {}, growth);
  frequency_growth(free, half, {}, plain);
  EXPECT_EQ(growth, plain);
}

}  // namespace
}  // namespace carom::test::solid_distortion_test
