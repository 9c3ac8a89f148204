// TETRA4 and TRIA3 integrated at their nodes: the energy from its definition, cell by cell, and what holds the modes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/errors.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "solid/node_patches.hpp"
#include "solid/point_history.hpp"
#include "solid/stability.hpp"
#include "solid_bodies.hpp"

namespace carom::test::solid_nodal_test {
namespace {

struct Kind {
  CellType type;
  Section section;
};
constexpr Kind kinds[] = {{CellType::tetra4, Section::solid},
                          {CellType::tria3, Section::plane_strain},
                          {CellType::tria3, Section::plane_stress},
                          {CellType::tria3, Section::axisymmetric}};

const Element& nodal(const Kind& kind) {
  return *find_element(kind.type, kind.section, Formulation::nodal);
}

using Tensor = std::array<std::array<double, 3>, 3>;

Tensor product(const Tensor& a, const Tensor& b) {
  Tensor c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
  return c;
}

/// The inverse, by cofactors; and the determinant.
Tensor inverse(const Tensor& a, double& det) {
  Tensor c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t p = (j + 1) % 3, q = (j + 2) % 3, r = (i + 1) % 3, s = (i + 2) % 3;
      c[i][j] = a[p][r] * a[q][s] - a[p][s] * a[q][r];
    }
  det = a[0][0] * c[0][0] + a[0][1] * c[1][0] + a[0][2] * c[2][0];
  for (auto& row : c)
    for (double& entry : row) entry /= det;
  return c;
}

/// F of a tetrahedron and its volume.
Tensor gradient(const Mesh& mesh, std::span<const Index> nodes, const std::vector<double>& u, double& volume) {
  Tensor before{}, after{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(nodes[k + 1]), o = static_cast<std::size_t>(nodes[0]);
      before[i][k] = mesh.coordinates[a][i] - mesh.coordinates[o][i];
      after[i][k] = before[i][k] + u[3 * a + i] - u[3 * o + i];
    }
  const Tensor F = product(after, inverse(before, volume));
  volume /= 6.0;
  return F;
}

// W = sum over the nodes of V (W(F) + 0.25 G sum_e f_e |sym ((F_e - F) F^-1)|^2), F and V from the quarters of the
// cells about the node, W the energy of St. Venant and Kirchhoff. Node after node, tensor by tensor.
TEST(Nodal, EnergyIsThatOfItsDefinition) {
  const Material law("st_venant_kirchhoff", 1.0, {{"E", 3.0}, {"nu", 0.2}});
  const IsotropicElastic at_rest = law.at_rest();
  const double G = at_rest.E / (2.0 * (1.0 + at_rest.nu)), lambda = at_rest.p_wave_modulus() - 2.0 * G;
  const Solid solid(body(distorted_mesh(CellType::tetra4), nodal(kinds[0]), law));
  const Mesh mesh = distorted_mesh(CellType::tetra4);
  std::vector<double> u = random_vector(solid.dof_count(), 3), f(u.size());
  for (double& component : u) component *= 0.1;
  double strain = 0.0, hourglass = 0.0;
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    double V = 0.0;
    Tensor mean{};
    std::vector<std::pair<double, Tensor>> cells;
    for (std::size_t k = 0; k < solid.cells().size(); ++k) {
      const auto nodes = solid.cells().nodes_of(k);
      if (std::find(nodes.begin(), nodes.end(), static_cast<Index>(n)) == nodes.end()) continue;
      double volume = 0.0;
      const Tensor F = gradient(mesh, nodes, u, volume);
      cells.emplace_back(volume / 4.0, F);
      V += volume / 4.0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) mean[i][j] += volume / 4.0 * F[i][j];
    }
    for (auto& row : mean)
      for (double& entry : row) entry /= V;
    double det = 0.0, square = 0.0, trace = 0.0;
    const Tensor back = inverse(mean, det);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        double E = i == j ? -0.5 : 0.0;
        for (std::size_t k = 0; k < 3; ++k) E += 0.5 * mean[k][i] * mean[k][j];
        square += E * E;
        trace += i == j ? E : 0.0;
      }
    strain += V * (0.5 * lambda * trace * trace + G * square);
    for (const auto& [volume, F] : cells) {
      const Tensor Y = product(F, back);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          const double e = 0.5 * (Y[i][j] + Y[j][i]) - (i == j ? 1.0 : 0.0);
          hourglass += 0.25 * G * volume * e * e;
        }
    }
  }
  const SolidEnergies energies = solid.evaluate(u, {}, f, {});
  EXPECT_NEAR(energies.strain, strain, 1e-12 * strain);
  EXPECT_NEAR(energies.hourglass, hourglass, 1e-12 * hourglass);
}

