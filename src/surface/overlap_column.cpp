#include "surface/overlap_column.hpp"

#include <cmath>

#include "math/vec3.hpp"
#include "surface/tangent_dual.hpp"

namespace carom {
namespace {

Bounds extent_of(const PlacedFacet& facet) {
  Bounds bounds;
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) bounds.include(facet.x[a]);
  return bounds;
}

}  // namespace

std::array<Vec3, 4> turn_of_normal(const PlacedFacet& facet, const FacetFrame& at_centre) {
  const ParentPoint centre = facet_centre(facet.size);
  const FacetShape shape = facet_shape(facet.size, centre.xi, centre.eta);
  const TangentDual dual = tangent_dual(at_centre.a_1, at_centre.a_2, at_centre.normal);
  std::array<Vec3, 4> turn{};
  for (std::size_t b = 0; b < 4; ++b)
    turn[b] = add(scaled(dual.dual_1, shape.dN_dxi[b]), scaled(dual.dual_2, shape.dN_deta[b]));
  return turn;
}

OverlapColumn::OverlapColumn(const PlacedFacet& facet) : placed_(facet), measure_(carom::measure(facet)) {
  const ParentPoint centre = facet_centre(facet.size);
  frame_ = facet_frame(facet, centre.xi, centre.eta);
  axis_1_ = normalized(frame_.a_1);
  axis_2_ = cross(frame_.normal, axis_1_);
  seen_ = seen(facet);
  extent_ = extent_of(seen_);
  if (facet.size > 2) shadow_ = Shadow(seen_);
}

PlacedFacet OverlapColumn::seen(const PlacedFacet& facet) const {
  PlacedFacet local{{}, facet.size};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a) {
    const Vec3 r = subtract(facet.x[a], frame_.position);
    local.x[a] = {dot(r, axis_1_), dot(r, axis_2_), dot(r, frame_.normal)};
  }
  return local;
}

bool OverlapColumn::may_overlap(const PlacedFacet& seen_facet, double reach) const {
  Bounds column = extent_;
  column.low[2] = -INFINITY;
  column.high[2] += reach;
  return column.overlaps(extent_of(seen_facet));
}

}  // namespace carom
