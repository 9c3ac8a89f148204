// How large a cell is, as one length.
#pragma once

#include <span>

#include "mesh/mesh.hpp"

namespace carom {

/// The length that stands for the size of a cell with corners at the first positions: that of a line; the area over the
/// longest edge of quadrilaterals, twice that of triangles (their least height); the volume over the largest face of
/// hexahedra, three times that of tetrahedra and pyramids (their least height, or the height above the base); the least
/// height of pentahedra. Half of it where the cell has nodes between its corners.
double cell_length(CellType type, std::span<const Vec3> x);

}  // namespace carom
