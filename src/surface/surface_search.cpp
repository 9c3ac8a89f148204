#include "surface/surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "math/vec3.hpp"
#include "surface/crossed_facet.hpp"
#include "surface/met_point.hpp"

namespace carom {
namespace {

double squared_distance(const Bounds& box, const Vec3& x) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double d = std::max(std::max(box.low[c] - x[c], x[c] - box.high[c]), 0.0);
    sum += d * d;
  }
  return sum;
}

std::vector<Facet> as_points(std::span<const Index> nodes) {
  std::vector<Facet> points;
  for (const Index n : nodes) points.push_back({{n, -1, -1, -1}, 1});
  return points;
}

/// Above the numbers of all nodes.
std::size_t node_count(std::span<const Index> nodes, std::span<const Facet> own, std::span<const Facet> facets) {
  Index last = -1;
  for (const Index n : nodes) last = std::max(last, n);
  for (const std::span<const Facet> all : {facets, own})
    for (const Facet& facet : all)
      for (const Index n : facet) last = std::max(last, n);
  return static_cast<std::size_t>(last) + 1;
}

/// The largest length of the nodes' displacements.
double largest(std::span<const Vec3> displacement, std::span<const Index> nodes) {
  double squared = 0.0;
  for (const Index n : nodes) squared = std::max(squared, dot(displacement[n], displacement[n]));
  return std::sqrt(squared);
}

}  // namespace

SurfaceSearch::SurfaceSearch(std::vector<Index> nodes, std::vector<Facet> own, std::vector<Facet> facets,
                             SearchRange range)
    : nodes_(std::move(nodes)),
      range_(std::move(range)),
      broad_phase_(as_points(nodes_), std::move(facets), range_.reach, range_.margin),
      surface_(broad_phase_.targets(), node_count(nodes_, own, broad_phase_.targets())),
      normals_(nodes_, std::move(own), surface_.topology().node_count()),
      excluded_(surface_.topology().neighbours(nodes_, normals_.own())),
      least_depth_(range_.depth.empty() ? 0.0 : *std::ranges::min_element(range_.depth)) {}

void SurfaceSearch::update(std::span<const Vec3> x_begin, std::span<const Vec3> x, std::span<const Vec3> displacement,
                           std::vector<Index> behind) {
  surface_.move_to({x_begin, x, displacement});
  broad_phase_.update(x_begin, displacement);
  behind_ = std::move(behind);
  const bool none_is_behind = std::ranges::all_of(behind_, [](Index f) { return f < 0; });
  if (broad_phase_.pair_count() == 0 && none_is_behind) return;
  if (active_since_ != broad_phase_.builds()) {
    active_since_ = broad_phase_.builds();
    surface_.choose_active(broad_phase_);
    normals_.choose(broad_phase_);
  }
  surface_.place_active();
  normals_.move_to(x);
  is_fast_ = largest(displacement, nodes_) + largest(displacement, surface_.topology().nodes()) > 0.25 * least_depth_;
}

/// The candidates, those of one body after those of another.
std::span<const Index> SurfaceSearch::by_body(std::span<const Index> candidates, Space& space) const {
  const auto body = [this](Index f) { return body_of(f); };
  if (std::ranges::is_sorted(candidates, {}, body)) return candidates;
  space.candidates.assign(candidates.begin(), candidates.end());
  std::ranges::stable_sort(space.candidates, {}, body);
  return space.candidates;
}

