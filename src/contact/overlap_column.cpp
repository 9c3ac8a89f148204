#include "contact/overlap_column.hpp"

#include <cmath>
#include <optional>

#include "contact/facet_projection.hpp"
#include "contact/pair_rows.hpp"
#include "math/vec3.hpp"

namespace carom {

std::array<Vec3, 4> turn_of_normal(const PlacedFacet& facet, const FacetFrame& at_centre) {
  const ParentPoint centre = facet_centre(facet.size);
  const FacetShape shape = facet_shape(facet.size, centre.xi, centre.eta);
  const TangentDual dual = tangent_dual(at_centre.a_1, at_centre.a_2, at_centre.normal);
  std::array<Vec3, 4> turn{};
  for (std::size_t b = 0; b < 4; ++b)
    turn[b] = add(scaled(dual.dual_1, shape.dN_dxi[b]), scaled(dual.dual_2, shape.dN_deta[b]));
  return turn;
}

OverlapColumn::OverlapColumn(const PlacedFacet& facet) : placed(facet) {
  const ParentPoint centre = facet_centre(facet.size);
  frame = facet_frame(facet, centre.xi, centre.eta);
  axis_1 = normalized(frame.a_1);
  axis_2 = cross(frame.normal, axis_1);
  extent = extent_of(facet);
}

Bounds OverlapColumn::extent_of(const PlacedFacet& facet) const {
  Bounds bounds;
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    const Vec3 r = subtract(facet.x[a], frame.position);
    bounds.include(Vec3{dot(r, axis_1), dot(r, axis_2), dot(r, frame.normal)});
  }
  return bounds;
}

bool OverlapColumn::may_overlap(const PlacedFacet& other, double reach) const {
  Bounds column = extent;
  column.low[2] = -INFINITY;
  column.high[2] += reach;
  return column.overlaps(extent_of(other));
}

void hide_layers(const OverlapColumn& column, std::span<const ColumnMaster> masters,
                 std::vector<OverlapPoint>& points) {
  for (const ColumnMaster& own : masters) {
    for (std::size_t q = own.begin; q < own.end; ++q) {
      const Vec3 x = facet_position(column.placed, points[q].slave.xi, points[q].slave.eta);
      for (const ColumnMaster& other : masters) {
        if (other.facet == own.facet) continue;
        const std::optional<RayHit> hit = intersect(other.placed, x, column.normal());
        if (hit && std::abs(hit->distance) < std::abs(points[q].gap)) points[q].weight = 0.0;
      }
    }
  }
}

bool is_in_front(const PlacedFacet& slave, const PlacedFacet& master, const OverlapPoint& point, double size) {
  constexpr double round_off = 1e-9;  // bodies that touch each other at the start are in front of each other
  const Vec3 way = subtract(facet_position(master, point.master.xi, point.master.eta),
                            facet_position(slave, point.slave.xi, point.slave.eta));
  return dot(way, facet_frame(slave, point.slave.xi, point.slave.eta).normal) >= -round_off * size;
}

}  // namespace carom
