// A facet: one piece of the boundary of a body.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom {

/// Boundary piece of a cell, in the mesh's node numbers: a point (the end of a bar), a segment (an edge of a plane
/// cell), a triangle or a quadrilateral. The outward normal follows from the order of the nodes: the right-hand rule
/// for triangles and quadrilaterals; for a segment in the x-y plane from node 0 to node 1 it is (dy, -dx), so that the
/// body lies on the left, as it does on the edges of a cell that is numbered counter-clockwise. A point has no normal
/// of its own.
struct Facet {
  std::array<Index, 4> node{-1, -1, -1, -1};
  int size = 0;  ///< number of nodes: 1, 2, 3 or 4

  const Index* begin() const { return node.data(); }
  const Index* end() const { return node.data() + size; }
  Index operator[](std::size_t a) const { return node[a]; }
  friend bool operator==(const Facet&, const Facet&) = default;
};

}  // namespace carom
