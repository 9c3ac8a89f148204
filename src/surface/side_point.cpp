#include "surface/side_point.hpp"

namespace carom {

std::optional<SidePoint> side_at(const NodeQuery& query, Index f) {
  if (query.stays_behind(f) || !query.has_normal()) return std::nullopt;
  if (query.projection_at_begin(f).gap >= 0.0) return std::nullopt;
  const TargetSurface& surface = query.surface;
  SidePoint side;
  for (const Index n : surface.facet(f))
    for (const Index g : surface.topology().at(n)) {
      if (g == f || g == side.facet || query.counts(g) || query.is_excluded(g)) continue;
      const Projection p = query.projection_on(g);
      if (side.facet >= 0 && p.distance >= side.projection.distance) continue;
      side.facet = g;
      side.projection = p;
    }
  if (side.facet < 0) return std::nullopt;
  const Projection& p = side.projection;
  side.at = p.site == ProjectionSite::interior
                ? SignedDistance{p.normal, p.gap}
                : signed_distance(p, query.x, surface.pseudonormal(side.facet, p), query.range.tiny());
  if (query.moves_sides_out) side.slack = SearchRange::side_slack / SearchRange::rim_slack * query.rim_width(f);
  side.at.gap -= side.slack;
  return side;
}

}  // namespace carom