// Section forces and the equilibrium of nodes without mass ask for the forces of some cells: they act on the nodes of
// these cells alone, and those of all cells are the body's, after flow too.
TEST(Nodal, ForcesOfSomeCellsActOnTheirNodesAndAddUp) {
  for (const Kind& kind : kinds) {
    for (const char* law : {"j2", "j2_small_strain"}) {
      const Solid solid(body(distorted_mesh(kind.type), nodal(kind), yielding(law)));
      std::vector<double> u = random_vector(solid.dof_count(), 3), f(u.size()), history(history_size(solid));
      for (std::size_t d = 0; d < u.size(); ++d) u[d] *= d % 3 < components(kind.section) ? 0.1 : 0.0;
      solid.evaluate(u, {}, f, history);
      for (double& component : u) component *= 1.2;
      const PointStep step{0.0, history};
      solid.internal_force(u, f, step);
      std::vector<double> sum(f.size(), 0.0);
      for (std::size_t part = 0; part < 2; ++part) {
        std::vector<Index> cells;
        std::vector<char> has(solid.node_count(), 0);
        for (std::size_t k = 0; k < solid.cells().size(); ++k) {
          if (k % 2 != part) continue;
          cells.push_back(static_cast<Index>(k));
          for (const Index n : solid.cells().nodes_of(k)) has[static_cast<std::size_t>(n)] = 1;
        }
        std::vector<double> own(f.size(), 0.0);
        solid.add_internal_force_of(cells, u, own, step);
        for (std::size_t d = 0; d < own.size(); ++d) {
          sum[d] += own[d];
          if (has[d / 3] == 0) {
            EXPECT_EQ(own[d], 0.0);
          }
        }
      }
      EXPECT_LT(largest_difference(sum, f), 1e-12 * largest(f)) << static_cast<int>(kind.section) << " " << law;
      const std::vector<Index> one{0};
      std::vector<double> own(f.size(), 0.0);
      solid.add_internal_force_of(one, u, own, step);
      const auto nodes = solid.cells().nodes_of(0);
      for (std::size_t d = 0; d < own.size(); ++d)
        if (std::find(nodes.begin(), nodes.end(), static_cast<Index>(d / 3)) == nodes.end()) {
          EXPECT_NEAR(own[d], 0.0, 1e-13 * largest(f));
        }
    }
  }
}

// Rigid motions and nothing else cost no energy: six in space, three in the plane, one along the axis of a ring.
TEST(Nodal, OnlyRigidMotionsAreFree) {
  for (const Kind& kind : kinds) {
    const Solid solid(body(distorted_mesh(kind.type), nodal(kind), unit_material));
    const CsrMatrix K = solid.tangent(std::vector<double>(solid.dof_count(), 0.0));
    const std::size_t c = components(kind.section), n = c * solid.node_count();
    std::vector<double> dense(n * n, 0.0);
    for (std::size_t r = 0; r < solid.dof_count(); ++r)
      for (auto k = static_cast<std::size_t>(K.row_begin[r]); k < static_cast<std::size_t>(K.row_begin[r + 1]); ++k) {
        const auto s = static_cast<std::size_t>(K.column[k]);
        if (r % 3 < c && s % 3 < c) dense[(r / 3 * c + r % 3) * n + s / 3 * c + s % 3] = K.value[k];
      }
    const std::vector<double> values = symmetric_eigen(dense, static_cast<int>(n)).values;
    const auto free = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [&](double v) { return v < 1e-12 * values.back(); }));
    EXPECT_EQ(free, kind.section == Section::solid ? 6U : kind.section == Section::axisymmetric ? 1U : 3U);
    // No mode is held by rounding alone, which leaves some 1e-16.
    EXPECT_GT(values[free], 1e-3 * values.back());
  }
}

