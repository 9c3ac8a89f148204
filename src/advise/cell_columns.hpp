// Columns of cells from one side of a body to the opposite one.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "math/vec3.hpp"
#include "mesh/facet.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Cells in a row from skin to skin, passed through opposite faces (edges in the plane).
struct CellColumn {
  int cells = 0;
  double length = std::numeric_limits<double>::infinity();  ///< along the middles of the faces
  Vec3 direction{};                                         ///< unit vector from the first face to the last
  Facet first, last;                                        ///< its faces on the skin, unordered in their sense
};

/// The columns of the solid's hexahedra (three through each cell) and quadrilaterals (two). Parts that share nodes are
/// one body.
class CellColumns {
 public:
  CellColumns(const Mesh& mesh, const Solid& solid);

  /// The column of cell k (of Solid::cells()) along its axis 0, 1 or 2; endless (infinite length) where it closes in
  /// itself, as around a ring. Only for axes below dimension(k).
  const CellColumn& column(std::size_t k, int axis) const {
    const Index c = of_cell_[k][static_cast<std::size_t>(axis)];
    return c < 0 ? endless_ : columns_[static_cast<std::size_t>(c)];
  }
  /// 3 for hexahedra, 2 for quadrilaterals, 0 for all others, which have no columns.
  int dimension(std::size_t k) const;
  /// Length of cell k along an axis, between the middles of its two faces there, and the unit vector from one to the
  /// other.
  double length(std::size_t k, int axis) const;
  Vec3 direction(std::size_t k, int axis) const;

 private:
  using Side = std::size_t;  ///< 6 k + side of cell k
  void walk(Side start);
  Facet facet(Side side) const;
  Vec3 middle(Side side) const;

  const Mesh& mesh_;
  const BodyCells& cells_;
  std::vector<std::uint32_t> neighbour_;  ///< per side: the side of the next cell that is the same face, or no_twin
  std::vector<std::array<Index, 3>> of_cell_;
  std::vector<CellColumn> columns_;
  CellColumn endless_;
};

}  // namespace carom
