// The corners of a cell and the edges that meet there.
#pragma once

#include <array>
#include <span>

#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

/// The corners of a solid (corner_frames); of a plane cell those with two neighbours, the corner itself standing for
/// the third, which is the direction z. Cells of second order have those of linear ones. Empty for points and lines.
std::span<const CornerFrame> cell_corners(CellType type);

/// From a corner to its neighbours, x(node) being where they are.
struct CornerEdges {
  std::array<Vec3, 3> edge{};

  template <class Positions>
  CornerEdges(const CornerFrame& frame, const Positions& x) {
    const Vec3 from = x(frame.corner);
    edge = {subtract(x(frame.a), from), subtract(x(frame.b), from),
            frame.c == frame.corner ? Vec3{0.0, 0.0, 1.0} : subtract(x(frame.c), from)};
  }

  /// What the edges span: a volume, of plane cells an area.
  double volume() const { return dot(cross(edge[0], edge[1]), edge[2]); }
  /// False where it is no more than rounding, as meshes are read (mesh/orientation.cpp).
  bool has_volume() const { return volume() > 1e-10 * norm(edge[0]) * norm(edge[1]) * norm(edge[2]); }
};

}  // namespace carom
