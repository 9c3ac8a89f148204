// The kernels of every lane count on batches laid out by hand, and the colouring of chunks.
#include "kernels/kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kernels/batch_gradients.hpp"
#include "kernels/cell_stages.hpp"
#include "kernels/hexa8_small.hpp"
#include "material/linear_elastic_update.hpp"
#include "solid/blocks.hpp"
#include "solid/colouring.hpp"
#include "solid_bodies.hpp"
#include "solid_fixture.hpp"

namespace carom::test::solid_kernels_test {
namespace {

struct Answer {
  std::vector<double> force, stress;
  double energy = 0.0;
};

Answer run(const KernelTable& kernel, const Model& model, const std::vector<double>& u) {
  const SolidCells solid = make_solid_cells(model, kernel);
  const Block& block = solid.blocks[0];
  const CellBatches batches = solid.batches(block, 0, block.cells);
  const BatchLaw law = block.law();
  Answer answer{std::vector<double>(u.size(), 0.0), std::vector<double>(6 * static_cast<std::size_t>(block.cells)),
                0.0};
  SolidEnergies energies;
  block.kernels.add_internal_force(batches, law, u.data(), answer.force.data(), &energies);
  block.kernels.mean_stress(batches, law, u.data(), answer.stress.data());
  answer.energy = energies.strain;
  return answer;
}

/// The fused kernels of HEXA8 over packs, for the linear elastic law.
template <class Real>
KernelTable fused_kernels() {
  KernelTable kernels = kernels_reference();
  kernels.lanes = lanes<Real>;
  kernels.hexa8_small = hexa8_small::kernels<Real>();
  kernels.cells[static_cast<std::size_t>(CellKind::Hexa8)] = cell_stages<Real, Hexa8Cell>();
  kernels.laws.laws[static_cast<std::size_t>(LawPlace::linear_elastic)] = linear_elastic_kernels<Real>();
  return kernels;
}

// Packs of 2, 4 and 8 lanes, lowered to whatever this test is compiled for, so that the 8-lane source is exercised on
// processors without AVX-512 too. 27 cells leave 1, 3 and 3 lanes of the last batch in use.
TEST(SolidKernels, EveryLaneCountEqualsTheReference) {
  const Model model = fully_integrated(one_part(block_mesh({3, 3, 3}, 0.2)));
  const auto u = random_vector(3 * model.mesh->node_count(), 1);
  const Answer expected = run(kernels_reference(), model, u);
  ASSERT_GT(largest(expected.force), 1.0);
  for (const KernelTable& kernel : {fused_kernels<Pack2>(), fused_kernels<Pack4>(), fused_kernels<Pack8>()}) {
    const Answer answer = run(kernel, model, u);
    // about 300 operations on numbers below 10: 300 x 10 x 2^-53 = 4e-13
    EXPECT_LT(largest_difference(answer.force, expected.force), 1e-12) << kernel.lanes;
    EXPECT_LT(largest_difference(answer.stress, expected.stress), 1e-12) << kernel.lanes;
    EXPECT_NEAR(answer.energy, expected.energy, 1e-12 * expected.energy) << kernel.lanes;
  }
}

// Parallelepipeds are integrated term by term, other cells point by point, by these kernels; the staged ones know
// points alone. A single cell that is off its parallelepiped sends its batch the other way.
TEST(SolidKernels, ParallelepipedsEqualTheSumOverPoints) {
  for (const double off : {0.0, 1e-3}) {
    Mesh mesh = block_mesh({3, 3, 3}, 0.0);
    for (Vec3& x : mesh.coordinates) x = {x[0] + 0.3 * x[1], 0.8 * x[1] - 0.2 * x[2], 1.5 * x[2] + 0.4 * x[0]};
    mesh.coordinates[0][0] -= off;
    const Model model = fully_integrated(one_part(std::move(mesh)));
    const auto u = random_vector(3 * model.mesh->node_count(), 1);
    KernelTable staged = kernels_reference();
    staged.hexa8_small = staged_kernels;
    const Answer expected = run(staged, model, u);
    for (const KernelTable& kernel : {kernels_reference(), fused_kernels<Pack4>(), fused_kernels<Pack8>()}) {
      const Answer answer = run(kernel, model, u);
      // 1e-12: as above
      EXPECT_LT(largest_difference(answer.force, expected.force), 1e-12) << kernel.lanes << ", " << off;
      EXPECT_NEAR(answer.energy, expected.energy, 1e-12 * expected.energy) << kernel.lanes << ", " << off;
    }
  }
}

TEST(SolidKernels, EveryBatchSizeIsFilledUpCorrectly) {
  for (const int cells : {1, 2, 3, 4, 5, 7, 8, 9}) {
    const Model model = fully_integrated(one_part(block_mesh({cells, 1, 1}, 0.0)));
    const auto u = random_vector(3 * model.mesh->node_count(), 2);
    EXPECT_LT(largest_difference(run(fused_kernels<Pack8>(), model, u).force, run(kernels_reference(), model, u).force),
              1e-12)
        << cells;
  }
}

/// A law without stress whose history is the time and the work of a unit stress along x; the latter is dissipated.
void remember(const void*, const PointBatch& batch) {
  for (int p = 0; p < batch.points; ++p) {
    std::fill_n(batch.stress + 6 * p, 6, 0.0);
    batch.energy[p] = 0.0;
    batch.new_history[2 * p] = batch.history[2 * p] + batch.dt;
    batch.new_history[2 * p + 1] = batch.history[2 * p + 1] + batch.strain[6 * p];
    batch.dissipation[p] = batch.new_history[2 * p + 1];
  }
}

TEST(SolidKernels, HistoryGoesFromTheBeginningOfTheStepToItsEnd) {
  const Model model = body(distorted_mesh(Section::plane_strain), Section::plane_strain, unit_material);
  SolidCells solid = make_solid_cells(model, kernels_reference());
  Block& block = solid.blocks[0];
  block.prepared_law.history = 2;
  block.stages.memory.resize(MemorySlot::law, 4 * 2);  // of four points
  block.prepared_law.kernels.update = remember;
  block.kernels = staged_kernels;
  ASSERT_EQ(solid.history_size(), 8 * static_cast<std::size_t>(block.cells));
  const std::vector<double> u = affine(*model.mesh, {{{0.5, 0.0, 0.0}}});
  std::vector<double> begin(solid.history_size()), end(begin.size()), f(u.size());
  for (int step = 0; step < 3; ++step) {
    SolidEnergies energies;
    block.kernels.add_internal_force(solid.batches(block, 0, block.cells, {0.25, begin}, end), block.law(), u.data(),
                                     f.data(), &energies);
    double volume = 0.0;
    for (std::size_t c = 0; c < solid.cells.size(); ++c)
      volume += BatchGradients(solid.batches(block, static_cast<Index>(c), 1)).volume(0);
    EXPECT_NEAR(energies.plastic, 0.5 * (step + 1) * volume, 1e-13 * volume) << "round-off of some hundred operations";
    std::swap(begin, end);
  }
  for (std::size_t k = 0; k < begin.size(); ++k) EXPECT_NEAR(begin[k], k % 2 == 0 ? 0.75 : 1.5, 1e-14) << k;
}

std::set<Index> nodes_of(const SolidCells& solid, const Chunk& chunk) {
  std::set<Index> nodes;
  for (Index c = 0; c < chunk.cells; ++c) {
    const Index position = solid.blocks[static_cast<std::size_t>(chunk.block)].first + chunk.first + c;
    for (const Index n : solid.nodes_of(static_cast<std::size_t>(position))) nodes.insert(n);
  }
  return nodes;
}

TEST(SolidChunks, OfOneColourShareNoNodeAndCoverAllCells) {
  Model model = fully_integrated(one_part(block_mesh({8, 8, 80}, 0.0)));  // two parts: 5120 cells, 10 chunks of 512
  Part& body = model.parts[0];
  model.parts.push_back({.name = "end",
                         .cells = {body.cells.begin() + 3000, body.cells.end()},
                         .material = unit_material,
                         .formulation = Formulation::full});
  model.parts[0].cells.resize(3000);
  const SolidCells solid = make_solid_cells(model, fused_kernels<Pack4>());
  std::size_t cells = 0;
  for (std::size_t k = 0; k + 1 < solid.colour_begin.size(); ++k) {
    std::set<Index> seen;
    for (std::size_t c = solid.colour_begin[k]; c < solid.colour_begin[k + 1]; ++c) {
      for (const Index n : nodes_of(solid, solid.chunks[c])) EXPECT_TRUE(seen.insert(n).second);
      cells += static_cast<std::size_t>(solid.chunks[c].cells);
    }
  }
  EXPECT_EQ(cells, 5120U);
  EXPECT_EQ(solid.colour_begin.size(), 3U) << "two colours suffice for a bar cut across";
}

// Chunks of one colour run at the same time: with 64 threads a colour of c chunks takes ceil(c / 64) rounds, and all of
// them hardly more than the chunks would take without colours.
TEST(SolidChunks, KeepSixtyFourThreadsBusy) {
  for (const std::array<Index, 3>& divisions : {std::array<Index, 3>{64, 64, 64}, {16, 16, 1600}, {4, 200, 300}}) {
    const SolidCells solid =
        make_solid_cells(fully_integrated(one_part(block_mesh(divisions, 0.0))), fused_kernels<Pack4>());
    std::size_t rounds = 0;
    for (std::size_t k = 0; k + 1 < solid.colour_begin.size(); ++k)
      rounds += (solid.colour_begin[k + 1] - solid.colour_begin[k] + 63) / 64;
    const double of_all = static_cast<double>(solid.chunks.size()) / 64.0;
    EXPECT_LT(static_cast<double>(rounds), of_all / 0.7) << solid.chunks.size() << " chunks";
  }
}

TEST(SolidChunks, MoreNeighboursThanSharedColoursRunAlone) {
  const std::vector<std::vector<Index>> all_touch_node_0(70, std::vector<Index>{0});
  std::vector<int> colour = colour_chunks(1, all_touch_node_0);
  std::sort(colour.begin(), colour.end());
  for (int k = 0; k < 70; ++k) EXPECT_EQ(colour[static_cast<std::size_t>(k)], k);
}

}  // namespace
}  // namespace carom::test::solid_kernels_test
