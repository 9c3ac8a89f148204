#include "surface/met_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "surface/side_point.hpp"

namespace carom {
namespace {

constexpr double pointed = 0.5;       // product of the normals of a tip and of the sides that it points between
constexpr double alike_share = 0.25;  // of the width: how unlike gaps of facets that share a node may be

/// Distances of a node from facet f and from its plane, from which both weights are made, are apart by `alike` at most.
double alike(const NodeQuery& query, Index f) {
  return alike_share * query.range.width[f];
}

/// At what distance from facet f a node has no foot on it, its least distance from the surface given.
double farthest_foot(const NodeQuery& query, Index f, double least) {
  return least + query.range.width[f] + alike(query, f);
}

/// The node's foot on the plane of facet f, its weight that of how far it lies beyond the facet's edges.
FacetFoot foot_on(const NodeQuery& query, Index f, const Projection& p) {
  FacetFoot out = foot_at(f, p, p.normal, p.gap);
  if (p.site == ProjectionSite::interior) return out;
  const double width = query.range.width[f];
  const PlacedFacet facet = query.surface.placed(f);
  const ParentPoint at = perpendicular_foot(facet, query.x, {p.xi, p.eta});
  const FacetShape shape = facet_shape(facet.size, at.xi, at.eta);
  const FacetFrame frame = facet_frame(facet, shape);
  out.xi = at.xi;
  out.eta = at.eta;
  out.N = shape.N;
  out.a_1 = frame.a_1;
  out.a_2 = frame.a_2;
  out.normal = out.facet_normal = frame.normal;
  out.gap = dot(subtract(query.x, frame.position), frame.normal);
  const double rest = 1.0 - std::max(0.0, p.distance * p.distance - out.gap * out.gap) / (width * width);
  const double inside = norm(subtract(frame.position, p.point)) > 2.0 * width ? 0.0 : std::max(0.0, rest);
  out.weight = inside * inside;
  const double slope = -4.0 * inside / (width * width);  // of the weight in (d_f^2 - g_f^2) / 2
  out.of_weight = {scaled(out.normal, -slope * out.gap), scaled(subtract(query.x, p.point), slope)};
  return out;
}

/// The feet on all facets about the closest point; none where that lies on an edge too sharp to go round.
void feet_around(const NodeQuery& query, const ClosestPoint& best, std::vector<FacetFoot>& feet) {
  feet.clear();
  const TargetSurface& surface = query.surface;
  if (query.range.width.empty() || surface.facet(best.facet).size == 1 || best.is_beside) return;
  const Vec3 normal = surface.normal(best.facet);
  const auto is_beside_tip = [&](Index f) {
    return surface.facet(f).size == 2 && dot(surface.normal(f), query.normal) < -pointed;
  };
  const bool is_tip = best.projection.site == ProjectionSite::interior && is_beside_tip(best.facet);
  const auto agrees = [&](Index f) {
    return dot(surface.normal(f), normal) > NodeQuery::smooth || (is_tip && is_beside_tip(f));
  };
  if (best.projection.site != ProjectionSite::interior && !best.is_continued) {
    const SurfaceTopology& topology = surface.topology();
    const auto is_sharp = [&](Index f) {
      return topology.is_at(f, best.facet, best.projection) && query.counts(f) && !agrees(f);
    };
    if (std::ranges::any_of(topology.around(best.facet, best.projection), is_sharp)) return;
  }
  feet.push_back(foot_on(query, best.facet, best.is_continued ? query.projection_on(best.facet) : best.projection));
  double sum = feet.front().weight;
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const Index f = query.candidates[i];
    const double most = farthest_foot(query, f, best.distance);
    if (f == best.facet || query.box_distance[i] >= most * most || !agrees(f) || !query.counts(f)) continue;
    const Projection p = query.projection_on(f);
    if (p.distance >= most || (p.gap < 0.0 && query.is_too_deep(f, p.gap))) continue;
    FacetFoot one = foot_on(query, f, p);
    if (!(one.weight > 0.0) || !fade_unlike(one, alike(query, f), feet.front())) continue;
    sum += one.weight;
    feet.push_back(one);
  }
  if (!(sum > 0.0)) feet.clear();
}

}  // namespace

bool meets(const NodeQuery& query, const ClosestPoint& best, SurfacePoint& point) {
  if (best.facet < 0) return false;
  const Projection& p = best.projection;
  SignedDistance at{p.normal, p.gap};
  if (!best.is_continued && p.site != ProjectionSite::interior)
    at = signed_distance(p, query.x, query.surface.pseudonormal(best.facet, p), query.range.tiny());
  // Beside a rim a node is behind some of the facets there and in front of others, and touches none of them.
  if (best.is_beside && at.gap < 0.0) return false;
  if (at.gap < 0.0 && query.is_too_deep(best.facet, at.gap)) return false;
  double outside = 0.0;  // by how much the gap is below that of the body as it is
  const bool is_from_side = at.gap < 0.0 && !query.was_behind();
  if (const std::optional<SidePoint> side = is_from_side ? side_at(query, best.facet) : std::nullopt) {
    constexpr double round_off = 1e-6;  // of the slack
    if (side->at.gap >= 0.0) return false;
    if (side->at.gap > at.gap) {
      take_only(side->facet, side->projection, side->at, point);
      point.facet = -1;  // it has come through the front of none
      point.rounded = std::min(-side->at.gap, side->slack);
      return true;
    }
    if (side->at.gap + side->slack > round_off * side->slack) outside = -at.gap;
  }
  feet_around(query, best, point.feet);
  if (point.feet.empty()) {
    take_only(best.facet, p, at, point);
    point.rounded = outside;
    if (best.rim) fade(best.facet, p, *best.rim, query.x, point);
    return true;
  }
  take_mean(point);
  point.facet = best.facet;
  point.rounded = std::max({0.0, at.gap - point.gap, outside == 0.0 ? 0.0 : -point.gap});
  if (best.rim && point.gap < 0.0) fade(best.facet, p, *best.rim, query.x, point);
  return true;
}

}  // namespace carom
