#include "surface/crossing_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/types.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

constexpr double touching = 1e-9;  ///< of the size of a triangle

/// The edge from p down to q through the triangle.
std::optional<Piercing> pierce_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& q) {
  const Vec3 n = cross(subtract(b, a), subtract(c, a));
  const double twice = std::sqrt(dot(n, n));
  if (!(twice > 0.0)) return std::nullopt;
  const Vec3 unit = scaled(n, 1.0 / twice);
  const double at_p = dot(unit, subtract(p, a)), at_q = dot(unit, subtract(q, a)), small = touching * std::sqrt(twice);
  if (!(at_q < -small) || !(at_p >= -small)) return std::nullopt;
  const double part = std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
  const Vec3 x = add(p, scaled(subtract(q, p), part));
  const auto share = [&](const Vec3& from, const Vec3& to) {
    return dot(n, cross(subtract(to, from), subtract(x, from))) / (twice * twice);
  };
  if (share(a, b) < -touching || share(b, c) < -touching || share(c, a) < -touching) return std::nullopt;
  return Piercing{x, unit, -1, -at_q};
}

std::optional<Piercing> pierce_segment(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const double length = std::hypot(b[0] - a[0], b[1] - a[1]), small = touching * length;
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 unit{(b[1] - a[1]) / length, -(b[0] - a[0]) / length, 0.0};
  const double at_p = dot(unit, subtract(p, a)), at_q = dot(unit, subtract(q, a));
  if (!(at_q < -small) || !(at_p >= -small)) return std::nullopt;
  const Vec3 x = add(p, scaled(subtract(q, p), std::clamp(at_p / (at_p - at_q), 0.0, 1.0)));
  const double along = dot(subtract(x, a), subtract(b, a)) / length;
  if (along < -small || along > length + small) return std::nullopt;
  return Piercing{x, unit, -1, -at_q};
}

}  // namespace

std::optional<Piercing> pierce(const SkinPieces& skin, std::span<const Vec3> x, Index edge, Index piece) {
  const SkinPieces::Edge& e = skin.edges[static_cast<std::size_t>(edge)];
  const Facet& facet = skin.pieces[static_cast<std::size_t>(piece)].facet;
  const auto n = static_cast<std::size_t>(facet.size);
  std::array<Vec3, 4> corner{};
  Vec3 centre{};
  for (std::size_t a = 0; a < n; ++a) {
    corner[a] = x[static_cast<std::size_t>(facet[a])];
    centre = add(centre, scaled(corner[a], 1.0 / static_cast<double>(n)));
  }
  std::optional<Piercing> deepest;
  const auto take = [&](std::optional<Piercing> found, Index below) {
    if (!found || (deepest && deepest->depth >= found->depth)) return;
    found->below = below;
    deepest = found;
  };
  for (const std::size_t end : {0, 1}) {
    const Vec3 &p = x[static_cast<std::size_t>(e.node[1 - end])], &q = x[static_cast<std::size_t>(e.node[end])];
    if (n == 2) take(pierce_segment(corner[0], corner[1], p, q), e.node[end]);
    if (n == 3) take(pierce_triangle(corner[0], corner[1], corner[2], p, q), e.node[end]);
    for (std::size_t a = 0; a < n && n == 4; ++a)
      take(pierce_triangle(corner[a], corner[(a + 1) % n], centre, p, q), e.node[end]);
  }
  return deepest;
}

double CrossingDepth::operator()(const Piercing& piercing, Index edge, Index piece) {
  collect(piercing, edge, piece);
  double least = std::min(piercing.depth, least_by_faces(piece));
  if (skin_.pieces[static_cast<std::size_t>(piece)].facet.size > 2)
    least = std::min(least, least_by_edges(edge, piece));
  return std::max(0.0, least);
}

/// What surrounds the piercing on both sides.
void CrossingDepth::collect(const Piercing& piercing, Index edge, Index piece) {
  skin_.ring(piece, ring_);
  const SkinPieces::Edge& e = skin_.edges[static_cast<std::size_t>(edge)];
  sides_.clear();
  nodes_.assign(e.node.begin(), e.node.end());
  for (const Index p : e.piece)
    if (p >= 0 && !skin_.pieces[static_cast<std::size_t>(p)].is_line) sides_.push_back(p);
  if (sides_.empty()) return;  // a bar
  std::vector<Index> around = sides_;
  if (skin_.pieces[static_cast<std::size_t>(piece)].facet.size == 2) {  // in the plane: what follows at the end behind
    for (const Index p : skin_.at(piercing.below)) {
      const SkinPieces::Piece& next = skin_.pieces[static_cast<std::size_t>(p)];
      if (next.is_line || p == sides_[0]) continue;
      const Index far = next.facet[0] == piercing.below ? next.facet[1] : next.facet[0];
      const Vec3 way = subtract(x_[static_cast<std::size_t>(far)], x_[static_cast<std::size_t>(piercing.below)]);
      if (dot(normal(sides_[0]), way) <= touching * norm(way)) around.push_back(p);
    }
  } else if (is_notch(edge)) {
    return;
  }
  for (const Index p : around) {
    const Facet& facet = skin_.pieces[static_cast<std::size_t>(p)].facet;
    nodes_.insert(nodes_.end(), facet.begin(), facet.end());
  }
}

