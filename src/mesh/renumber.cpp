#include "mesh/renumber.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

namespace {

/// The nearest multiple of `step` to a length, as a count; 0 where extents overflow, so that it can always be sorted
/// by.
double bin(double length, double step) {
  constexpr double kMost = 1e7;
  return std::fmin(std::fmax(std::round(length / step), 0.0), kMost);  // fmax turns not-a-number into 0
}

/// The cells that are not pieces of a boundary, and for each node those it belongs to (compressed rows).
class Connections {
 public:
  explicit Connections(const Mesh& mesh) : mesh_(mesh), node_begin_(mesh.node_count() + 1, 0) {
    const std::vector<std::uint8_t> dimensions = node_dimensions(mesh);
    std::vector<bool> counts;
    for (const CellBlock& block : mesh.blocks) {
      block_begin_.push_back(counts.size());
      for (Index cell = 0; at(cell) < block.size(); ++cell)
        counts.push_back(dimension(block.type) > 0 && !on_boundary(block.nodes(cell), block.type, dimensions));
    }
    const auto each = [&](const auto& body) {
      for (std::size_t cell = 0; cell < counts.size(); ++cell)
        if (counts[cell])
          for (const Index n : nodes(static_cast<Index>(cell))) body(n, cell);
    };
    each([&](Index n, std::size_t) { ++node_begin_[at(n) + 1]; });
    std::partial_sum(node_begin_.begin(), node_begin_.end(), node_begin_.begin());
    node_cells_.resize(node_begin_.back());
    std::vector<std::size_t> next(node_begin_.begin(), node_begin_.end() - 1);
    each([&](Index n, std::size_t cell) { node_cells_[next[at(n)]++] = static_cast<Index>(cell); });
    cell_count_ = counts.size();
  }

  CellType type(Index cell) const { return mesh_.blocks[block_of(cell)].type; }
  std::size_t cell_count() const { return cell_count_; }
  std::span<const Index> nodes(Index cell) const {
    const std::size_t b = block_of(cell);
    return mesh_.blocks[b].nodes(cell - static_cast<Index>(block_begin_[b]));
  }
  std::span<const Index> cells(Index node) const {
    return {node_cells_.data() + node_begin_[at(node)], node_cells_.data() + node_begin_[at(node) + 1]};
  }

 private:
  std::size_t block_of(Index cell) const {
    std::size_t b = 0;  // there are some types of cells at most
    while (b + 1 < block_begin_.size() && block_begin_[b + 1] <= at(cell)) ++b;
    return b;
  }

  const Mesh& mesh_;
  std::size_t cell_count_ = 0;
  std::vector<std::size_t> block_begin_, node_begin_;
  std::vector<Index> node_cells_;
};

struct Mean {
  double sum = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return sum / count; }
};

/// Low and high ends of the places of some nodes.
struct Bounds {
  Vec3 low{}, high{};
  Vec3 size() const { return subtract(high, low); }
};
Bounds bounds_of(const Mesh& mesh, std::span<const Index> nodes) {
  if (nodes.empty()) return {};
  Bounds box{mesh.coordinates[at(nodes.front())], mesh.coordinates[at(nodes.front())]};
  for (const Index n : nodes) {
    const Vec3& x = mesh.coordinates[at(n)];
    for (std::size_t c = 0; c < 3; ++c) {
      box.low[c] = std::min(box.low[c], x[c]);
      box.high[c] = std::max(box.high[c], x[c]);
    }
  }
  return box;
}
/// The axes by these lengths, the longest first; of equal ones z, then y.
std::array<std::size_t, 3> longest_first(const Vec3& size) {
  std::array<std::size_t, 3> axes{2, 1, 0};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](std::size_t a, std::size_t b) { return size[a] > size[b] * (1 + 1e-9); });
  return axes;
}

/// Orders the nodes of one connected body after another.
class LevelOrder {
 public:
  explicit LevelOrder(const Mesh& mesh)
      : mesh_(mesh),
        connections_(mesh),
        seen_node_(mesh.node_count(), 0),
        placed_(mesh.node_count(), 0),
        seen_cell_(connections_.cell_count(), 0),
        expanded_(connections_.cell_count(), 0),
        place_(mesh.node_count(), -1) {
    order_.reserve(mesh.node_count());
  }

