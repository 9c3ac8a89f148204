// The solid cells in batches: blocks of one part, cut into coloured chunks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kernels/kernels.hpp"
#include "model/model.hpp"
#include "parallel/threads.hpp"
#include "solid/body_cells.hpp"
#include "solid/cell_matrices.hpp"
#include "solid/distortion_control.hpp"
#include "solid/point_step.hpp"

namespace carom {

/// The cells of one part, laid out for the kernels (CellBatches).
struct Block {
  Index first = 0;       ///< position of its first cell in SolidCells::cells
  std::size_t part = 0;  ///< of the model
  Index cells = 0;
  CellType type{};
  double thickness = 1.0, rho = 0.0;
  double wave_modulus = 0.0;               ///< lambda + 2 G at rest
  bool is_ring = false;                    ///< axisymmetric
  bool is_rigid = false;                   ///< its cells are of a rigid body: no chunk has them
  bool small_strain = true;                ///< the measure of its law; the others are total Lagrangian
  bool is_linear = true;                   ///< the forces are linear in the displacements
  std::vector<std::string> history_names;  ///< of a point (Material::history)
  CellMass mass = nullptr;
  std::shared_ptr<const CellStages> cell_stages;  ///< of patches, which stages.cell is then
  BatchStages stages;
  CellKernels kernels;  ///< none of the cells of nodal parts, whose patches are integrated (solid/node_patches.hpp)
  PreparedLaw prepared_law;
  std::vector<Index> offset;
  double distortion_limit = 0.0;  ///< 0: no distortion control
  DistortionControl distortion;   ///< SolidCells::control_distortion
  std::vector<double> length;     ///< of its cells, filled up as the batches; only with viscosity
  std::size_t history_first = 0;  ///< where the block's history begins among the points of all blocks

  std::size_t nodes() const { return static_cast<std::size_t>(stages.cell->nodes); }
  std::size_t lanes() const { return static_cast<std::size_t>(stages.lanes); }
  std::size_t places() const { return static_cast<std::size_t>(stages.cell->places()); }
  bool is_nodal() const { return kernels.add_internal_force == nullptr; }
  bool has_no_stiffness() const { return is_nodal() && distortion.empty(); }
  BatchLaw law() const { return prepared_law.batch(); }
  /// Numbers of history of one lane (CellMemory): batches, filled up, follow each other.
  std::size_t history_per_cell() const { return static_cast<std::size_t>(stages.memory.size()); }
  /// The speed at which a cell of the block opens (BulkHistory), a position in it.
  double bulk_speed(std::size_t cell, std::span<const double> history) const {
    const std::size_t n = lanes(), batch = history_first + history_per_cell() * (cell / n * n);
    const auto speed = static_cast<std::size_t>(stages.memory.begin(MemorySlot::viscosity)) + bulk_history - 1;
    return history[batch + speed * n + cell % n];
  }
  /// Calls body(lane, the lumped masses of its nodes) for the cells of one batch.
  template <class Body>
  void for_each_lumped_mass(const CellBatches& batch, const Body& body) const {
    std::array<double, most_nodes * most_lanes> m;
    std::array<double, most_nodes> of_cell;
    stages.cell->lumped_mass(*stages.cell, batch.x, batch.offset, thickness, rho, m.data());
    for (std::size_t l = 0; l < static_cast<std::size_t>(batch.cells); ++l) {
      for (std::size_t a = 0; a < nodes(); ++a) of_cell[a] = m[a * lanes() + l];
      body(l, std::span<const double>(of_cell).first(nodes()));
    }
  }
  /// Numbers of history of the block.
  std::size_t history_size() const { return is_rigid ? 0 : history_per_cell() * offset.size() / places(); }
};

/// Consecutive cells of one block, whole batches but for the block's last.
struct Chunk {
  Index block = 0;
  Index first = 0;  ///< cell in the block, a multiple of the lanes
  Index cells = 0;
};

/// All solid cells. Chunk bounds and colours depend on the mesh alone, never on the number of threads.
struct SolidCells {
  std::shared_ptr<const Mesh> mesh;
  BodyCells cells;  ///< none of patches, which have their nodes here, filled up as the batches:
  std::vector<std::size_t> node_begin;
  std::vector<Index> node_list;
  std::vector<Block> blocks;              ///< one per part that has cells
  std::vector<Chunk> chunks;              ///< sorted by colour
  std::vector<std::size_t> colour_begin;  ///< colours + 1 entries into chunks
  std::vector<Chunk> rigid_chunks;        ///< cells of rigid bodies, which nothing is integrated over but their volume
  decltype(KernelTable::power_bound) power_bound = nullptr;

