#include "solid/projected_stiffness.hpp"

#include <algorithm>

#include "parallel/threads.hpp"

namespace carom {
namespace {

/// What one cell adds: a block for each pair of the coarse points that its nodes are interpolated from.
struct CellPart {
  std::vector<Index> points;
  std::vector<double> blocks;  ///< [9 (points p + q) + 3 i + j]
};

std::vector<Index> points_of(std::span<const Index> nodes, const Interpolation& P) {
  std::vector<Index> points;
  for (const Index n : nodes)
    for (const Index I : P.coarse_of(at(n)))
      if (std::find(points.begin(), points.end(), I) == points.end()) points.push_back(I);
  return points;
}

/// P_e^T K_e P_e, K_e being the stiffness matrix of a cell.
CellPart project(std::span<const double> K, std::span<const Index> nodes, const Interpolation& P,
                 std::span<const std::uint8_t> fixed) {
  CellPart out{points_of(nodes, P), {}};
  const std::size_t n = nodes.size(), m = out.points.size(), dofs = 3 * n;
  std::vector<double> weight(n * m, 0.0), KP(9 * n * m, 0.0);
  for (std::size_t a = 0; a < n; ++a) {
    const auto coarse = P.coarse_of(at(nodes[a]));
    const auto weights = P.weights_of(at(nodes[a]));
    for (std::size_t k = 0; k < coarse.size(); ++k)
      weight[a * m + at(std::find(out.points.begin(), out.points.end(), coarse[k]) - out.points.begin())] = weights[k];
  }
  const auto is_fixed = [&](std::size_t a, std::size_t i) { return (fixed[at(nodes[a])] >> i & 1U) != 0; };
  for (std::size_t b = 0; b < n; ++b)
    for (std::size_t q = 0; q < m; ++q) {
      const double w = weight[b * m + q];
      if (w == 0.0) continue;
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            if (!is_fixed(b, j)) KP[9 * (a * m + q) + 3 * i + j] += w * K[(3 * a + i) * dofs + 3 * b + j];
    }
  out.blocks.assign(9 * m * m, 0.0);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t p = 0; p < m; ++p) {
      const double w = weight[a * m + p];
      if (w == 0.0) continue;
      for (std::size_t q = 0; q < m; ++q)
        for (std::size_t i = 0; i < 3; ++i)
          if (!is_fixed(a, i))
            for (std::size_t j = 0; j < 3; ++j)
              out.blocks[9 * (p * m + q) + 3 * i + j] += w * KP[9 * (a * m + q) + 3 * i + j];
    }
  return out;
}

BlockMatrix coarse_graph(const SolidCells& solid, const Interpolation& P) {
  PointGraph graph(P.coarse_points());
  for (std::size_t k = 0; k < solid.cells.size(); ++k) graph.couple(points_of(solid.nodes_of(k), P));
  return graph.matrix();
}

}  // namespace

BlockMatrix projected_stiffness(const SolidCells& solid, std::span<const double> u, const PointStep& step,
                                const Interpolation& P, std::span<const std::uint8_t> fixed) {
  BlockMatrix out = coarse_graph(solid, P);
  constexpr std::size_t batches_at_once = 64;
  std::vector<CellPart> parts;
  for (const Block& block : solid.blocks) {
    const std::size_t lanes = block.lanes(), cells = at(block.cells);
    for (std::size_t begin = 0; begin < cells; begin += batches_at_once * lanes) {
      const std::size_t end = std::min(cells, begin + batches_at_once * lanes);
      parts.assign(end - begin, {});
      parallel_for(end - begin, lanes, [&](std::size_t first, std::size_t last) {
        std::vector<double> K;
        batch_stiffness(solid.batches(block, static_cast<Index>(begin + first), static_cast<Index>(last - first), step),
                        block.kernels, block.law(), block.is_symmetric, u.empty() ? nullptr : u.data(), K);
        const std::size_t size = 9 * block.nodes() * block.nodes();
        for (std::size_t l = 0; l < last - first; ++l)
          parts[first + l] = project(std::span<const double>(K).subspan(size * l, size),
                                     solid.nodes_of(at(block.first) + begin + first + l), P, fixed);
      });
      for (const CellPart& part : parts)
        for (std::size_t p = 0; p < part.points.size(); ++p)
          for (std::size_t q = 0; q < part.points.size(); ++q) {
            double* sum = out.block(part.points[p], part.points[q]);
            for (std::size_t c = 0; c < 9; ++c) sum[c] += part.blocks[9 * (p * part.points.size() + q) + c];
          }
    }
  }
  return out;
}

}  // namespace carom
