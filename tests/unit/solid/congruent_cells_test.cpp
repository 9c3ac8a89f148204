// Cells of the same shape, and bounds that they share.
#include "solid/congruent_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solid/stability.hpp"
#include "solid_bodies.hpp"
#include "solid_fixture.hpp"

namespace carom::test::solid_congruent_cells_test {
namespace {

CongruentCells shapes_of(const Model& model) {
  const SolidCells solid = make_solid_cells(model, kernels_reference());
  return congruent_cells(solid, solid.blocks[0], 0, solid.blocks[0].cells);
}

Model moved(Mesh mesh, double distance) {
  for (Vec3& x : mesh.coordinates)
    for (double& component : x) component = component / 3.0 + distance;
  return one_part(std::move(mesh));
}

// Coordinates that are no binary fractions, far from the origin: the places of the nodes agree to rounding only.
TEST(CongruentCells, OfARegularGridAreFew) {
  const CongruentCells shapes = shapes_of(moved(block_mesh({6, 5, 4}, 0.0), 1000.0));
  EXPECT_EQ(shapes.of.size(), 120U);
  EXPECT_LE(shapes.first.size(), 8U);
  for (std::size_t s = 0; s < shapes.first.size(); ++s) EXPECT_EQ(shapes.of[shapes.first[s]], s);
}

TEST(CongruentCells, OfADistortedGridAreAllDifferent) {
  const CongruentCells shapes = shapes_of(one_part(block_mesh({6, 5, 4}, 0.2)));
  EXPECT_EQ(shapes.first.size(), 120U);
}

TEST(CongruentCells, OneLongerCellIsNotOfTheShapeOfTheOthers) {
  Mesh mesh = block_mesh({3, 1, 1}, 0.0);
  for (Vec3& x : mesh.coordinates)
    if (x[0] > 2.5) x[0] += 1e-6;
  EXPECT_EQ(shapes_of(one_part(std::move(mesh))).first.size(), 2U);
}

// The radius of a ring counts, so that none is like another.
TEST(CongruentCells, RingsAreNotShared) {
  const Model model = body(quad_mesh(4, 4, 0.0), Section::axisymmetric, unit_material);
  EXPECT_EQ(shapes_of(model).first.size(), 16U);
}

TEST(CongruentCells, ShareTheBoundThatEachWouldHaveAlone) {
  Mesh mesh = block_mesh({4, 3, 3}, 0.0);
  for (Vec3& x : mesh.coordinates) x[0] += 0.1 * x[0] * x[0];  // four sizes of cells
  const Model model = one_part(mesh);
  const std::vector<double> bounds = cell_frequency_bounds(Solid(model));
  for (std::size_t c = 0; c < bounds.size(); c += 5) {
    Model alone = model;
    alone.parts[0].cells = {model.parts[0].cells[c]};
    EXPECT_NEAR(bounds[c], cell_frequency_bounds(Solid(alone))[0], 1e-9 * bounds[c]) << c;
  }
}

// The powers of the matrices are taken in every instruction set; of distorted cells, seven of which fill no batch.
TEST(FrequencyBounds, OfEveryInstructionSetAreThoseOfTheReference) {
  const Model model = one_part(block_mesh({7, 1, 1}, 0.2));
  const std::vector<double> expected = cell_frequency_bounds(Solid(model, Isa::reference));
  for (const Isa isa : {Isa::x86_64_v2, Isa::x86_64_v3, Isa::x86_64_v4}) {
    if (!supported(isa)) continue;
    const std::vector<double> bounds = cell_frequency_bounds(Solid(model, isa));
    for (std::size_t c = 0; c < bounds.size(); ++c)
      EXPECT_NEAR(bounds[c], expected[c], 1e-12 * expected[c]) << name(isa) << ' ' << c;
  }
}

// A matrix of known powers: 2 on the diagonal and -1 beside it has the eigenvalues 2 - 2 cos(k pi / 7) below 3.802.
TEST(FrequencyBounds, AreLittleAboveTheLargestEigenvalue) {
  constexpr int n = 6;
  double A[n * n] = {}, work[n * n], bound = 0.0;
  for (int r = 0; r < n; ++r)
    for (int s = 0; s < n; ++s) A[n * r + s] = r == s ? 2.0 : std::abs(r - s) == 1 ? -1.0 : 0.0;
  kernels_reference().power_bound(n, A, work, &bound);
  const double exact = 2.0 - 2.0 * std::cos(6.0 * std::numbers::pi / 7.0);
  EXPECT_GE(bound, exact);
  EXPECT_LE(bound, std::pow(n, 1.0 / 16.0) * exact);
}

}  // namespace
}  // namespace carom::test::solid_congruent_cells_test