  std::size_t size() const { return blocks.empty() ? 0 : at(blocks.back().first) + at(blocks.back().cells); }
  /// Nodes of the cell at a position in `cells`.
  std::span<const Index> nodes_of(std::size_t position) const;
  /// Reference coordinates of its nodes.
  CellNodes coordinates_of(std::size_t position) const;
  /// And where they are at u.
  CellNodes coordinates_of(std::size_t position, std::span<const double> u) const;
  /// The kernels' view of `count` cells of a block from its cell `first` on, which must be a multiple of the lanes.
  /// The history at the end of the step goes to `end` unless it is empty.
  CellBatches batches(const Block& block, Index first, Index count, const PointStep& step = {},
                      std::span<double> end = {}) const;
  /// batch_stiffness, and that of corners that resist, of a batch of the block that begins with its cell `first`. `u`
  /// empty: at rest.
  void stiffness(const Block& block, Index first, const CellBatches& batch, std::span<const double> u,
                 const PointStep& step, std::vector<double>& K) const;
  bool is_there(Index position, const PointStep& step) const;
  /// By cell of `count` cells of a block from its cell `first` on, 0 of those that have gone; empty when none has.
  std::span<const std::uint8_t> gone_among(const Block& block, Index first, Index count, const PointStep& step) const;
  /// Calls body(first, batches, vectors, alive) for the cells of a chunk from its cell `first` on, for all of them at
  /// once where none has gone (alive: empty); else batch by batch, those with gone cells apart from each other, as
  /// CellsApart has them.
  template <std::size_t N, class Body>
  void for_each_living(const Chunk& chunk, const PointStep& step, std::span<double> end,
                       const std::array<const double*, N>& vectors, const Body& body) const {
    const Block& block = blocks[at(chunk.block)];
    if (gone_among(block, chunk.first, chunk.cells, step).empty())
      return body(Index{0}, batches(chunk, step, end), vectors, std::span<const std::uint8_t>{});
    for (Index first = 0; first < chunk.cells; first += block.stages.lanes) {
      const Index count = std::min<Index>(block.stages.lanes, chunk.cells - first);
      const CellBatches batch = batches(block, chunk.first + first, count, step, end);
      const std::span<const std::uint8_t> alive = gone_among(block, chunk.first + first, count, step);
      if (alive.empty()) {
        body(first, batch, vectors, alive);
        continue;
      }
      const CellsApart apart(batch, vectors, alive);
      std::array<const double*, N> own;
      for (std::size_t v = 0; v < N; ++v) own[v] = apart.at[v].data();
      body(first, apart.batch, own, alive);
    }
  }
  /// sum += kernel(batches, vectors, .) of a chunk's cells but those that have gone.
  template <std::size_t N, class Kernel>
  void add_living(const Chunk& chunk, const PointStep& step, std::span<double> end,
                  const std::array<const double*, N>& vectors, double* sum, const Kernel& kernel) const {
    for_each_living(chunk, step, end, vectors,
                    [&](Index first, const CellBatches& batch, const std::array<const double*, N>& own,
                        std::span<const std::uint8_t> alive) {
                      if (alive.empty()) return kernel(batch, own, sum);
                      const Block& block = blocks[at(chunk.block)];
                      std::vector<double> apart(3 * block.nodes() * block.lanes(), 0.0);
                      kernel(batch, own, apart.data());
                      const Index* offset = block.offset.data() + block.places() * at(chunk.first + first);
                      for (std::size_t k = 0; k < block.nodes() * block.lanes(); ++k) {
                        const std::size_t lane = k % block.lanes();
                        if (lane >= alive.size() || alive[lane] == 0) continue;
                        for (std::size_t i = 0; i < 3; ++i) sum[at(offset[k]) + i] += apart[3 * k + i];
                      }
                    });
  }
  /// Of a chunk.
  CellBatches batches(const Chunk& chunk, const PointStep& step = {}, std::span<double> end = {}) const {
    return batches(blocks[at(chunk.block)], chunk.first, chunk.cells, step, end);
  }
  /// Calls body(cell position, block, its stiffness matrix at u) for all cells, in the order of for_each_chunk.
  template <class Body>
  void for_each_stiffness(std::span<const double> u, const PointStep& step, const Body& body) const {
    for_each_chunk([&](const Chunk& chunk) { for_each_stiffness(chunk, u, step, body); });
  }
  /// The same for the cells of a chunk.
  template <class Body>
  void for_each_stiffness(const Chunk& chunk, std::span<const double> u, const PointStep& step,
                          const Body& body) const {
    each_batch_of(chunk, step, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      if (block.has_no_stiffness()) return;
      std::vector<double> K;
      stiffness(block, static_cast<Index>(first) - block.first, batch, u, step, K);
      const std::size_t size = 9 * block.nodes() * block.nodes();
      for (std::size_t l = 0; l < static_cast<std::size_t>(batch.cells); ++l)
        body(first + l, block, std::span<const double>(K).subspan(size * l, size));
    });
  }
  /// Makes the distortion control of the blocks that have a limit, by the reference volumes of all cells; false where
  /// none has. A chunk's forces (their energy is returned) and tangent action are added as those of its kernels; its
  /// growth is what the corners have of omega^2 over that at rest, own[k] being of its cell k.
  bool control_distortion(std::span<const double> volumes);
  double add_distortion_force(const Chunk& chunk, std::span<const double> u, std::span<double> f,
                              const PointStep& step) const;
  void add_distortion_action(const Chunk& chunk, std::span<const double> u, std::span<const double> x,
                             std::span<double> y, const PointStep& step) const;
  void add_distortion_growth(const Chunk& chunk, std::span<const double> u, std::span<const double> bounds_at_rest,
                             std::span<double> own, const PointStep& step) const;
  /// Lengths (mesh/cell_size.hpp) of cells of a block, displaced by u; `first` begins a batch.
  void lengths(const Block& block, Index first, std::span<const double> u, std::span<double> length) const;
  /// The history of one cell of a block, a position in it, in every lane of a batch. Empty where there is none.
  std::vector<double> repeated_history(const Block& block, Index cell, const PointStep& step) const;
  /// Numbers of history of all points.
  std::size_t history_size() const;
  /// Calls copy(place, position) for each of them: its place among those of the batches, whose lanes lie side by side,
  /// and its position where the cells stand one after the other, each with all that it remembers. Places that fill up
  /// the last batch of a block have the position of the block's last cell. Returns how many positions there are.
  template <class Copy>
  std::size_t for_each_history(const Copy& copy) const {
    std::size_t position = 0;
    for (const Block& block : blocks) {
      const std::size_t values = block.history_per_cell(), lanes = block.lanes();
      const std::size_t filled = values == 0 ? 0 : block.history_size() / values;
      for (std::size_t c = 0; c < filled; ++c)
        for (std::size_t k = 0; k < values; ++k)
          copy(block.history_first + values * (c / lanes * lanes) + k * lanes + c % lanes,
               position + values * std::min(c, at(block.cells) - 1) + k);
      if (filled > 0) position += values * at(block.cells);
    }
    return position;
  }
  const Block& block_of(std::size_t position) const;
  bool are_linear() const;
  /// Hourglass modes.
  bool have_modes() const;

