#include "surface/surface_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "surface/surface_point.hpp"

namespace carom {
namespace {

constexpr double rim_slack = 0.1;          // of the facet's size: continuation beyond a rim
constexpr double side_slack = 0.02;        // of the facet's size: how far sides that do not count are moved out
constexpr double no_longer_opposed = 0.5;  // product of the normals of a node and of a facet that it was behind
constexpr double smooth = 0.5;             // product of the normals of facets that pass a node on to each other
constexpr double pointed = 0.5;            // product of the normals of a tip and of the sides that it points between
constexpr double alike_share = 0.25;       // of the width: how unlike gaps of facets that share a node may be
constexpr double tie = 1e-12;              // relative: the same point seen from two facets
constexpr double tiny = 1e-6;              // of the reach: below, the direction to a corner is round-off

double squared_distance(const Bounds& box, const Vec3& x) {
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double d = std::max(std::max(box.low[c] - x[c], x[c] - box.high[c]), 0.0);
    sum += d * d;
  }
  return sum;
}

/// Normal at the centre times area or length; zero for a point.
Vec3 area_vector(const PlacedFacet& facet) {
  const auto& x = facet.x;
  if (facet.size == 4) return scaled(cross(subtract(x[2], x[0]), subtract(x[3], x[1])), 0.5);
  if (facet.size == 3) return scaled(cross(subtract(x[1], x[0]), subtract(x[2], x[0])), 0.5);
  if (facet.size == 2) return {x[1][1] - x[0][1], x[0][0] - x[1][0], 0.0};
  return {};
}

double size_of(const PlacedFacet& facet) {
  const double extent = measure(facet);
  return facet.size == 2 ? extent : std::sqrt(extent);
}

bool contains(const Facet& facet, Index node) {
  return std::find(facet.begin(), facet.end(), node) != facet.end();
}

}  // namespace

std::vector<double> edge_widths(std::span<const Vec3> coordinates, std::span<const Facet> facets) {
  std::vector<double> widths;
  for (const Facet& facet : facets) widths.push_back(rim_slack * size_of(place(facet, coordinates)));
  return widths;
}

/// One node and what it brings along.
struct SurfaceSearch::Query {
  std::size_t q;
  Vec3 x;
  Vec3 normal;                           ///< its averaged normal, or zero
  std::span<const Index> candidates;     ///< facets
  std::span<const double> box_distance;  ///< squared, of their boxes
  Index behind = -1;                     ///< the facet that it was behind at x_begin
  bool is_behind = false;                ///< it is known to be behind the surface, however deep
  bool was_behind = false;               ///< at x_begin, of a facet that counts
};

/// The closest point so far.
struct SurfaceSearch::Best {
  double distance;
  Index facet = -1;
  Projection projection{};
  bool is_continued = false;  ///< beyond a rim, a little
  bool is_beside = false;     ///< beyond a rim, farther
  std::optional<Rim> rim{};   ///< where it is continued beyond the end of the surface
};

/// The closest point of the facets beside one that counts which do not.
struct SurfaceSearch::SidePoint {
  Index facet = -1;
  Projection projection{};
  SignedDistance at{};  ///< of the sides as they are moved out
  double slack = 0.0;   ///< by how much
};