  struct Result {
    std::vector<Index> order;           ///< order[new index] = old index
    std::vector<std::size_t> body_end;  ///< for each body the new index behind its last
  };
  Result compute() && {
    for (std::size_t n = 0; n < mesh_.node_count(); ++n) {
      if (placed_[n] != 0) continue;
      std::vector<Index> level = start_level(body_of(static_cast<Index>(n)));
      while (!level.empty()) {
        order_.insert(order_.end(), level.begin(), level.end());
        level = next_level(level);
      }
      body_end_.push_back(order_.size());
    }
    return {std::move(order_), std::move(body_end_)};
  }

 private:
  std::vector<Index> body_of(Index seed) {
    std::vector<Index> body{seed};
    seen_node_[at(seed)] = 1;
    for (std::size_t i = 0; i < body.size(); ++i)
      for (const Index cell : connections_.cells(body[i])) {
        if (std::exchange(seen_cell_[at(cell)], char{1}) != 0) continue;
        for (const Index n : connections_.nodes(cell))
          if (std::exchange(seen_node_[at(n)], char{1}) == 0) body.push_back(n);
      }
    return body;
  }

  /// Nodes at the lower end of the longest side, row by row; places nearer than 1e-6 of that side count as equal.
  std::vector<Index> start_level(const std::vector<Index>& body) {
    const Bounds box = bounds_of(mesh_, body);
    const Vec3& low = box.low;
    const Vec3 size = box.size();
    const std::array<std::size_t, 3> axes = longest_first(size);
    const double step = size[axes[0]] > 0 ? 1e-6 * size[axes[0]] : 1.0;
    const auto place = [&](Index n, std::size_t axis) { return bin(mesh_.coordinates[at(n)][axis] - low[axis], step); };
    std::vector<Index> level;
    std::copy_if(body.begin(), body.end(), std::back_inserter(level), [&](Index n) { return place(n, axes[0]) <= 0; });
    std::sort(level.begin(), level.end(), [&](Index a, Index b) {
      return std::tuple(place(a, axes[1]), place(a, axes[2]), a) < std::tuple(place(b, axes[1]), place(b, axes[2]), b);
    });
    for (const Index n : level) placed_[at(n)] = 1;
    return level;
  }

  /// Unplaced neighbours of `level`, sorted by the mean place in `level` of the neighbours they have there.
  std::vector<Index> next_level(const std::vector<Index>& level) {
    for (std::size_t i = 0; i < level.size(); ++i) place_[at(level[i])] = static_cast<Index>(i);
    std::vector<Index> next;
    by_edges_.clear();
    by_cells_.clear();
    for (const Index node : level)
      for (const Index cell : connections_.cells(node))
        if (std::exchange(expanded_[at(cell)], char{1}) == 0) expand(cell, next);
    std::vector<std::pair<double, Index>> keys;
    keys.reserve(next.size());
    for (std::size_t i = 0; i < next.size(); ++i) {
      keys.emplace_back(by_edges_[i].count > 0 ? by_edges_[i].value() : by_cells_[i].value(), next[i]);
      place_[at(next[i])] = -1;
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t i = 0; i < next.size(); ++i) next[i] = keys[i].second;
    for (const Index n : level) place_[at(n)] = -1;
    return next;
  }

  /// Adds the unplaced nodes of a cell to `next`, and to their means the places that they reach in the level.
  void expand(Index cell, std::vector<Index>& next) {
    const std::span<const Index> nodes = connections_.nodes(cell);
    Mean level;
    for (const Index n : nodes)
      if (place_[at(n)] >= 0) level.add(place_[at(n)]);
    for (const Index n : nodes) {
      if (place_[at(n)] >= 0) continue;
      if (std::exchange(placed_[at(n)], char{1}) == 0) {
        place_[at(n)] = -2 - static_cast<Index>(next.size());
        next.push_back(n);
        by_edges_.emplace_back();
        by_cells_.emplace_back();
      }
      by_cells_[in_next(n)].add(level.value());
    }
    for (const CornerFrame& frame : corner_frames(connections_.type(cell)))
      for (const LocalNode end : {frame.a, frame.b, frame.c})
        if (place_[at(nodes[frame.corner])] < 0 && place_[at(nodes[end])] >= 0)
          by_edges_[in_next(nodes[frame.corner])].add(place_[at(nodes[end])]);
  }
  /// The place in the next level of a node that is in it.
  std::size_t in_next(Index node) const { return at(-2 - place_[at(node)]); }

