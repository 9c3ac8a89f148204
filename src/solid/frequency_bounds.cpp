#include "solid/frequency_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/congruent_cells.hpp"

namespace carom {
namespace {

/// Upper bounds of the eigenvalues of M_e^-1 K_e (power_bound), K as batch_stiffness gives it. Places of a batch that
/// are filled up have neither mass nor stiffness.
void batch_bounds(const SolidCells& cells, const CellBatches& batch, const Block& block, std::span<const double> K,
                  std::span<double> bounds) {
  const std::size_t n = 3 * block.nodes(), lanes = block.lanes();
  std::vector<double> root(block.nodes() * lanes);
  block.stages.cell->lumped_mass(*block.stages.cell, batch.x, batch.offset, block.thickness, block.rho, root.data());
  for (double& r : root) r = r > 0.0 ? 1.0 / std::sqrt(r) : 0.0;
  std::vector<double> A(K.size()), work(K.size());
  for (std::size_t l = 0; l < lanes; ++l)
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t s = 0; s < n; ++s)
        A[(n * r + s) * lanes + l] = root[r / 3 * lanes + l] * K[(n * l + r) * n + s] * root[s / 3 * lanes + l];
  std::array<double, most_lanes> bound{};
  cells.power_bound(static_cast<int>(n), A.data(), work.data(), bound.data());
  std::copy_n(bound.begin(), at(batch.cells), bounds.begin());
}

/// Of some cells of a block, positions in it.
std::vector<double> frequency_bounds_of(const SolidCells& cells, const Block& block,
                                        std::span<const std::size_t> wanted) {
  const std::size_t lanes = block.lanes(), places = block.places();
  std::vector<double> bounds(wanted.size()), K;
  std::vector<Index> offset(places * lanes);
  for (std::size_t begin = 0; begin < wanted.size(); begin += lanes) {
    const std::size_t count = std::min(lanes, wanted.size() - begin);
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t c = wanted[begin + std::min(l, count - 1)];
      for (std::size_t a = 0; a < places; ++a)
        offset[a * lanes + l] = block.offset[(c / lanes * places + a) * lanes + c % lanes];
    }
    CellBatches batch = cells.batches(block, 0, static_cast<Index>(count));
    batch.offset = offset.data();
    batch_stiffness(batch, block.kernels, block.law(), nullptr, {}, K);
    batch_bounds(cells, batch, block, K, std::span<double>(bounds).subspan(begin));
  }
  return bounds;
}

}  // namespace

// One for all cells of a chunk that have the same shape.
std::vector<double> frequency_bounds(const SolidCells& cells) {
  std::vector<double> bounds(cells.size());
  cells.for_each_chunk([&](const Chunk& chunk) {
    const Block& block = cells.blocks[at(chunk.block)];
    if (block.is_nodal()) return;
    CongruentCells shapes = congruent_cells(cells, block, chunk.first, chunk.cells);
    for (std::size_t& c : shapes.first) c += at(chunk.first);
    const std::vector<double> of_shape = frequency_bounds_of(cells, block, shapes.first);
    for (std::size_t k = 0; k < shapes.of.size(); ++k)
      bounds[at(block.first + chunk.first) + k] = of_shape[shapes.of[k]];
  });
  return bounds;
}

DampingBounds damping_bounds(const SolidCells& cells) {
  DampingBounds out;
  const auto is_viscous = [](const Block& block) { return !block.length.empty(); };
  if (std::none_of(cells.blocks.begin(), cells.blocks.end(), is_viscous)) return out;
  out.bulk.assign(cells.size(), 0.0);
  out.hourglass = out.bulk;
  cells.for_each_batch({}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
    if (!is_viscous(block)) return;
    const auto bound = [&](const Viscosity& viscosity, std::vector<double>& bounds) {
      BatchStages stages = block.stages;
      stages.viscosity = viscosity;
      CellBatches viscous = batch;
      viscous.stages = &stages;
      std::vector<double> C, K;
      batch_stiffness(viscous, block.kernels, block.law(), nullptr, {}, K);
      viscous.viscous_dt = batch.length[0] / stages.wave_speed;
      batch_stiffness(viscous, block.kernels, block.law(), nullptr, {}, C);
      for (std::size_t k = 0; k < C.size(); ++k) C[k] = (C[k] - K[k]) * viscous.viscous_dt;
      batch_bounds(cells, batch, block, C, std::span<double>(bounds).subspan(first));
    };
    if (block.stages.bulk != nullptr) bound({.linear = 1.0}, out.bulk);
    if (block.stages.viscosity.hourglass > 0.0) bound({.hourglass = block.stages.viscosity.hourglass}, out.hourglass);
  });
  return out;
}

double largest_damping(const SolidCells& cells, const DampingBounds& bounds, std::span<const double> history) {
  double largest = 0.0;
  for (const Block& block : cells.blocks) {
    if (block.length.empty() || block.is_rigid) continue;
    const Viscosity& viscosity = block.stages.viscosity;
    const double quadratic = 2.0 * viscosity.quadratic * viscosity.quadratic / block.stages.wave_speed;
    const auto of_cell = [&](std::size_t c) {
      double closing = 0.0;
      if (block.stages.bulk != nullptr && !history.empty()) closing = std::max(0.0, -block.bulk_speed(c, history));
      const std::size_t position = at(block.first) + c;
      return bounds.bulk[position] * (viscosity.linear + quadratic * closing) + bounds.hourglass[position];
    };
    largest = std::max(largest, parallel_max(at(block.cells), 0.0, of_cell));
  }
  return largest;
}

}  // namespace carom