SurfaceSearch::SurfaceSearch(std::vector<Index> nodes, std::vector<Facet> own, std::vector<Facet> facets,
                             SearchRange range)
    : nodes_(std::move(nodes)),
      own_(std::move(own)),
      range_(std::move(range)),
      broad_phase_(
          [this] {
            std::vector<Facet> points;
            for (const Index n : nodes_) points.push_back({{n, -1, -1, -1}, 1});
            return points;
          }(),
          std::move(facets), range_.reach, range_.margin) {
  const std::span<const Facet> targets = broad_phase_.targets();
  Index last = -1;
  for (const Index n : nodes_) last = std::max(last, n);
  for (const std::span<const Facet> all : {targets, std::span<const Facet>(own_)})
    for (const Facet& facet : all)
      for (const Index n : facet) last = std::max(last, n);
  facets_at_.resize(static_cast<std::size_t>(last) + 1);
  for (std::size_t f = 0; f < targets.size(); ++f)
    for (const Index n : targets[f]) facets_at_[n].push_back(static_cast<Index>(f));
  std::vector<std::vector<Index>> own_at_node(facets_at_.size());
  for (std::size_t f = 0; f < own_.size(); ++f)
    for (const Index n : own_[f]) own_at_node[n].push_back(static_cast<Index>(f));
  for (const Index n : nodes_) {
    own_at_.insert(own_at_.end(), own_at_node[n].begin(), own_at_node[n].end());
    own_begin_.push_back(own_at_.size());
  }
  for (std::size_t n = 0; n < facets_at_.size(); ++n)
    if (!facets_at_[n].empty()) target_nodes_.push_back(static_cast<Index>(n));
  std::vector<std::vector<Index>> ring(facets_at_.size());  // nodes of the facets that a node belongs to
  for (const std::span<const Facet> all : {targets, std::span<const Facet>(own_)})
    for (const Facet& facet : all)
      for (const Index n : facet) ring[n].insert(ring[n].end(), facet.begin(), facet.end());
  least_depth_ = range_.depth.empty() ? 0.0 : *std::min_element(range_.depth.begin(), range_.depth.end());
  excluded_.resize(nodes_.size());
  for (std::size_t q = 0; q < nodes_.size(); ++q) {
    std::vector<Index>& list = excluded_[q];
    for (const Index n : ring[nodes_[q]]) list.insert(list.end(), facets_at_[n].begin(), facets_at_[n].end());
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

void SurfaceSearch::update(std::span<const Vec3> x_begin, std::span<const Vec3> x, std::span<const Vec3> displacement,
                           std::vector<Index> behind) {
  x_begin_ = x_begin;
  x_ = x;
  displacement_ = displacement;
  broad_phase_.update(x_begin, displacement);
  behind_ = std::move(behind);
  const bool none_is_behind = std::all_of(behind_.begin(), behind_.end(), [](Index f) { return f < 0; });
  if (broad_phase_.pair_count() == 0 && none_is_behind) return;
  if (active_since_ != broad_phase_.builds()) find_active();
  place_active();
  double of_nodes = 0.0, of_facets = 0.0;
  for (const Index n : nodes_) of_nodes = std::max(of_nodes, dot(displacement[n], displacement[n]));
  for (const Index n : target_nodes_) of_facets = std::max(of_facets, dot(displacement[n], displacement[n]));
  is_fast_ = std::sqrt(of_nodes) + std::sqrt(of_facets) > 0.25 * least_depth_;
}

void SurfaceSearch::find_active() {
  active_since_ = broad_phase_.builds();
  is_active_.assign(facets().size(), 0);
  is_active_own_.assign(own_.size(), 0);
  for (std::size_t q = 0; q < nodes_.size(); ++q) {
    const std::span<const Index> candidates = broad_phase_.targets_of(q);
    if (candidates.empty()) continue;
    for (const Index f : candidates) is_active_[f] = 1;
    for (const Index f : own_facets(q)) is_active_own_[f] = 1;
  }
  const auto list = [](std::span<const std::uint8_t> is_listed, std::vector<Index>& listed) {
    listed.clear();
    for (std::size_t f = 0; f < is_listed.size(); ++f)
      if (is_listed[f] != 0) listed.push_back(static_cast<Index>(f));
  };
  list(is_active_, active_);
  list(is_active_own_, active_own_);
}

void SurfaceSearch::place_active() {
  constexpr std::size_t grain = 512;  // facets per task: some ten microseconds of work
  bounds_.resize(facets().size());
  facet_normals_.resize(facets().size());
  parallel_for(active_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = active_[i];
      const PlacedFacet facet = placed(f);
      Bounds& box = bounds_[f] = {};
      for (int a = 0; a < facet.size; ++a) box.include(facet.x[static_cast<std::size_t>(a)]);
      facet_normals_[f] = direction(area_vector(facet));
    }
  });
  own_areas_.resize(own_.size());
  parallel_for(active_own_.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) own_areas_[active_own_[i]] = area_vector(place(own_[active_own_[i]], x_));
  });
}

