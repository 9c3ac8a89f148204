#include "surface/closest_point.hpp"

#include <algorithm>
#include <cmath>

#include "surface/side_point.hpp"

namespace carom {
namespace {

constexpr double tie = 1e-12;          // relative: the same point seen from two facets
constexpr double nearer = 1.0 - 1e-9;  // of a distance: less is that of another point

/// True when no other facet that counts goes on beyond the edge where p lies, or beyond an edge at the vertex where p
/// lies, of whichever facet there.
bool ends_at(const NodeQuery& query, Index f, const Projection& p) {
  const TargetSurface& surface = query.surface;
  const auto ends_at_edge = [&](Index of, Index a, Index b) {
    return std::ranges::none_of(surface.topology().at(a), [&](Index other) {
      return other != of && has_node(surface.facet(other), b) && query.counts(other);
    });
  };
  const Facet& facet = surface.facet(f);
  const auto k = static_cast<std::size_t>(p.feature);
  if (facet.size == 2) return ends_at_edge(f, facet[k], facet[k]);
  if (p.site == ProjectionSite::edge)
    return ends_at_edge(f, facet[k], facet[(k + 1) % static_cast<std::size_t>(facet.size)]);
  const Index vertex = facet[k];
  return std::ranges::any_of(surface.topology().at(vertex), [&](Index g) {
    if (!query.counts(g)) return false;
    const Facet& there = surface.facet(g);
    const auto size = static_cast<std::size_t>(there.size);
    const auto a = static_cast<std::size_t>(std::find(there.begin(), there.end(), vertex) - there.begin());
    return ends_at_edge(g, vertex, there[(a + 1) % size]) || ends_at_edge(g, there[(a + size - 1) % size], vertex);
  });
}

/// True when a neighbour at the edge or vertex where p lies comes nearer to the node: p is then no closest point of the
/// surface, though the neighbour may not count for its rim.
bool goes_on_nearer(const NodeQuery& query, Index f, const Projection& p) {
  return std::ranges::any_of(query.surface.topology().around(f, p), [&](Index g) {
    return g != f && query.counts(g) && query.projection_on(g).distance < p.distance * nearer;
  });
}

/// Takes facet f where it is nearer than the best so far, and counts there.
void consider(const NodeQuery& query, Index f, ClosestPoint& best) {
  const PlacedFacet facet = query.surface.placed(f);
  Projection p = project(facet, query.x);
  // On a common edge or corner the facet is taken that the point is seen from best.
  const bool is_tied = best.facet >= 0 && std::abs(p.distance - best.distance) <= tie * best.distance;
  if (is_tied ? std::abs(p.gap) <= std::abs(best.projection.gap) : !(p.distance < best.distance)) return;
  if (p.gap < 0.0 && query.is_too_deep(f, p.gap)) return;
  bool is_continued = false;
  std::optional<Rim> rim;
  if (p.site != ProjectionSite::interior && goes_on_nearer(query, f, p)) return;
  const bool is_beyond = p.site != ProjectionSite::interior && ends_at(query, f, p);
  if (is_beyond) {
    const ParentPoint at = perpendicular_foot(facet, query.x, {p.xi, p.eta});
    const FacetShape shape = facet_shape(facet.size, at.xi, at.eta);
    const FacetFrame frame = facet_frame(facet, shape);
    const double width = query.rim_width(f);
    is_continued = norm(subtract(frame.position, p.point)) <= width;
    if (!is_continued && p.gap < 0.0) return;
    const std::optional<SidePoint> side = p.gap < 0.0 ? side_at(query, f) : std::nullopt;
    if (side && side->at.gap >= 0.0 && query.surface.topology().goes_on(f, p)) return;
    if (is_continued) {
      if (query.range.fades && p.gap < 0.0 && (query.was_behind() || !side)) rim = Rim{p.point, p.N, width};
      p.xi = at.xi;
      p.eta = at.eta;
      p.N = shape.N;
      p.point = frame.position;
      p.a_1 = frame.a_1;
      p.a_2 = frame.a_2;
      p.normal = frame.normal;
      p.gap = dot(subtract(query.x, frame.position), frame.normal);
    }
  }
  best = {p.distance, f, p, is_continued, is_beyond && !is_continued, rim};
}

}  // namespace

ClosestPoint closest_point(const NodeQuery& query) {
  ClosestPoint best{std::nextafter(query.range.reach, INFINITY)};
  Index nearest = -1;
  double bound = best.distance * best.distance;
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const double d = query.box_distance[i];
    if (d >= bound || !query.counts(query.candidates[i])) continue;
    bound = d;
    nearest = query.candidates[i];
  }
  if (nearest >= 0) consider(query, nearest, best);
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const Index f = query.candidates[i];
    if (f == nearest || query.box_distance[i] > (1.0 + 4.0 * tie) * best.distance * best.distance) continue;
    if (query.counts(f)) consider(query, f, best);
  }
  return best;
}

ClosestPoint followed_point(const NodeQuery& query, Index from) {
  Index f = from;
  Projection p = query.projection_on(f);
  ClosestPoint best{INFINITY};
  for (std::size_t hops = 0; hops < query.surface.facets().size(); ++hops) {
    consider(query, f, best);
    if (p.site == ProjectionSite::interior) return best;
    const Index last = f;
    for (const Index g : query.surface.topology().around(last, p)) {
      if (!query.counts(g)) continue;
      consider(query, g, best);
      const Projection there = query.projection_on(g);
      if (!(there.distance < p.distance * nearer)) continue;
      f = g;
      p = there;
    }
    if (f == last) return best;
  }
  return best;
}

}  // namespace carom