// Nodes on the axis have patches that are filled up as all others are; those of a free mesh stand in no order.
TEST(Nodal, RingsWithNodesOnTheAxisHaveForces) {
  const Mesh mesh =
      mesh_of(CellType::tria3, {{0, 0, 0}, {0, 2, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {0.6, 1, 0}, {1, 1, 0}},
              {0, 3, 5, 0, 5, 2, 2, 5, 1, 5, 4, 1, 3, 6, 5, 5, 6, 4});
  const Solid solid(body(mesh, nodal(kinds[3]), unit_material));
  std::vector<double> u(solid.dof_count()), f(u.size());
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    u[3 * n] = 0.01 * mesh.coordinates[n][0];
    u[3 * n + 1] = 0.02 * mesh.coordinates[n][1];
  }
  const SolidEnergies energies = solid.evaluate(u, {}, f, {});
  const double volume = 2.0 * std::numbers::pi, lambda = unit_material.lame_lambda();
  EXPECT_NEAR(energies.strain, volume * (0.5 * lambda * 0.04 * 0.04 + unit_material.shear_modulus() * 6e-4),
              1e-12 * energies.strain);
  EXPECT_NEAR(energies.hourglass, 0.0, 1e-15 * energies.strain);
}

// A fan of more cells than a patch holds is refused with the node.
TEST(Nodal, NodesWithTooManyNeighboursAreNamed) {
  std::vector<Vec3> x{{0.0, 0.0, 0.0}};
  std::vector<Index> triangles;
  constexpr Index rim = 100;
  for (Index k = 0; k < rim; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / rim;
    x.push_back({std::cos(angle), std::sin(angle), 0.0});
    triangles.insert(triangles.end(), {0, k + 1, (k + 1) % rim + 1});
  }
  const Mesh fan = mesh_of(CellType::tria3, x, triangles);
  const std::vector<Index> all = [] {
    std::vector<Index> cells(rim);
    std::iota(cells.begin(), cells.end(), Index{0});
    return cells;
  }();
  EXPECT_EQ(largest_valence(fan, CellType::tria3, all).neighbours, static_cast<std::size_t>(rim));
  try {
    const Solid solid(body(fan, nodal(kinds[1]), unit_material));
    FAIL() << "a fan of 100 cells was taken";
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("node 1 with 100 neighbours"), std::string::npos) << error.what();
  }
}

// A turn changes no frequency, and of an isotropic body a shear changes them by as much in every plane of the axes: the
// shortest stretch of gamma = 1/2 is that of C = (1 + gamma^2, gamma; gamma, 1).
TEST(Nodal, FrequenciesGrowByTheShortestStretchInWhateverDirection) {
  const Material law("neo_hookean", 1.0, {{"E", 3.0}, {"nu", 0.2}});
  const Model model = body(distorted_mesh(CellType::tetra4), nodal(kinds[0]), law);
  const Solid solid(model);
  const auto largest_growth = [&](const Tensor& H) {
    std::vector<double> growth(solid.cells().size());
    const std::vector<double> history = initial_history(solid);
    frequency_growth(solid, affine(*model.mesh, {Vec3{H[0]}, Vec3{H[1]}, Vec3{H[2]}}), {.dt = 1.0, .history = history},
                     growth);
    return *std::max_element(growth.begin(), growth.end());
  };
  const double c = std::cos(0.7), s = std::sin(0.7);
  std::vector<double> of_shear;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    Tensor turn{}, shear{};
    turn[i][i] = turn[j][j] = c - 1.0;
    turn[i][j] = -s;
    turn[j][i] = s;
    EXPECT_NEAR(largest_growth(turn), 1.0, 1e-12) << i;
    shear[i][j] = 0.5;
    of_shear.push_back(largest_growth(shear));
  }
  EXPECT_GT(of_shear[0], 1.3);
  EXPECT_NEAR(of_shear[1], of_shear[0], 1e-12);
  EXPECT_NEAR(of_shear[2], of_shear[0], 1e-12);
}

}  // namespace
}  // namespace carom::test::solid_nodal_test
