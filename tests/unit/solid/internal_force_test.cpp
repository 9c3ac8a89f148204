// Internal force, energy and stress of the HEXA8 solid.
#include <gtest/gtest.h>

#include <numeric>

#include "element/hexa8.hpp"
#include "parallel/threads.hpp"
#include "solid/cell_values.hpp"
#include "solid_fixture.hpp"

namespace carom::test::solid_internal_force_test {
namespace {

// About 300 additions and products of numbers below 10 stand behind one nodal force: 300 x 10 x 2^-53 = 4e-13, and the
// largest force is above 1.
constexpr double round_off = 1e-12;

class EveryIsa : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Solid, EveryIsa, testing::ValuesIn(available_isas()),
                         [](const auto& instance) { return std::string(name(instance.param)); });

TEST_P(EveryIsa, KernelsEqualTheReferenceToRoundOff) {
  const Model model = one_part(block_mesh({3, 3, 3}, 0.2));  // 27 cells: the last batch is not full
  const Solid solid(model, GetParam()), reference(model, Isa::reference);
  const auto u = random_vector(solid.dof_count(), 2);
  const auto expected = internal_force(reference, u);
  ASSERT_GT(largest(expected), 1.0);
  EXPECT_LT(largest_difference(internal_force(solid, u), expected), round_off);
  EXPECT_NEAR(strain_energy(solid, u), strain_energy(reference, u), round_off * strain_energy(reference, u));
  const auto stress = cell_stress(solid, u), expected_stress = cell_stress(reference, u);
  for (std::size_t c = 0; c < stress.size(); ++c)
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(stress[c][i], expected_stress[c][i], round_off);
}

// The reference kernel itself against the textbook formula, written here without sum factorisation.
TEST(Solid, ReferenceEqualsDirectQuadrature) {
  const Model model = fully_integrated(one_part(block_mesh({2, 2, 2}, 0.2)));
  const Mesh& mesh = *model.mesh;
  const Solid solid(model, Isa::reference);
  const auto u = random_vector(solid.dof_count(), 3);
  std::vector<double> expected(u.size(), 0.0);
  const auto& connectivity = mesh.block(CellType::hexa8)->connectivity;
  for (std::size_t cell = 0; cell < 8; ++cell) {
    std::array<Vec3, 8> x{};
    for (std::size_t a = 0; a < 8; ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(connectivity[8 * cell + a])];
    for (const auto& point : hexa8::gauss_2()) {
      const auto g = hexa8::physical_gradient(x, point.xi);
      double H[3][3] = {};
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            H[i][j] += u[3 * static_cast<std::size_t>(connectivity[8 * cell + a]) + i] * g.dN_dX[a][j];
      const double trace = H[0][0] + H[1][1] + H[2][2];
      for (std::size_t a = 0; a < 8; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) {
            const double sigma = unit_material.shear_modulus() * (H[i][j] + H[j][i]) +
                                 (i == j ? unit_material.lame_lambda() * trace : 0.0);
            expected[3 * static_cast<std::size_t>(connectivity[8 * cell + a]) + i] +=
                sigma * g.dN_dX[a][j] * g.det_J * point.weight;
          }
    }
  }
  EXPECT_LT(largest_difference(internal_force(solid, u), expected), round_off);
}

TEST_P(EveryIsa, PatchTestOnADistortedMesh) {
  const Model model = one_part(block_mesh({4, 4, 4}, 0.2));
  const Mesh& mesh = *model.mesh;
  const Solid solid(model, GetParam());
  const std::array<Vec3, 3> H{{{0.1, 0.02, -0.03}, {0.04, -0.2, 0.05}, {0.01, 0.03, 0.15}}};
  const auto u = affine(mesh, H, {0.3, -0.1, 0.2});
  const double lambda = unit_material.lame_lambda(), G = unit_material.shear_modulus(), trace = 0.1 - 0.2 + 0.15;
  const std::array<double, 6> hooke{lambda * trace + 2 * G * 0.1,
                                    lambda * trace - 2 * G * 0.2,
                                    lambda * trace + 2 * G * 0.15,
                                    G * (0.02 + 0.04),
                                    G * (0.05 + 0.03),
                                    G * (0.01 - 0.03)};
  for (const auto& stress : cell_stress(solid, u))
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], hooke[c], round_off);
  const auto f = internal_force(solid, u);
  for (std::size_t n = 0; n < mesh.node_count(); ++n) {
    const Vec3& x = mesh.coordinates[n];
    const bool inside = std::min({x[0], x[1], x[2]}) > 0.5 && std::max({x[0], x[1], x[2]}) < 3.5;
    for (std::size_t i = 0; inside && i < 3; ++i) EXPECT_NEAR(f[3 * n + i], 0.0, round_off);
  }
  double energy_density = 0.0;
  for (std::size_t i = 0; i < 3; ++i) energy_density += 0.5 * hooke[i] * H[i][i];
  energy_density += 0.5 * (hooke[3] * 0.06 + hooke[4] * 0.08 + hooke[5] * -0.02);
  EXPECT_NEAR(strain_energy(solid, u), 64.0 * energy_density, 64.0 * round_off);
}