/// At its centre.
Vec3 SurfaceSearch::facet_normal(Index f) const {
  return is_active_[f] != 0 ? facet_normals_[f] : direction(area_vector(placed(f)));
}

/// At nodes_[q], averaged over the own facets there; zero where there are none.
Vec3 SurfaceSearch::node_normal(std::size_t q) const {
  Vec3 sum{};
  for (const Index f : own_facets(q))
    sum = add(sum, is_active_own_[f] != 0 ? own_areas_[f] : area_vector(place(own_[f], x_)));
  return direction(sum);
}

bool SurfaceSearch::counts(const Query& query, Index f) const {
  const std::vector<Index>& excluded = excluded_[query.q];
  if (!excluded.empty() && std::binary_search(excluded.begin(), excluded.end(), f)) return false;
  if (!(dot(query.normal, query.normal) > 0.0)) return true;
  const double product = dot(query.normal, facet_normal(f));
  return product < opposed || (product < no_longer_opposed && stays_behind(query, f));
}

/// True of the facet that the node was behind, and of those that it passes on to from there.
bool SurfaceSearch::stays_behind(const Query& query, Index f) const {
  return query.behind >= 0 && (f == query.behind || dot(facet_normal(f), facet_normal(query.behind)) > smooth);
}

/// True behind a facet deeper than what touches it can be. What is deep behind a facet of its own body, and has not
/// come through its front, is the body's other side, however thin the body has become.
bool SurfaceSearch::is_too_deep(const Query& query, Index f, double gap) const {
  if (query.is_behind) return false;
  if (gap < -range_.depth[f]) return true;
  if (query.was_behind || range_.body.empty()) return false;
  const Index node = nodes_[query.q];
  if (range_.body[node] != range_.body[facets()[f][0]]) return false;
  return gap < -side_slack * size_of(placed(f)) && project(place(facets()[f], x_begin_), x_begin_[node]).gap < 0.0;
}

/// True when no other facet that counts goes on beyond the edge where p lies, or beyond an edge at the vertex where p
/// lies, of whichever facet there.
bool SurfaceSearch::ends_at(const Query& query, Index f, const Projection& p) const {
  const auto ends_at_edge = [&](Index of, Index a, Index b) {
    return std::none_of(facets_at_[a].begin(), facets_at_[a].end(), [&](Index other) {
      return other != of && contains(facets()[other], b) && counts(query, other);
    });
  };
  const Facet& facet = facets()[f];
  const auto k = static_cast<std::size_t>(p.feature);
  if (facet.size == 2) return ends_at_edge(f, facet[k], facet[k]);
  if (p.site == ProjectionSite::edge)
    return ends_at_edge(f, facet[k], facet[(k + 1) % static_cast<std::size_t>(facet.size)]);
  const Index vertex = facet[k];
  return std::any_of(facets_at_[vertex].begin(), facets_at_[vertex].end(), [&](Index g) {
    if (!counts(query, g)) return false;
    const Facet& there = facets()[g];
    const auto size = static_cast<std::size_t>(there.size);
    const auto a = static_cast<std::size_t>(std::find(there.begin(), there.end(), vertex) - there.begin());
    return ends_at_edge(g, vertex, there[(a + 1) % size]) || ends_at_edge(g, there[(a + size - 1) % size], vertex);
  });
}

