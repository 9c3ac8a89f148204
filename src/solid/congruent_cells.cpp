#include "solid/congruent_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include "base/types.hpp"

namespace carom {
namespace {

/// Places of the nodes about the first one in units of 2^-36 of the size, rounded down to a power of two, and that
/// power.
struct Shape {
  std::array<std::int64_t, 3 * most_nodes> place{};
  int exponent = 0;
  friend bool operator==(const Shape&, const Shape&) = default;
};

struct HashShape {
  std::size_t operator()(const Shape& shape) const {
    std::uint64_t hash = static_cast<std::uint64_t>(shape.exponent);
    for (const std::int64_t place : shape.place)
      hash = (hash ^ static_cast<std::uint64_t>(place)) * 0x9e3779b97f4a7c15U, hash ^= hash >> 29U;
    return hash;
  }
};

Shape shape_of(const CellNodes& x, std::size_t nodes) {
  double size = 0.0;
  for (std::size_t a = 1; a < nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) size = std::max(size, std::abs(x[a][i] - x[0][i]));
  Shape shape;
  std::frexp(size, &shape.exponent);
  const double scale = std::ldexp(1.0, 36 - shape.exponent);
  for (std::size_t a = 1; a < nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) shape.place[3 * a + i] = std::llrint((x[a][i] - x[0][i]) * scale);
  return shape;
}

}  // namespace

CongruentCells congruent_cells(const SolidCells& solid, const Block& block, Index first, Index count) {
  CongruentCells cells;
  cells.of.resize(at(count));
  if (block.is_ring || block.cell_stages != nullptr) {
    cells.first.resize(at(count));
    std::iota(cells.first.begin(), cells.first.end(), std::size_t{0});
    cells.of = cells.first;
    return cells;
  }
  std::unordered_map<Shape, std::size_t, HashShape> known;
  for (std::size_t k = 0; k < at(count); ++k) {
    const Shape shape = shape_of(solid.coordinates_of(at(block.first + first) + k), block.nodes());
    const auto [found, is_new] = known.try_emplace(shape, cells.first.size());
    if (is_new) cells.first.push_back(k);
    cells.of[k] = found->second;
  }
  return cells;
}

}  // namespace carom