  /// Calls body(chunk) for all chunks; those of one colour at the same time, colours one after the other.
  template <class Body>
  void for_each_chunk(const Body& body) const {
    for (std::size_t k = 0; k + 1 < colour_begin.size(); ++k)
      parallel_for(colour_begin[k + 1] - colour_begin[k], 1,
                   [&](std::size_t begin, std::size_t) { body(chunks[colour_begin[k] + begin]); });
  }

  /// Calls body(position of its first cell, block, its cells) for all batches, in the order of for_each_chunk.
  template <class Body>
  void for_each_batch(const PointStep& step, const Body& body) const {
    for_each_chunk([&](const Chunk& chunk) { each_batch_of(chunk, step, body); });
  }
  /// The same of the cells of rigid bodies, one after the other.
  template <class Body>
  void for_each_rigid_batch(const Body& body) const {
    for (const Chunk& chunk : rigid_chunks) each_batch_of(chunk, {}, body);
  }
  template <class Body>
  void each_batch_of(const Chunk& chunk, const PointStep& step, const Body& body) const {
    const Block& block = blocks[static_cast<std::size_t>(chunk.block)];
    for (Index first = chunk.first; first < chunk.first + chunk.cells; first += block.stages.lanes) {
      const Index count = std::min<Index>(block.stages.lanes, chunk.first + chunk.cells - first);
      body(static_cast<std::size_t>(block.first) + static_cast<std::size_t>(first), block,
           batches(block, first, count, step));
    }
  }

  /// Calls body(cell position, block, the lumped masses of its nodes) for all cells, in the order of for_each_chunk.
  template <class Body>
  void for_each_lumped_mass(const Body& body) const {
    for_each_batch({}, [&](std::size_t first, const Block& block, const CellBatches& batch) {
      block.for_each_lumped_mass(batch,
                                 [&](std::size_t lane, std::span<const double> m) { body(first + lane, block, m); });
    });
  }

  /// Calls body(cell position, block) for all cells, in the order of for_each_chunk.
  template <class Body>
  void for_each_cell(const Body& body) const {
    for_each_chunk([&](const Chunk& chunk) {
      const Block& block = blocks[static_cast<std::size_t>(chunk.block)];
      const Index first = block.first + chunk.first;
      for (Index c = first; c < first + chunk.cells; ++c) body(static_cast<std::size_t>(c), block);
    });
  }
};

/// The block of a part, without cells: its stages are those given, or of its element.
Block block_of(const Part& part, std::shared_ptr<const CellStages> stages, const KernelTable& table);
/// Fills in chunks and colours, by the blocks.
void cut_and_colour(SolidCells& solid);

/// Lays the parts out in batches by the lanes of `table`. Throws CaseError when a part names a cell that its block does
/// not have, when a cell is in two parts, when there is no element of its cell type, section and formulation, or when a
/// cell is degenerate: a Jacobian determinant at a Gauss point that is not positive, plane cells of changing z,
/// axisymmetric ones with a node at negative x.
SolidCells make_solid_cells(const Model& model, const KernelTable& table);

}  // namespace carom