/// True when a neighbour at the edge or vertex where p lies comes nearer to the node: p is then no closest point of the
/// surface, though the neighbour may not count for its rim.
bool SurfaceSearch::goes_on_nearer(const Query& query, Index f, const Projection& p) const {
  const std::vector<Index>& around = facets_at_[facets()[f][static_cast<std::size_t>(p.feature)]];
  return std::any_of(around.begin(), around.end(), [&](Index g) {
    return g != f && counts(query, g) && project(placed(g), query.x).distance < p.distance * (1.0 - 1e-9);
  });
}

/// True when the surface has another facet beyond the edge or end where p lies, whether it counts or not.
bool SurfaceSearch::goes_on(Index f, const Projection& p) const {
  const Facet& facet = facets()[f];
  const auto k = static_cast<std::size_t>(p.feature);
  const Index a = facet[k], b = facet[(k + 1) % static_cast<std::size_t>(facet.size)];
  const bool is_edge = p.site == ProjectionSite::edge;
  return std::ranges::any_of(facets_at_[a], [&](Index g) { return g != f && (!is_edge || contains(facets()[g], b)); });
}

/// Where the node is behind or before the neighbours of f that face away from it; nothing where f has none, and for a
/// node that has come through f or was in front of it at x_begin.
std::optional<SurfaceSearch::SidePoint> SurfaceSearch::side_at(const Query& query, Index f) const {
  if (stays_behind(query, f) || dot(query.normal, query.normal) == 0.0) return std::nullopt;
  if (project(place(facets()[f], x_begin_), x_begin_[nodes_[query.q]]).gap >= 0.0) return std::nullopt;
  const std::vector<Index>& excluded = excluded_[query.q];
  SidePoint side;
  for (const Index n : facets()[f])
    for (const Index g : facets_at_[n]) {
      if (g == f || g == side.facet || counts(query, g) || std::ranges::binary_search(excluded, g)) continue;
      const Projection p = project(placed(g), query.x);
      if (side.facet >= 0 && p.distance >= side.projection.distance) continue;
      side.facet = g;
      side.projection = p;
    }
  if (side.facet < 0) return std::nullopt;
  const Projection& p = side.projection;
  side.at = p.site == ProjectionSite::interior
                ? SignedDistance{p.normal, p.gap}
                : signed_distance(p, query.x, pseudonormal(side.facet, p), tiny * range_.reach);
  if (range_.moves_sides_out || behind_.empty()) side.slack = side_slack / rim_slack * rim_width(f);
  side.at.gap -= side.slack;
  return side;
}

/// How far facet f is continued beyond an end.
double SurfaceSearch::rim_width(Index f) const {
  return range_.width.empty() ? rim_slack * size_of(placed(f)) : range_.width[f];
}

