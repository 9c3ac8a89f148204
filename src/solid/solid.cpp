#include "solid/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/types.hpp"
#include "parallel/threads.hpp"
#include "solid/projected_stiffness.hpp"
#include "solid/solid_impl.hpp"

namespace carom {

namespace {

/// A batch filled up with one cell of a block, a position in it.
struct OneCell {
  std::vector<Index> offset;
  std::vector<double> history, length;
  CellBatches batch;

  OneCell(const SolidCells& cells, const Block& block, Index cell, const PointStep& step)
      : offset(block.places() * block.lanes()), history(cells.repeated_history(block, cell, step)) {
    const std::size_t lanes = block.lanes(), first = at(cell) / lanes * lanes;
    for (std::size_t a = 0; a < block.places(); ++a)
      std::fill_n(offset.begin() + static_cast<std::ptrdiff_t>(a * lanes), lanes,
                  block.offset[(first * block.places()) + a * lanes + at(cell) % lanes]);
    batch = cells.batches(block, 0, 1, step);
    batch.offset = offset.data();
    if (!history.empty()) batch.history = history.data();
    if (!block.length.empty()) length.assign(lanes, block.length[at(cell)]);
    if (!length.empty()) batch.length = length.data();
  }
  OneCell(const OneCell&) = delete;
  OneCell& operator=(const OneCell&) = delete;
};

}  // namespace

Solid::Solid(const Model& model, Isa isa) : parts_(std::make_unique<Parts>(model, isa)) {}
Solid::~Solid() = default;
Solid::Solid(Solid&&) noexcept = default;

std::size_t Solid::node_count() const {
  return parts_->solid.mesh->node_count();
}
const BodyCells& Solid::cells() const {
  return parts_->solid.cells;
}
bool Solid::is_linear() const {
  return parts_->solid.are_linear() && parts_->patches.cells.are_linear() &&
         std::ranges::all_of(parts_->others, [](const Contributor* each) { return each->is_linear(); });
}
const Holding& Solid::all_nodes() const {
  return parts_->all_nodes;
}
const Holding& Solid::shared_nodes() const {
  return parts_->shared_nodes;
}
const Loads& Solid::loads() const {
  return parts_->loads;
}
const std::vector<Spring>& Solid::springs() const {
  return parts_->springs.all();
}
const CohesiveZones& Solid::cohesive() const {
  return parts_->cohesive;
}
const TurningBodies& Solid::turning_bodies() const {
  return parts_->turning_bodies;
}

SolidEnergies Solid::evaluate(std::span<const double> u, const PointStep& step, std::span<double> f,
                              std::span<double> end, std::vector<SolidEnergies>* of_parts) const {
  std::vector<SolidEnergies> of_cells(parts_->solid.chunks.size()), of_patches(parts_->patches.cells.chunks.size());
  parts_->sum_forces(u, step, f, end, [&](const SolidCells& cells, std::size_t chunk) {
    return &(&cells == &parts_->solid ? of_cells : of_patches)[chunk];
  });
  parts_->gather(of_cells, of_patches, end, step.nodes);
  SolidEnergies total;
  if (of_parts != nullptr) of_parts->assign(parts_->part_count, {});
  const auto add_up = [&](const SolidCells& cells, const std::vector<SolidEnergies>& of_chunks) {
    for (std::size_t c = 0; c < of_chunks.size(); ++c) {
      total.add(of_chunks[c]);
      if (of_parts == nullptr) continue;
      const Block& block = cells.blocks[at(cells.chunks[c].block)];
      (*of_parts)[at(parts_->part_numbers[block.part])].add(of_chunks[c]);
    }
  };
  add_up(parts_->solid, of_cells);
  add_up(parts_->patches.cells, of_patches);
  for (const Contributor* each : parts_->others) each->add_force(u, step, f, &total, end);
  return total;
}

void Solid::internal_force(std::span<const double> u, std::span<double> f, const PointStep& step) const {
  const auto unwanted = [](const SolidCells&, std::size_t) -> SolidEnergies* { return nullptr; };
  parts_->sum_forces(u, step, f, {}, unwanted);
  for (const Contributor* each : parts_->others) each->add_force(u, step, f, nullptr, {});
}

void Solid::add_internal_force_of(std::span<const Index> cells, std::span<const double> u, std::span<double> f,
                                  const PointStep& step, SolidEnergies* energies) const {
  std::vector<Index> of_patches;
  for (const Index cell : cells) {
    const Block& block = parts_->solid.block_of(at(cell));
    if (!block.is_nodal()) {
      const OneCell one(parts_->solid, block, cell - block.first, step);
      block.kernels.add_internal_force(one.batch, block.law(), u.data(), f.data(), energies);
    }
    if (!block.distortion.empty()) {
      const double energy = block.distortion.add_force(at(cell - block.first), u, f);
      if (energies != nullptr) energies->distortion += energy;
    }
    const std::span<const Index> own = parts_->patches.of(at(cell));
    of_patches.insert(of_patches.end(), own.begin(), own.end());
  }
  if (of_patches.empty()) return;
  std::sort(of_patches.begin(), of_patches.end());
  of_patches.erase(std::unique(of_patches.begin(), of_patches.end()), of_patches.end());
  std::vector<Index> wanted(cells.begin(), cells.end());
  std::sort(wanted.begin(), wanted.end());
  for (const Index patch : of_patches) {
    const Block& block = parts_->patches.cells.block_of(at(patch));
    const OneCell one(parts_->patches.cells, block, patch - block.first, step);
    std::array<unsigned char, most_patch_cells> is_wanted{};
    const std::span<const Index> own = parts_->patches.cells_of(at(patch));
    for (std::size_t e = 0; e < own.size(); ++e)
      is_wanted[e] = std::binary_search(wanted.begin(), wanted.end(), own[e]) ? 1 : 0;
    add_internal_force_of_parts(one.batch, block.law(), u.data(), is_wanted.data(), f.data());
  }
}

void Solid::tangent_action(std::span<const double> u, std::span<const double> x, std::span<double> y,
                           const PointStep& step) const {
  parts_->sum_over_chunks(
      y, step.nodes,
      [&](const SolidCells& cells, std::size_t, const Block& block, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            cells.add_living(run, step, {}, std::array{u.data(), x.data()}, sum,
                             [&](const CellBatches& batch, const std::array<const double*, 2>& own, double* into) {
                               block.kernels.add_tangent_action(batch, block.law(), own[0], own[1], into);
                             });
        for (const Chunk& run : runs) cells.add_distortion_action(run, u, x, y, step);
      });
  for (const Contributor* each : parts_->others) each->add_tangent_action(u, x, y, step);
}

void Solid::discrete_gradient_force(std::span<const double> u_0, std::span<const double> u_1,
                                    std::span<double> f) const {
  parts_->sum_over_chunks(
      f, nullptr,
      [&](const SolidCells& cells, std::size_t, const Block& block, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          if (!block.is_nodal())
            block.kernels.add_discrete_gradient_force(cells.batches(run), block.law(), u_0.data(), u_1.data(), sum);
      });
  for (const Contributor* each : parts_->others) each->add_discrete_gradient_force(u_0, u_1, f);
}

CsrMatrix Solid::tangent(std::span<const double> u, const PointStep& step) const {
  CsrMatrix K = dof_graph(parts_->graph());
  parts_->for_each_stiffness(u, step, [&](std::span<const Index> nodes, std::span<const double> cell) {
    const std::size_t dofs = 3 * nodes.size();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        for (std::size_t i = 0; i < 3; ++i) {
          double* row = K.value.data() + entry(K, 3 * nodes[a] + static_cast<Index>(i), 3 * nodes[b]);
          for (std::size_t j = 0; j < 3; ++j) row[j] += cell[(3 * a + i) * dofs + 3 * b + j];
        }
  });
  for (const Contributor* each : parts_->others) each->add_tangent(u, step, K);
  return K;
}

void Solid::project_tangent(std::span<const double> u, const PointStep& step, const Interpolation& P,
                            std::span<const std::uint8_t> fixed, BlockMatrix& coarse, BlockMatrix* fine) const {
  if (fine != nullptr && fine->column.empty()) {
    CsrMatrix graph = parts_->graph();
    fine->row_begin = std::move(graph.row_begin);
    fine->column = std::move(graph.column);
  }
  project_stiffness(std::array<const SolidCells*, 2>{&parts_->solid, &parts_->patches.cells}, u, step, P, fixed, coarse,
                    fine);
  if (parts_->others.empty()) return;
  CsrMatrix ties = parts_->tangent_of_others(u, step);
  if (fine != nullptr) {
    const BlockMatrix blocks = by_points(ties);
    for_each_block(blocks, [&](Index n, Index m, const double* block) {
      float* sum = fine->single_block(n, m);
      for (std::size_t c = 0; c < 9; ++c) sum[c] += static_cast<float>(block[c]);
    });
  }
  const auto is_fixed = [&](Index dof) { return (fixed[at(dof / 3)] >> (dof % 3) & 1U) != 0; };
  for (Index i = 0; i < ties.size; ++i)
    for (auto k = static_cast<std::size_t>(ties.row_begin[at(i)]);
         k < static_cast<std::size_t>(ties.row_begin[at(i) + 1]); ++k)
      if (is_fixed(i) || is_fixed(ties.column[k])) ties.value[k] = 0.0;
  BlockMatrix projected;
  galerkin(by_points(ties), P, projected);
  coarse = sum(coarse, projected);
}

double Solid::largest_change(std::span<const double> u_0, std::span<const double> u_1) const {
  const auto of_cell = [&](std::size_t k) {
    const auto nodes = cells().nodes_of(k);
    const auto moved = [&](Index n, std::size_t c) { return u_1[3 * at(n) + c] - u_0[3 * at(n) + c]; };
    double most = 0.0;
    for (const Index n : nodes) {
      double square = 0.0;
      for (std::size_t c = 0; c < 3; ++c) square += std::pow(moved(n, c) - moved(nodes[0], c), 2);
      most = std::max(most, square);
    }
    return std::sqrt(most) / cells().lengths[k];
  };
  double of_others = 0.0;
  for (const Contributor* each : parts_->others) of_others = std::max(of_others, each->largest_change(u_0, u_1));
  return parallel_max(cells().size(), of_others, of_cell);
}

std::vector<double> Solid::tangent_diagonal(std::span<const double> u, const PointStep& step) const {
  std::vector<double> diagonal(dof_count());
  parts_->sum_over_chunks(
      diagonal, nullptr,
      [&](const SolidCells& cells, std::size_t, const Block&, std::span<const Chunk> runs, double* sum) {
        for (const Chunk& run : runs)
          cells.for_each_stiffness(run, u, step, [&](std::size_t c, const Block&, std::span<const double> K) {
            const auto nodes = cells.nodes_of(c);
            const std::size_t dofs = 3 * nodes.size();
            for (std::size_t r = 0; r < dofs; ++r) sum[3 * at(nodes[r / 3]) + r % 3] += K[r * (dofs + 1)];
          });
      });
  for (const Contributor* each : parts_->others) each->add_tangent_diagonal(u, step, diagonal);
  return diagonal;
}

const std::vector<double>& Solid::diagonal_at_rest() const {
  std::call_once(parts_->is_diagonal_made,
                 [&] { parts_->diagonal_at_rest = tangent_diagonal(std::vector<double>(dof_count(), 0.0)); });
  return parts_->diagonal_at_rest;
}

Mass Solid::mass(MassKind kind) const {
  if (kind == MassKind::lumped) return parts_->lumped_mass([](std::size_t) { return 1.0; });
  CsrMatrix M = node_graph(std::array<const SolidCells*, 1>{&parts_->solid});
  parts_->solid.for_each_cell([&](std::size_t c, const Block& block) {
    const NodeMatrix cell = block.mass(parts_->solid.coordinates_of(c), block.thickness, block.rho);
    const auto nodes = parts_->solid.nodes_of(c);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        M.value[entry(M, nodes[a], nodes[b])] += cell[a * nodes.size() + b];
  });
  parts_->for_each_body_mass([&](Index node, double mass) { add_diagonal(M, node, mass); });
  return Mass(std::move(M));
}

Mass Solid::lumped_mass(std::span<const double> cell_factors) const {
  return parts_->lumped_mass([&](std::size_t c) { return cell_factors[c]; });
}

}  // namespace carom
