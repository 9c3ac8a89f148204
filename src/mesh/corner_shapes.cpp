#include "mesh/corner_shapes.hpp"

namespace carom {

std::span<const CornerFrame> cell_corners(CellType type) {
  static constexpr std::array<CornerFrame, 3> of_triangles{{{0, 1, 2, 0}, {1, 2, 0, 1}, {2, 0, 1, 2}}};
  static constexpr std::array<CornerFrame, 4> of_quadrilaterals{
      {{0, 1, 3, 0}, {1, 2, 0, 1}, {2, 3, 1, 2}, {3, 0, 2, 3}}};
  if (dimension(type) == 2) {
    if (corner_count(type) == 3) return of_triangles;
    return of_quadrilaterals;
  }
  return corner_frames(type);
}

}  // namespace carom
