#include "surface/crossed_facet.hpp"

#include <array>
#include <cmath>

namespace carom {
namespace {

/// Where the node has met facet f from the front, as a fraction of the step; nothing where it has not.
std::optional<double> crossing_time(const NodeQuery& query, Index f) {
  const TargetSurface& surface = query.surface;
  const std::span<const Vec3> displacement = surface.motion().displacement;
  const Facet& facet = surface.facet(f);
  const ParentPoint centre = facet_centre(facet.size);
  std::array<double, 4> N = facet_shape(facet.size, centre.xi, centre.eta).N;
  std::optional<RayHit> hit;
  double way = 0.0;
  for (int i = 0; i < 3; ++i) {  // the facet's motion is that of the point that is hit
    Vec3 motion = displacement[query.node];
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
      motion = subtract(motion, scaled(displacement[facet[a]], N[a]));
    way = norm(motion);
    if (!(way > 0.0) || dot(motion, surface.normal(f)) >= 0.0) return std::nullopt;
    hit = intersect(surface.placed(f), subtract(query.x, motion), scaled(motion, 1.0 / way), 1e-6);
    if (!hit) return std::nullopt;
    N = facet_shape(facet.size, hit->xi, hit->eta).N;
  }
  if (hit->distance < -query.range.tiny() || hit->distance > way) return std::nullopt;
  return hit->distance / way;
}

}  // namespace

std::optional<Index> crossed_facet(const NodeQuery& query) {
  std::optional<Index> first;
  double least = INFINITY;
  for (const Index f : query.candidates) {
    if (!query.counts(f)) continue;
    const std::optional<double> time = crossing_time(query, f);
    if (!time || *time >= least) continue;
    least = *time;
    first = f;
  }
  return first;
}

}  // namespace carom