void SurfaceSearch::consider(const Query& query, Index f, Best& best) const {
  const PlacedFacet facet = placed(f);
  Projection p = project(facet, query.x);
  // On a common edge or corner the facet is taken that the point is seen from best.
  const bool is_tied = best.facet >= 0 && std::abs(p.distance - best.distance) <= tie * best.distance;
  if (is_tied ? std::abs(p.gap) <= std::abs(best.projection.gap) : !(p.distance < best.distance)) return;
  if (p.gap < 0.0 && is_too_deep(query, f, p.gap)) return;
  bool is_continued = false;
  std::optional<Rim> rim;
  const bool is_beyond = p.site != ProjectionSite::interior && ends_at(query, f, p);
  if (is_beyond) {
    const ParentPoint at = perpendicular_foot(facet, query.x, {p.xi, p.eta});
    const FacetShape shape = facet_shape(facet.size, at.xi, at.eta);
    const FacetFrame frame = facet_frame(facet, shape);
    const double width = rim_width(f);
    is_continued = norm(subtract(frame.position, p.point)) <= width;
    if (!is_continued && p.gap < 0.0) return;
    const std::optional<SidePoint> side = p.gap < 0.0 ? side_at(query, f) : std::nullopt;
    if (side && side->at.gap >= 0.0 && goes_on(f, p)) return;
    if (is_continued) {
      if (range_.fades && p.gap < 0.0 && (query.was_behind || !side)) rim = Rim{p.point, p.N, width};
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
  if (!is_beyond && p.site != ProjectionSite::interior && goes_on_nearer(query, f, p)) return;
  best = {p.distance, f, p, is_continued, is_beyond && !is_continued, rim};
}

Vec3 SurfaceSearch::pseudonormal(Index f, const Projection& p) const {
  const Facet& facet = facets()[f];
  const auto size = static_cast<std::size_t>(facet.size), k = static_cast<std::size_t>(p.feature);
  Vec3 sum{};
  for (const Index other : facets_at_[facet[k]]) {
    const Facet& beside = facets()[other];
    const PlacedFacet there = placed(other);
    if (p.site == ProjectionSite::edge && !contains(beside, facet[(k + 1) % size])) continue;
    double weight = 1.0;
    if (p.site == ProjectionSite::vertex && beside.size > 2) {
      const auto n = static_cast<std::size_t>(beside.size);
      const auto a = static_cast<std::size_t>(std::find(beside.begin(), beside.end(), facet[k]) - beside.begin());
      const Vec3& corner = there.x[a];
      const Vec3 to_next = subtract(there.x[(a + 1) % n], corner);
      const Vec3 to_last = subtract(there.x[(a + n - 1) % n], corner);
      weight = std::atan2(norm(cross(to_next, to_last)), dot(to_next, to_last));
    }
    sum = add(sum, scaled(project(there, p.point).normal, weight));
  }
  const double length = norm(sum);
  return length > 0.0 ? scaled(sum, 1.0 / length) : p.normal;
}

/// The facet that the node has gone through first, from the front to the back.
std::optional<Index> SurfaceSearch::crossed_facet(const Query& query) const {
  std::optional<Index> first;
  double least = INFINITY;
  for (const Index f : query.candidates) {
    if (!counts(query, f)) continue;
    const Facet& facet = facets()[f];
    const ParentPoint centre = facet_centre(facet.size);
    std::array<double, 4> N = facet_shape(facet.size, centre.xi, centre.eta).N;
    std::optional<RayHit> hit;
    double way = 0.0;
    for (int i = 0; i < 3; ++i) {  // the facet's motion is that of the point that is hit
      Vec3 motion = displacement_[nodes_[query.q]];
      for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
        motion = subtract(motion, scaled(displacement_[facet[a]], N[a]));
      way = norm(motion);
      if (!(way > 0.0) || dot(motion, facet_normal(f)) >= 0.0) {
        hit.reset();
        break;
      }
      hit = intersect(placed(f), subtract(query.x, motion), scaled(motion, 1.0 / way), 1e-6);
      if (!hit) break;
      N = facet_shape(facet.size, hit->xi, hit->eta).N;
    }
    if (!hit || hit->distance < -tiny * range_.reach || hit->distance > way || hit->distance / way >= least) continue;
    least = hit->distance / way;
    first = f;
  }
  return first;
}

/// The closest point of the facets that count, the nearest by its bounds first, so that few have to be projected on.
SurfaceSearch::Best SurfaceSearch::closest(const Query& query) const {
  Best best{std::nextafter(range_.reach, INFINITY)};
  Index nearest = -1;
  double bound = best.distance * best.distance;
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const double d = query.box_distance[i];
    if (d >= bound || !counts(query, query.candidates[i])) continue;
    bound = d;
    nearest = query.candidates[i];
  }
  if (nearest >= 0) consider(query, nearest, best);
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const Index f = query.candidates[i];
    if (f == nearest || query.box_distance[i] > (1.0 + 4.0 * tie) * best.distance * best.distance) continue;
    if (counts(query, f)) consider(query, f, best);
  }
  return best;
}