  const Mesh& mesh_;
  Connections connections_;
  std::vector<char> seen_node_, placed_, seen_cell_, expanded_;
  std::vector<Index> place_;               ///< in the current level; -2 - place in the next one; or -1
  std::vector<Mean> by_edges_, by_cells_;  ///< by place in the next level, of the places of the neighbours in this one
  std::vector<Index> order_;
  std::vector<std::size_t> body_end_;
};

/// order[new] = old turned into new_index[old]
std::vector<Index> inverse(const std::vector<Index>& order) {
  std::vector<Index> result(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) result[at(order[i])] = static_cast<Index>(i);
  return result;
}

std::vector<Index> first_entries(std::size_t count) {
  std::vector<Index> entries(count);
  std::iota(entries.begin(), entries.end(), Index{0});
  return entries;
}

/// The entries in increasing order of a key below `most`, equal ones in the order that they have.
template <class Key>
std::vector<Index> sorted_by(const std::vector<Index>& entries, std::size_t most, const Key& key) {
  std::vector<std::size_t> begin(most + 1, 0);
  for (const Index i : entries) ++begin[key(i) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> order(entries.size());
  for (const Index i : entries) order[begin[key(i)]++] = i;
  return order;
}

/// Sorts the cells of a block by smallest node, then by the sum of nodes; returns order[new] = old.
std::vector<Index> sort_cells(CellBlock& block, std::size_t node_count) {
  struct Key {
    Index smallest;
    std::int64_t sum;
  };
  std::vector<Key> keys(block.size());
  for (std::size_t cell = 0; cell < block.size(); ++cell) {
    const std::span<const Index> nodes = block.nodes(static_cast<Index>(cell));
    keys[cell] = {*std::min_element(nodes.begin(), nodes.end()), 0};
    for (const Index node : nodes) keys[cell].sum += node;
  }
  std::vector<Index> order =
      sorted_by(first_entries(keys.size()), node_count, [&](Index i) { return at(keys[at(i)].smallest); });
  for (auto first = order.begin(); first != order.end();) {
    const auto last =
        std::find_if(first, order.end(), [&](Index c) { return keys[at(c)].smallest != keys[at(*first)].smallest; });
    std::sort(first, last,
              [&](Index a, Index b) { return std::pair(keys[at(a)].sum, a) < std::pair(keys[at(b)].sum, b); });
    first = last;
  }
  CellBlock sorted{block.type, {}, {}};
  sorted.connectivity.reserve(block.connectivity.size());
  sorted.file_numbers.reserve(block.size());
  for (const Index cell : order) {
    const std::span<const Index> nodes = block.nodes(cell);
    sorted.connectivity.insert(sorted.connectivity.end(), nodes.begin(), nodes.end());
    sorted.file_numbers.push_back(block.file_numbers[at(cell)]);
  }
  block = std::move(sorted);
  return order;
}

void renumber_nodes(Mesh& mesh, const std::vector<Index>& order) {
  const std::vector<Index> new_index = inverse(order);
  std::vector<Vec3> coordinates(order.size());
  std::vector<std::int64_t> numbers(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    coordinates[i] = mesh.coordinates[at(order[i])];
    numbers[i] = mesh.node_numbers[at(order[i])];
  }
  mesh.coordinates = std::move(coordinates);
  mesh.node_numbers = std::move(numbers);
  for (CellBlock& block : mesh.blocks)
    for (Index& n : block.connectivity) n = new_index[at(n)];
  for (auto& [name, nodes] : mesh.node_groups) {
    for (Index& n : nodes) n = new_index[at(n)];
    std::sort(nodes.begin(), nodes.end());
  }
}

/// Are the nodes of a cell near each other in the order that they have?
bool is_local(const Mesh& mesh) {
  double spread = 0.0, cells = 0.0;
  for (const CellBlock& block : mesh.blocks) {
    for (std::size_t cell = 0; cell < block.size(); ++cell) {
      const auto [low, high] = std::ranges::minmax(block.nodes(static_cast<Index>(cell)));
      spread += high - low;
    }
    cells += static_cast<double>(block.size());
  }
  constexpr double near = 0.02;  // as in grid_order: two of its bins
  return spread <= near * cells * static_cast<double>(mesh.node_count());
}

/// Nodes along the bins of a coarse grid: near enough to the final order that finding it does not wait for memory.
std::vector<Index> grid_order(const Mesh& mesh) {
  constexpr std::size_t kBins = 100;
  std::vector<Index> order = first_entries(mesh.node_count());
  const Bounds box = bounds_of(mesh, order);
  const Vec3& low = box.low;
  const double size = std::ranges::max(box.size());
  const double bin_size = size > 0 ? size / static_cast<double>(kBins) : 1.0;
  for (const std::size_t c : {0, 1, 2})
    order = sorted_by(order, kBins + 2, [&](Index n) {
      return static_cast<std::size_t>(
          std::fmin(bin(mesh.coordinates[at(n)][c] - low[c], bin_size), static_cast<double>(kBins + 1)));
    });
  return order;
}

/// Sorts the cells of a group, each of which is there once.
void sort_refs(const Mesh& mesh, std::vector<CellRef>& cells) {
  if (cells.size() < 1000) return std::sort(cells.begin(), cells.end());
  std::vector<std::vector<bool>> is_member;
  for (const CellBlock& block : mesh.blocks) is_member.emplace_back(block.size());
  for (const CellRef& ref : cells) is_member[at(ref.block)][at(ref.cell)] = true;
  cells.clear();
  for (std::size_t b = 0; b < is_member.size(); ++b)
    for (std::size_t cell = 0; cell < is_member[b].size(); ++cell)
      if (is_member[b][cell]) cells.push_back({static_cast<Index>(b), static_cast<Index>(cell)});
}

/// Brings nodes into this order (order[new] = old) and cells along.
void reorder(const std::vector<Index>& order, Mesh& mesh) {
  renumber_nodes(mesh, order);
  std::vector<std::vector<Index>> new_cell;
  for (CellBlock& block : mesh.blocks) new_cell.push_back(inverse(sort_cells(block, mesh.node_count())));
  for (auto& [name, cells] : mesh.cell_groups) {
    for (CellRef& ref : cells) ref.cell = new_cell[at(ref.block)][at(ref.cell)];
    sort_refs(mesh, cells);
  }
}

/// The place on Hilbert's curve through a square or cube of 2^levels bins an edge, from the origin to the other end of
/// the first axis (J. Skilling, AIP Conf. Proc. 707, 2004, p. 381: from axes to the transposed index, whose bits are
/// then woven).
template <std::size_t N>
std::uint64_t place_on_curve(std::array<std::uint32_t, N> x, int levels) {
  for (std::uint32_t bit = 1U << (levels - 1); bit > 1; bit >>= 1) {
    for (std::uint32_t& axis : x) {
      const std::uint32_t below = bit - 1, exchanged = (axis & bit) != 0 ? below : (x[0] ^ axis) & below;
      x[0] ^= exchanged;
      if ((axis & bit) == 0) axis ^= exchanged;
    }
  }
  for (std::size_t c = 1; c < N; ++c) x[c] ^= x[c - 1];
  std::uint32_t turned = 0;
  for (std::uint32_t bit = 1U << (levels - 1); bit > 1; bit >>= 1)
    if ((x[N - 1] & bit) != 0) turned ^= bit - 1;
  std::uint64_t place = 0;
  for (int level = levels - 1; level >= 0; --level)
    for (const std::uint32_t axis : x) place = 2 * place + (((axis ^ turned) >> level) & 1U);
  return place;
}

/// Brings the nodes of a body bin by bin, the bins along Hilbert's curve, within a bin in the order that they have.
/// Bins are cubes (N = 3), or columns along the shortest side (N = 2), whose edge halves the longest side until a bin
/// has so many nodes at most, were all that the body's box takes filled alike.
template <std::size_t N>
void bin_along_curve(const Mesh& mesh, double bin_nodes, std::span<Index> nodes) {
  constexpr int most_levels = 16;
  const Bounds box = bounds_of(mesh, nodes);
  const std::array<std::size_t, 3> axes = longest_first(box.size());
  double edge = box.size()[axes[0]], bins = 1.0;
  int levels = 0;
  for (; static_cast<double>(nodes.size()) > bin_nodes * bins && levels < most_levels; ++levels) {
    edge *= 0.5;
    bins = 1.0;
    for (std::size_t c = 0; c < N; ++c) bins *= std::fmax(1.0, std::round(box.size()[axes[c]] / edge));
  }
  if (levels == 0 || !(edge > 0.0)) return;
  const std::uint32_t last = (1U << levels) - 1;
  std::vector<std::pair<std::uint64_t, Index>> keys;
  keys.reserve(nodes.size());
  for (const Index n : nodes) {
    std::array<std::uint32_t, N> bin_of{};
    for (std::size_t c = 0; c < N; ++c) {
      constexpr double on_border = 1e-6;
      const double along = (mesh.coordinates[at(n)][axes[c]] - box.low[axes[c]]) / edge + on_border;
      bin_of[c] = static_cast<std::uint32_t>(std::fmin(std::fmax(along, 0.0), last));
    }
    keys.emplace_back(place_on_curve(bin_of, levels), n);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = keys[i].second;
}

/// By body, true where at least half of the cells have the nodes of the cell before, each plus one: rows of a grid.
std::vector<bool> are_grids(const Mesh& mesh, std::span<const std::size_t> body_end) {
  std::vector<std::size_t> cells(body_end.size(), 0), straight(body_end.size(), 0);
  for (const CellBlock& block : mesh.blocks)
    for (Index c = 1; at(c) < block.size(); ++c) {
      const std::span<const Index> nodes = block.nodes(c), before = block.nodes(c - 1);
      const auto body = static_cast<std::size_t>(std::ranges::upper_bound(body_end, at(nodes[0])) - body_end.begin());
      ++cells[body];
      straight[body] += std::ranges::equal(nodes, before, [](Index a, Index b) { return a == b + 1; }) ? 1 : 0;
    }
  std::vector<bool> are(body_end.size());
  for (std::size_t body = 0; body < are.size(); ++body) are[body] = 2 * straight[body] >= cells[body];
  return are;
}

/// Nodes of a body that is near the processor in the order of its levels.
constexpr std::size_t small_body = 4096;

/// Larger bodies, numbered in levels, go on along a curve.
std::vector<Index> curve_order(const Mesh& mesh, std::span<const std::size_t> body_end) {
  constexpr double grid_bin = 16384.0, other_bin = 64.0;
  const std::vector<bool> is_grid = are_grids(mesh, body_end);
  std::vector<Index> order = first_entries(mesh.node_count());
  std::size_t first = 0;
  for (std::size_t body = 0; body < body_end.size(); first = body_end[body++]) {
    const std::span<Index> nodes = std::span(order).subspan(first, body_end[body] - first);
    if (nodes.size() <= small_body) continue;
    if (is_grid[body])
      bin_along_curve<2>(mesh, grid_bin, nodes);
    else
      bin_along_curve<3>(mesh, other_bin, nodes);
  }
  return order;
}

}  // namespace

Mesh renumbered(Mesh mesh) {
  if (!is_local(mesh)) reorder(grid_order(mesh), mesh);
  const LevelOrder::Result levels = LevelOrder(mesh).compute();
  reorder(levels.order, mesh);
  if (mesh.node_count() > small_body) reorder(curve_order(mesh, levels.body_end), mesh);
  return mesh;
}

}  // namespace carom