TEST_P(EveryIsa, RigidMotionsGiveNoForce) {
  const Model model = one_part(block_mesh({3, 3, 3}, 0.2));
  const Solid solid(model, GetParam());
  const auto translation = affine(*model.mesh, {}, {1.0, -2.0, 3.0});
  const auto rotation = affine(*model.mesh, {{{0.0, -0.3, 0.2}, {0.3, 0.0, -0.1}, {-0.2, 0.1, 0.0}}});
  EXPECT_LT(largest(internal_force(solid, translation)), round_off);
  EXPECT_LT(largest(internal_force(solid, rotation)), round_off);
}

TEST_P(EveryIsa, ForcesBalanceAndEnergyIsHalfTheirWork) {
  const Model model = fully_integrated(one_part(block_mesh({3, 3, 3}, 0.2)));
  const Solid solid(model, GetParam());
  const auto u = random_vector(solid.dof_count(), 4);
  const auto f = internal_force(solid, u);
  Vec3 force{}, moment{};
  for (std::size_t n = 0; n < solid.node_count(); ++n) {
    const Vec3& x = model.mesh->coordinates[n];
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      force[i] += f[3 * n + i];
      moment[i] += x[j] * f[3 * n + k] - x[k] * f[3 * n + j];
    }
  }
  double work = 0.0;
  for (std::size_t d = 0; d < u.size(); ++d) work += 0.5 * u[d] * f[d];
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(force[i], 0.0, 64 * round_off);  // 64 nodes add up
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(moment[i], 0.0, 64 * 3 * round_off);
  EXPECT_NEAR(strain_energy(solid, u), work, 64 * round_off);
}

TEST_P(EveryIsa, SameBitsForAnyNumberOfThreads) {
  const Model model = one_part(block_mesh({16, 16, 16}, 0.2));  // 4096 cells: 8 chunks
  const Solid solid(model, GetParam());
  const auto u = random_vector(solid.dof_count(), 5);
  set_threads(1);
  const auto force = internal_force(solid, u);
  const double energy = strain_energy(solid, u);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    EXPECT_EQ(internal_force(solid, u), force) << threads;
    EXPECT_EQ(strain_energy(solid, u), energy) << threads;
  }
  set_threads(0);
}

TEST_P(EveryIsa, ForceOfSomeCellsIsTheirShare) {
  const Model model = one_part(block_mesh({3, 3, 3}, 0.2));
  const Solid solid(model, GetParam());
  const auto u = random_vector(solid.dof_count(), 6);
  std::vector<Index> some{0, 5, 26}, others;
  for (Index c = 0; c < 27; ++c)
    if (std::find(some.begin(), some.end(), c) == some.end()) others.push_back(c);
  std::vector<double> f(u.size(), 0.0);
  solid.add_internal_force_of(some, u, f);
  EXPECT_GT(largest_difference(f, internal_force(solid, u)), 0.1) << "three cells are not the whole body";
  solid.add_internal_force_of(others, u, f);
  EXPECT_LT(largest_difference(f, internal_force(solid, u)), round_off);
}

/// Every hexahedron of the mesh as six tetrahedra around its diagonal.
Model nodal_tetrahedra(const Mesh& hexahedra) {
  constexpr std::size_t corner[]{1, 2, 3, 7, 4, 5, 1};
  Mesh mesh = hexahedra;
  CellBlock block{CellType::tetra4, {}, {}};
  for (Index c = 0; c < static_cast<Index>(hexahedra.blocks[0].size()); ++c) {
    const std::span<const Index> n = hexahedra.blocks[0].nodes(c);
    for (std::size_t k = 0; k < 6; ++k) {
      block.connectivity.insert(block.connectivity.end(), {n[0], n[corner[k]], n[corner[k + 1]], n[6]});
      block.file_numbers.push_back(static_cast<std::int64_t>(block.file_numbers.size()));
    }
  }
  mesh.blocks = {block};
  Model model;
  Part part{.name = "body", .cells = std::vector<Index>(block.size()), .material = unit_material};
  std::iota(part.cells.begin(), part.cells.end(), 0);
  part.type = CellType::tetra4;
  part.formulation = Formulation::nodal;
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts.push_back(std::move(part));
  return model;
}

// Many chunks of 512 cells, of nodal cells many of their patches: those without a wanted cell are left out.
TEST(CellStress, OfSomeCellsIsThatOfAll) {
  const auto expect_same = [](const Model& model, const std::vector<Index>& wanted, std::size_t left_out) {
    const Solid solid(model);
    const std::vector<double> u = random_vector(solid.dof_count(), 5);
    const auto all = cell_stress(solid, u), some = cell_stress(solid, u, {}, wanted);
    for (const Index k : wanted) EXPECT_EQ(some[at(k)], all[at(k)]) << k;
    EXPECT_EQ(some[left_out], (std::array<double, 6>{})) << "a chunk that nobody asks for";
    EXPECT_NE(all[left_out], some[left_out]);
  };
  expect_same(one_part(block_mesh({16, 16, 24}, 0.2)), {3, 511, 2000, 6143}, 1000);
  expect_same(nodal_tetrahedra(block_mesh({12, 12, 12}, 0.2)), {3, 10000}, 5000);
}

}  // namespace
}  // namespace carom::test::solid_internal_force_test
