#include "solid/projected_stiffness.hpp"

#include <algorithm>

#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {
namespace {

/// What one cell adds: a block for each pair of the coarse points that its nodes are interpolated from.
struct CellPart {
  std::vector<Index> points;
  std::vector<double> matrix;  ///< [3 (points) (3 p + i) + 3 q + j]
};

/// An entry of P_e for one component: what a dof of the cell has of one of a coarse point.
struct Weight {
  std::size_t of = 0, row = 0;
  double value = 0.0;
};

/// The parts of some cells of a chunk, and room to work in.
struct Slice {
  std::vector<CellPart> parts;
  std::vector<double> K, PK, KP;
  std::vector<Weight> weights;
};

void find_points(std::span<const Index> nodes, const Interpolation& P, std::vector<Index>& points) {
  points.clear();
  for (const Index n : nodes)
    for (const Index I : P.coarse_of(at(n)))
      if (std::find(points.begin(), points.end(), I) == points.end()) points.push_back(I);
}

/// out = P_e^T A without fixed components: A has `columns` entries in each row.
void restrict_rows(const double* __restrict A, std::size_t columns, const std::vector<Weight>& weights,
                   double* __restrict out) {
  for (const Weight& w : weights) {
    double* __restrict to = out + w.row * columns;
    const double* __restrict from = A + w.of * columns;
    for (std::size_t s = 0; s < columns; ++s) to[s] += w.value * from[s];
  }
}

void transpose(const std::vector<double>& A, std::size_t rows, std::size_t columns, std::vector<double>& out) {
  out.resize(A.size());
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t s = 0; s < columns; ++s) out[s * rows + r] = A[r * columns + s];
}

/// P_e^T K_e P_e, K_e being the stiffness matrix of a cell: P_e^T (P_e^T K_e^T)^T.
void project(const double* K, std::span<const Index> nodes, const Interpolation& P, std::span<const std::uint8_t> fixed,
             Slice& room, CellPart& out) {
  find_points(nodes, P, out.points);
  const std::size_t rows = 3 * out.points.size(), dofs = 3 * nodes.size();
  room.weights.clear();
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const auto coarse = P.coarse_of(at(nodes[a]));
    for (std::size_t k = 0; k < coarse.size(); ++k) {
      const std::size_t p = at(std::find(out.points.begin(), out.points.end(), coarse[k]) - out.points.begin());
      for (std::size_t i = 0; i < 3; ++i)
        if ((fixed[at(nodes[a])] >> i & 1U) == 0)
          room.weights.push_back({3 * a + i, 3 * p + i, P.weights_of(at(nodes[a]))[k]});
    }
  }
  room.PK.assign(rows * dofs, 0.0);
  restrict_rows(K, dofs, room.weights, room.PK.data());
  transpose(room.PK, rows, dofs, room.KP);
  room.PK.assign(rows * rows, 0.0);
  restrict_rows(room.KP.data(), rows, room.weights, room.PK.data());
  transpose(room.PK, rows, rows, out.matrix);
}

/// The rows that this rank computes.
struct OwnRows {
  EntryRange coarse, fine;

  /// Whether any of these cells adds to them.
  bool has(std::span<const Index> nodes, const Interpolation& P) const {
    return std::ranges::any_of(nodes, [&](Index n) {
      return fine.has(at(n)) || std::ranges::any_of(P.coarse_of(at(n)), [&](Index I) { return coarse.has(at(I)); });
    });
  }
};

void add_to_coarse(const CellPart& part, EntryRange own, BlockMatrix& coarse) {
  const std::size_t rows = 3 * part.points.size();
  for (std::size_t p = 0; p < part.points.size(); ++p) {
    if (!own.has(at(part.points[p]))) continue;
    for (std::size_t q = 0; q < part.points.size(); ++q) {
      double* sum = coarse.block(part.points[p], part.points[q]);
      const double* from = part.matrix.data() + 3 * p * rows + 3 * q;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum[3 * i + j] += from[i * rows + j];
    }
  }
}

void add_to_fine(std::span<const double> K, std::span<const Index> nodes, EntryRange own, BlockMatrix& fine) {
  const std::size_t dofs = 3 * nodes.size();
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t b = 0; own.has(at(nodes[a])) && b < nodes.size(); ++b) {
      float* sum = fine.single_block(nodes[a], nodes[b]);
      const double* from = K.data() + 3 * a * dofs + 3 * b;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum[3 * i + j] += static_cast<float>(from[i * dofs + j]);
    }
}