/// The closest point that the facet `from` and ever nearer neighbours lead to.
SurfaceSearch::Best SurfaceSearch::followed(const Query& query, Index from) const {
  Index f = from;
  Projection p = project(placed(f), query.x);
  Best best{INFINITY};
  for (std::size_t hops = 0; hops < facets().size(); ++hops) {
    consider(query, f, best);
    if (p.site == ProjectionSite::interior) return best;
    const Index last = f;
    for (const Index g : facets_at_[facets()[last][static_cast<std::size_t>(p.feature)]]) {
      if (!counts(query, g)) continue;
      consider(query, g, best);
      const Projection there = project(placed(g), query.x);
      if (!(there.distance < p.distance * (1.0 - 1e-9))) continue;
      f = g;
      p = there;
    }
    if (f == last) return best;
  }
  return best;
}

/// Distances of a node from facet f and from its plane, from which both weights are made, are apart by `alike` at most.
double SurfaceSearch::alike(Index f) const {
  return alike_share * range_.width[f];
}

/// At what distance from facet f a node has no foot on it, its least distance from the surface given.
double SurfaceSearch::farthest_foot(Index f, double least) const {
  return least + range_.width[f] + alike(f);
}

/// The node's foot on the plane of facet f, its weight that of how far it lies beyond the facet's edges.
FacetFoot SurfaceSearch::foot_on(const Query& query, Index f, const Projection& p) const {
  FacetFoot out = foot_at(f, p, p.normal, p.gap);
  if (p.site == ProjectionSite::interior) return out;
  const double width = range_.width[f];
  const PlacedFacet facet = placed(f);
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
  out.at_closest = scaled(subtract(query.x, p.point), slope);
  out.gradient = scaled(out.normal, -slope * out.gap);
  return out;
}

/// The feet on all facets about the closest point; none where that lies on an edge too sharp to go round.
void SurfaceSearch::feet_around(const Query& query, const Best& best, std::vector<FacetFoot>& feet) const {
  feet.clear();
  if (range_.width.empty() || facets()[best.facet].size == 1 || best.is_beside) return;
  const Vec3 normal = facet_normal(best.facet);
  const auto is_beside_tip = [&](Index f) {
    return facets()[f].size == 2 && dot(facet_normal(f), query.normal) < -pointed;
  };
  const bool is_tip = best.projection.site == ProjectionSite::interior && is_beside_tip(best.facet);
  const auto agrees = [&](Index f) { return dot(facet_normal(f), normal) > smooth || (is_tip && is_beside_tip(f)); };
  if (best.projection.site != ProjectionSite::interior && !best.is_continued) {
    const auto& around = facets_at_[facets()[best.facet][static_cast<std::size_t>(best.projection.feature)]];
    if (!std::all_of(around.begin(), around.end(), [&](Index f) { return !counts(query, f) || agrees(f); })) return;
  }
  const auto projected = [&](Index f) { return project(placed(f), query.x); };
  feet.push_back(foot_on(query, best.facet, best.is_continued ? projected(best.facet) : best.projection));
  double sum = feet.front().weight;
  for (std::size_t i = 0; i < query.candidates.size(); ++i) {
    const Index f = query.candidates[i];
    const double most = farthest_foot(f, best.distance);
    if (f == best.facet || query.box_distance[i] >= most * most || !agrees(f) || !counts(query, f)) continue;
    const Projection p = projected(f);
    if (p.distance >= most || (p.gap < 0.0 && is_too_deep(query, f, p.gap))) continue;
    FacetFoot one = foot_on(query, f, p);
    if (!(one.weight > 0.0) || !fade_unlike(one, alike(f), feet.front())) continue;
    sum += one.weight;
    feet.push_back(one);
  }
  if (!(sum > 0.0)) feet.clear();
}

