#include "mesh/cell_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "element/hexa8.hpp"
#include "element/quad4.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

namespace {

/// Area vector of a face, by the right-hand rule of its corners.
Vec3 area_vector(const CellFace& face, std::span<const Vec3> x) {
  const auto n = face.corners();
  if (n.size() == 3) {
    const Vec3 twice = cross(subtract(x[n[1]], x[n[0]]), subtract(x[n[2]], x[n[0]]));
    return {0.5 * twice[0], 0.5 * twice[1], 0.5 * twice[2]};
  }
  const Vec3 twice = cross(subtract(x[n[2]], x[n[0]]), subtract(x[n[3]], x[n[1]]));
  return {0.5 * twice[0], 0.5 * twice[1], 0.5 * twice[2]};
}

double longest_edge(CellType type, std::span<const Vec3> x) {
  double longest = 0.0;
  for (const auto& edge : cell_edges(type)) longest = std::max(longest, norm(subtract(x[edge[1]], x[edge[0]])));
  return longest;
}

/// Volume (the third of the sum of the faces' distances from a node times their areas) over the largest face; those of
/// pentahedra that are not triangles count half, since the height of a prism above them is that of its triangle.
double height(CellType type, std::span<const Vec3> x) {
  double volume = 0.0, largest = 0.0;
  for (const CellFace& face : cell_faces(type)) {
    const Vec3 area = area_vector(face, x);
    Vec3 centre{};
    for (const LocalNode a : face.corners()) centre = add(centre, subtract(x[a], x[0]));
    volume += dot(centre, area) / (3.0 * static_cast<double>(face.corners().size()));
    const bool has_edge_opposite = corner_count(type) == 6 && face.corners().size() == 4;
    largest = std::max(largest, (has_edge_opposite ? 0.5 : 1.0) * norm(area));
  }
  return volume / largest;
}

double corner_length(CellType type, std::span<const Vec3> x) {
  const int corners = corner_count(type);
  if (dimension(type) == 1) return norm(subtract(x[1], x[0]));
  if (corners == 3) return 2.0 * norm(area_vector({CellType::tria3, {0, 1, 2}}, x)) / longest_edge(type, x);
  if (dimension(type) == 2) return quad4::area({x[0], x[1], x[2], x[3]}) / longest_edge(type, x);
  if (corners == 8) return hexa8::length({x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]});
  return (corners == 6 ? 1.0 : 3.0) * height(type, x);
}

}  // namespace

double cell_length(CellType type, std::span<const Vec3> x) {
  const bool has_middles = node_count(type) > corner_count(type);
  return (has_middles ? 0.5 : 1.0) * corner_length(type, x);
}

}  // namespace carom