/// True where the two pieces at an edge rise above each other, by more than rounding.
bool CrossingDepth::is_notch(Index edge) const {
  const SkinPieces::Edge& e = skin_.edges[static_cast<std::size_t>(edge)];
  if (e.piece[1] < 0) return false;
  const Vec3& base = x_[static_cast<std::size_t>(e.node[0])];
  const Vec3 n = normal(e.piece[0]);
  return std::any_of(skin_.pieces[static_cast<std::size_t>(e.piece[1])].facet.begin(),
                     skin_.pieces[static_cast<std::size_t>(e.piece[1])].facet.end(), [&](Index a) {
                       const Vec3 way = subtract(x_[static_cast<std::size_t>(a)], base);
                       return dot(n, way) > 1e-6 * norm(way);
                     });
}

double CrossingDepth::least_by_faces(Index piece) const {
  double least = infinity;
  for (const Index g : ring_) {
    const Vec3 w = normal(g);
    if (w == Vec3{}) continue;
    least = std::min(least, std::max(highest(w, piece), highest(w, g)) - lowest(w, nodes_));
  }
  for (const Index h : sides_) {
    const Vec3 w = scaled(normal(h), -1.0);
    if (w == Vec3{}) continue;
    double top = -infinity;
    for (const Index g : ring_) top = std::max(top, highest(w, g));
    const Facet& facet = skin_.pieces[static_cast<std::size_t>(h)].facet;
    least = std::min(least, top - lowest(w, {facet.node.data(), static_cast<std::size_t>(facet.size)}));
  }
  return least;
}

double CrossingDepth::least_by_edges(Index edge, Index piece) const {
  std::vector<Index> mine, others;
  edges_of(sides_, mine);
  if (mine.empty()) mine.push_back(edge);
  edges_of(ring_, others);
  double least = infinity;
  for (const Index m : mine)
    for (const Index o : others) least = std::min(least, least_by_pair(m, o, piece));
  return least;
}

/// w points away from the pierced body.
double CrossingDepth::least_by_pair(Index mine, Index other, Index piece) const {
  const SkinPieces::Edge &m = skin_.edges[static_cast<std::size_t>(mine)],
                         &o = skin_.edges[static_cast<std::size_t>(other)];
  const auto way = [&](const SkinPieces::Edge& e) {
    return subtract(x_[static_cast<std::size_t>(e.node[1])], x_[static_cast<std::size_t>(e.node[0])]);
  };
  const Vec3 a = way(m), b = way(o), product = cross(a, b);
  const double squared = dot(product, product);
  if (!(squared > 1e-8 * dot(a, a) * dot(b, b))) return infinity;
  Vec3 w = scaled(product, 1.0 / std::sqrt(squared));
  const Vec3 out = normals_at(other), in = sides_.empty() ? Vec3{} : normals_at(mine);
  if (dot(w, out) < dot(w, in)) w = scaled(w, -1.0);
  if (dot(w, out) < -touching || dot(w, in) > touching) return infinity;
  double top = highest(w, piece), bottom = lowest(w, nodes_);
  for (const Index p : o.piece)
    if (p >= 0) top = std::max(top, highest(w, p));
  for (const Index p : m.piece) {
    if (p < 0 || sides_.empty() || std::find(sides_.begin(), sides_.end(), p) != sides_.end()) continue;
    const Facet& facet = skin_.pieces[static_cast<std::size_t>(p)].facet;
    bottom = std::min(bottom, lowest(w, {facet.node.data(), static_cast<std::size_t>(facet.size)}));
  }
  return top - bottom;
}

void CrossingDepth::edges_of(std::span<const Index> of, std::vector<Index>& found) const {
  found.clear();
  for (const Index p : of)
    for (const Index e : skin_.pieces[static_cast<std::size_t>(p)].edge)
      if (e >= 0) found.push_back(e);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

double CrossingDepth::highest(const Vec3& w, Index piece) const {
  double top = -infinity;
  for (const Index n : skin_.pieces[static_cast<std::size_t>(piece)].facet)
    top = std::max(top, dot(w, x_[static_cast<std::size_t>(n)]));
  return top;
}

double CrossingDepth::lowest(const Vec3& w, std::span<const Index> nodes) const {
  double bottom = infinity;
  for (const Index n : nodes) bottom = std::min(bottom, dot(w, x_[static_cast<std::size_t>(n)]));
  return bottom;
}

/// Mean unit normal.
Vec3 CrossingDepth::normal(Index piece) const {
  const Facet& facet = skin_.pieces[static_cast<std::size_t>(piece)].facet;
  const auto at = [&](std::size_t a) { return x_[static_cast<std::size_t>(facet[a])]; };
  Vec3 n;
  if (facet.size == 2) {
    n = {at(1)[1] - at(0)[1], at(0)[0] - at(1)[0], 0.0};
  } else {
    const std::size_t last = facet.size == 4 ? 3 : 2;
    n = facet.size == 4 ? cross(subtract(at(2), at(0)), subtract(at(last), at(1)))
                        : cross(subtract(at(1), at(0)), subtract(at(last), at(0)));
  }
  const double size = std::sqrt(dot(n, n));
  return size > 0.0 ? scaled(n, 1.0 / size) : Vec3{};
}

Vec3 CrossingDepth::normals_at(Index edge) const {
  Vec3 sum{};
  for (const Index p : skin_.edges[static_cast<std::size_t>(edge)].piece)
    if (p >= 0 && !skin_.pieces[static_cast<std::size_t>(p)].is_line) sum = add(sum, normal(p));
  return sum;
}

}  // namespace carom
