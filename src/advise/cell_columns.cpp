#include "advise/cell_columns.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/types.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/face_twins.hpp"

namespace carom {

namespace {

/// Corners of the sides of a cell: 2 axis and 2 axis + 1 lie opposite to each other. In the plane edges, -1 for none.
constexpr int none = -1;
constexpr std::array<std::array<int, 4>, 6> hexa_sides{
    {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}};
constexpr std::array<std::array<int, 4>, 6> quad_sides{{{0, 3, none, none},
                                                        {1, 2, none, none},
                                                        {0, 1, none, none},
                                                        {3, 2, none, none},
                                                        {none, none, none, none},
                                                        {none, none, none, none}}};

}  // namespace

CellColumns::CellColumns(const Mesh& mesh, const Solid& solid) : mesh_(mesh), cells_(solid.cells()) {
  const auto key_of = [this](Side side) {
    if (side % 6 >= 2 * at(dimension(side / 6))) return no_face;
    const Facet f = facet(side);
    return face_key({f.begin(), f.end()});
  };
  neighbour_ = face_twins(6 * cells_.size(), 6, key_of, mesh_.node_count());
  of_cell_.assign(cells_.size(), {none, none, none});
  for (std::size_t k = 0; k < cells_.size(); ++k) {
    for (int axis = 0; axis < dimension(k); ++axis) {
      for (const Side side : {6 * k + 2 * at(axis), 6 * k + 2 * at(axis) + 1})
        if (neighbour_[side] == no_twin && of_cell_[k][at(axis)] < 0) walk(side);
    }
  }
}

int CellColumns::dimension(std::size_t k) const {
  switch (mesh_.blocks[at(cells_[k].block)].type) {
    case CellType::hexa8:
    case CellType::hexa20:
    case CellType::hexa27:
      return 3;
    case CellType::quad4:
    case CellType::quad8:
      return 2;
    default:
      return 0;
  }
}

Facet CellColumns::facet(Side side) const {
  const CellRef& cell = cells_[side / 6];
  const std::span<const Index> nodes = mesh_.blocks[at(cell.block)].nodes(cell.cell);
  Facet facet;
  for (const int local : (dimension(side / 6) == 3 ? hexa_sides : quad_sides)[side % 6])
    if (local != none) facet.node[at(facet.size++)] = nodes[at(local)];
  return facet;
}

Vec3 CellColumns::middle(Side side) const {
  const Facet f = facet(side);
  Vec3 sum{};
  for (const Index n : f) sum = add(sum, mesh_.coordinates[at(n)]);
  return scaled(sum, 1.0 / f.size);
}

double CellColumns::length(std::size_t k, int axis) const {
  const Side side = 6 * k + 2 * at(axis);
  return norm(subtract(middle(side + 1), middle(side)));
}

Vec3 CellColumns::direction(std::size_t k, int axis) const {
  const Side side = 6 * k + 2 * at(axis);
  return normalized(subtract(middle(side + 1), middle(side)));
}

void CellColumns::walk(Side start) {
  CellColumn column{0, 0.0, {}, facet(start), {}};
  Side side = start, opposite = start ^ 1U;
  const Vec3 first = middle(start);
  Vec3 last = first;
  for (;;) {
    of_cell_[side / 6][side % 6 / 2] = static_cast<Index>(columns_.size());
    ++column.cells;
    opposite = side / 6 * 6 + ((side % 6) ^ 1U);
    const Vec3 next = middle(opposite);
    column.length += norm(subtract(next, last));
    last = next;
    if (neighbour_[opposite] == no_twin || at(static_cast<Index>(column.cells)) > cells_.size()) break;
    side = neighbour_[opposite];
  }
  column.last = facet(opposite);
  const Vec3 way = subtract(last, first);
  if (norm(way) > 0.0) column.direction = scaled(way, 1.0 / norm(way));
  columns_.push_back(column);
}

}  // namespace carom