/// What the closest point found amounts to; false: nothing.
bool SurfaceSearch::met(const Query& query, const Best& best, SurfacePoint& point) const {
  if (best.facet < 0) return false;
  const Projection& p = best.projection;
  SignedDistance at{p.normal, p.gap};
  if (!best.is_continued && p.site != ProjectionSite::interior)
    at = signed_distance(p, query.x, pseudonormal(best.facet, p), tiny * range_.reach);
  // Beside a rim a node is behind some of the facets there and in front of others, and touches none of them.
  if (best.is_beside && at.gap < 0.0) return false;
  if (at.gap < 0.0 && is_too_deep(query, best.facet, at.gap)) return false;
  double outside = 0.0;  // by how much the gap is below that of the body as it is
  const bool is_from_side = at.gap < 0.0 && !query.was_behind;
  if (const std::optional<SidePoint> side = is_from_side ? side_at(query, best.facet) : std::nullopt) {
    if (side->at.gap >= 0.0) return false;
    if (side->at.gap > at.gap) {
      take_only(side->facet, side->projection, side->at, point);
      point.facet = -1;  // it has come through the front of none
      point.rounded = std::min(-side->at.gap, side->slack);
      return true;
    }
    if (side->at.gap + side->slack > tiny * side->slack) outside = -at.gap;
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

/// The candidates, those of one body after those of another.
std::span<const Index> SurfaceSearch::by_body(std::span<const Index> candidates, Space& space) const {
  const auto body = [this](Index f) { return body_of(f); };
  if (std::ranges::is_sorted(candidates, {}, body)) return candidates;
  space.candidates.assign(candidates.begin(), candidates.end());
  std::ranges::stable_sort(space.candidates, {}, body);
  return space.candidates;
}

/// What the query meets of each body, the least gap of all in space.found; false: nothing.
bool SurfaceSearch::find_nearest(const Query& query, Space& space) const {
  bool is_found = false;
  for (std::size_t begin = 0, end = 0; begin < query.candidates.size(); begin = end) {
    const Index body = body_of(query.candidates[begin]);
    while (end < query.candidates.size() && body_of(query.candidates[end]) == body) ++end;
    Query one = query;
    one.candidates = query.candidates.subspan(begin, end - begin);
    one.box_distance = query.box_distance.subspan(begin, end - begin);
    if (query.was_behind && body_of(query.behind) != body) {
      one.was_behind = false;
      one.behind = -1;
    }
    if (!met(one, closest(one), is_found ? space.other : space.found)) continue;
    if (is_found && space.other.gap < space.found.gap) std::swap(space.found, space.other);
    is_found = true;
  }
  return is_found;
}

const SurfacePoint* SurfaceSearch::find(std::size_t q, Space& space) const {
  const Index behind = behind_.empty() ? -1 : behind_[q];
  const std::span<const Index> near = broad_phase_.targets_of(q);
  if (behind < 0 && near.empty()) return nullptr;
  const std::span<const Index> candidates = by_body(near, space);
  const Vec3& x = x_[nodes_[q]];
  space.box_distance.resize(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i)
    space.box_distance[i] = squared_distance(bounds_[candidates[i]], x);
  Query query{q, x, node_normal(q), candidates, space.box_distance};
  query.behind = behind;
  query.was_behind = behind >= 0 && counts(query, behind);
  if (!query.was_behind) query.behind = -1;
  const bool is_found = find_nearest(query, space);
  if (is_found && space.found.gap < 0.0) return &space.found;
  if (query.was_behind) {
    query.is_behind = true;
    if (met(query, followed(query, behind), space.other) && space.other.gap < 0.0) return &space.other;
  }
  if (is_fast_) {
    if (const std::optional<Index> crossed = crossed_facet(query)) {
      const Projection p = project(placed(*crossed), query.x);
      SignedDistance at{p.normal, p.gap};
      if (p.site != ProjectionSite::interior) at = {scaled(subtract(p.point, query.x), 1.0 / p.distance), -p.distance};
      take_only(*crossed, p, at, space.other);
      return &space.other;
    }
  }
  return is_found ? &space.found : nullptr;
}

}  // namespace carom