BlockMatrix coarse_graph(std::span<const SolidCells* const> solids, const Interpolation& P) {
  PointGraph graph(P.coarse_points());
  std::vector<Index> points;
  for (const SolidCells* solid : solids)
    for (std::size_t k = 0; k < solid->size(); ++k) {
      find_points(solid->nodes_of(k), P, points);
      graph.couple(points);
    }
  return graph.matrix();
}

/// Every rank gives its rows of the matrix to the others.
void gather_rows(BlockMatrix& A) {
  if (ranks().count() == 1) return;
  std::vector<std::vector<EntryRange>> blocks;
  for (std::size_t r = 0; r < ranks().count(); ++r) {
    const EntryRange rows = share_of(r, ranks().count(), A.points());
    blocks.push_back(
        {{static_cast<std::size_t>(A.row_begin[rows.begin]), static_cast<std::size_t>(A.row_begin[rows.end])}});
  }
  Exchange(std::move(blocks)).gather(A.value, 9);
}

}  // namespace

// Chunks of a colour share no nodes, so that they add to the fine matrix at the same time; coarse points they may
// share, so that their parts are added one after the other. A few of them at a time, slice by slice: parts take
// kilobytes.
void project_stiffness(std::span<const SolidCells* const> solids, std::span<const double> u, const PointStep& step,
                       const Interpolation& P, std::span<const std::uint8_t> fixed, BlockMatrix& coarse,
                       BlockMatrix* fine) {
  constexpr std::size_t chunks_at_once = 16;
  constexpr Index cells_at_once = 64;  // whole batches
  if (coarse.column.empty()) coarse = coarse_graph(solids, P);
  coarse.value.assign(9 * coarse.column.size(), 0.0);
  coarse.single.clear();
  if (fine != nullptr) fine->single.assign(9 * fine->column.size(), 0.0F);
  const OwnRows own{own_share_of(P.coarse_points()), own_share_of(P.fine_points())};
  std::vector<Slice> slices(chunks_at_once);
  const auto take = [&](const SolidCells& solid, const Chunk& chunk, Index begin, Slice& slice) {
    const Block& block = solid.blocks[at(chunk.block)];
    const Index end = block.has_no_stiffness() ? begin : std::min(chunk.cells, begin + cells_at_once);
    const auto lanes = static_cast<Index>(block.lanes());
    slice.parts.resize(at(std::max<Index>(0, end - begin)));
    for (Index first = begin; first < end; first += lanes) {
      const Index count = std::min(lanes, end - first), cell = chunk.first + first;
      bool is_wanted = false;
      for (std::size_t l = 0; l < at(count); ++l) {
        slice.parts[at(first - begin) + l].points.clear();
        is_wanted = is_wanted || own.has(solid.nodes_of(at(block.first + cell) + l), P);
      }
      if (!is_wanted) continue;
      solid.stiffness(block, cell, solid.batches(block, cell, count, step), u, step, slice.K);
      const std::size_t size = 9 * block.nodes() * block.nodes();
      for (std::size_t l = 0; l < at(count); ++l) {
        const auto K = std::span<const double>(slice.K).subspan(size * l, size);
        const auto nodes = solid.nodes_of(at(block.first + cell) + l);
        project(K.data(), nodes, P, fixed, slice, slice.parts[at(first - begin) + l]);
        if (fine != nullptr) add_to_fine(K, nodes, own.fine, *fine);
      }
    }
  };
  for (const SolidCells* solid : solids)
    for (std::size_t colour = 0; colour + 1 < solid->colour_begin.size(); ++colour)
      for (std::size_t c = solid->colour_begin[colour]; c < solid->colour_begin[colour + 1]; c += chunks_at_once) {
        const std::size_t count = std::min(chunks_at_once, solid->colour_begin[colour + 1] - c);
        Index longest = 0;
        for (std::size_t k = 0; k < count; ++k) longest = std::max(longest, solid->chunks[c + k].cells);
        for (Index begin = 0; begin < longest; begin += cells_at_once) {
          parallel_for(count, 1,
                       [&](std::size_t k, std::size_t) { take(*solid, solid->chunks[c + k], begin, slices[k]); });
          for (std::size_t k = 0; k < count; ++k)
            for (const CellPart& part : slices[k].parts) add_to_coarse(part, own.coarse, coarse);
        }
      }
  gather_rows(coarse);
}

}  // namespace carom