/// What the node in place q looks for among the candidates, with what it was behind.
NodeQuery SurfaceSearch::query_of(std::size_t q, std::span<const Index> candidates, Index behind, Space& space) const {
  const Vec3& x = surface_.motion().x[nodes_[q]];
  space.box_distance.resize(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    space.box_distance[i] = squared_distance(surface_.bounds(candidates[i]), x);
  NodeQuery query{.surface = surface_,
                  .range = range_,
                  .excluded = excluded_[q],
                  .node = nodes_[q],
                  .x = x,
                  .normal = normals_.at(q),
                  .candidates = candidates,
                  .box_distance = space.box_distance,
                  .behind = behind,
                  .moves_sides_out = range_.moves_sides_out || behind_.empty()};
  if (behind >= 0 && !query.counts(behind)) query.behind = -1;
  return query;
}

/// What the query meets of each body, the least gap of all in space.found; false: nothing.
bool SurfaceSearch::find_nearest(const NodeQuery& query, Space& space) const {
  bool is_found = false;
  for (std::size_t begin = 0, end = 0; begin < query.candidates.size(); begin = end) {
    const Index body = body_of(query.candidates[begin]);
    while (end < query.candidates.size() && body_of(query.candidates[end]) == body) ++end;
    NodeQuery one = query;
    one.candidates = query.candidates.subspan(begin, end - begin);
    one.box_distance = query.box_distance.subspan(begin, end - begin);
    if (query.was_behind() && body_of(query.behind) != body) one.behind = -1;
    if (!meets(one, closest_point(one), is_found ? space.other : space.found)) continue;
    if (is_found && space.other.gap < space.found.gap) std::swap(space.found, space.other);
    is_found = true;
  }
  return is_found;
}

const SurfacePoint* SurfaceSearch::find(std::size_t q, Space& space) const {
  const Index behind = behind_.empty() ? -1 : behind_[q];
  const std::span<const Index> near = broad_phase_.targets_of(q);
  if (behind < 0 && near.empty()) return nullptr;
  NodeQuery query = query_of(q, by_body(near, space), behind, space);
  const bool is_found = find_nearest(query, space);
  if (is_found && space.found.gap < 0.0) return &space.found;
  if (query.was_behind()) {
    query.is_behind = true;
    if (meets(query, followed_point(query, behind), space.other) && space.other.gap < 0.0) return &space.other;
  }
  if (is_fast_) {
    if (const std::optional<Index> crossed = crossed_facet(query)) {
      const Projection p = query.projection_on(*crossed);
      SignedDistance at{p.normal, p.gap};
      if (p.site != ProjectionSite::interior) at = {scaled(subtract(p.point, query.x), 1.0 / p.distance), -p.distance};
      take_only(*crossed, p, at, space.other);
      return &space.other;
    }
  }
  return is_found ? &space.found : nullptr;
}

std::vector<SurfacePoint> SurfaceSearch::other_sides(std::size_t q, const SurfacePoint& met, Space& space) const {
  if (!(met.gap < 0.0)) return {};
  const Index body = body_of(met.feet.front().facet);
  space.candidates.clear();
  for (const Index f : broad_phase_.targets_of(q))
    if (body_of(f) == body) space.candidates.push_back(f);
  const Index behind = behind_.empty() || behind_[q] < 0 || body_of(behind_[q]) != body ? -1 : behind_[q];
  const NodeQuery query = query_of(q, space.candidates, behind, space);
  const auto go_on = [this](Index f, Index g) {
    return dot(surface_.normal(f), surface_.normal(g)) > NodeQuery::smooth;  // as feet_around has it
  };
  std::vector<ClosestPoint> near;
  for (const Index f : query.candidates) {
    if (facets()[f].size == 2) continue;
    const Projection p = query.projection_on(f);
    if (p.site == ProjectionSite::interior && p.gap < 0.0 && p.gap > 2.0 * met.gap && !go_on(f, met.feet.front().facet))
      near.push_back({p.distance, f, p});
  }
  std::ranges::stable_sort(near, {}, &ClosestPoint::distance);
  std::vector<SurfacePoint> sides;
  for (const ClosestPoint& at : near) {
    const Projection& p = at.projection;
    const auto goes_on = [&](const SurfacePoint& side) { return go_on(at.facet, side.feet.front().facet); };
    if (std::ranges::any_of(sides, goes_on)) continue;
    const bool is_mean = query.counts(at.facet) && meets(query, at, space.side) && space.side.facet == at.facet;
    if (!is_mean) take_only(at.facet, p, {p.normal, p.gap}, space.side);
    sides.push_back(space.side);
  }
  return sides;
}

}  // namespace carom
