#include "surface/half_thickness.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "surface/broad_phase.hpp"
#include "surface/facet_projection.hpp"

namespace carom {
namespace {

constexpr double may_oppose = 0.3;

/// By node, numbers that are equal within one body: of the bodies given and of connected pieces of the skin.
std::vector<Index> pieces(const std::vector<Facet>& skin, std::span<const Index> body) {
  Index last = -1;
  for (const Facet& facet : skin) last = std::max(last, *std::max_element(facet.begin(), facet.end()));
  std::vector<Index> parent(static_cast<std::size_t>(last) + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  std::map<Index, Index> first;  // node of each body
  for (const Facet& facet : skin) {
    for (const Index n : facet) {
      parent[root(n)] = root(facet[0]);
      if (body.empty() || body[n] < 0) continue;
      const Index same = first.try_emplace(body[n], n).first->second;
      parent[root(n)] = root(same);
    }
  }
  for (Index n = 0; n <= last; ++n) parent[n] = root(n);
  return parent;
}

/// What half_thickness looks at.
class Skin {
 public:
  Skin(std::span<const Vec3> coordinates, const std::vector<Facet>& skin, std::span<const Index> body)
      : x_(coordinates), skin_(skin), piece_(pieces(skin, body)), ring_(piece_.size()) {
    nodal_normals(skin, x_, normals_);
    for (const Facet& facet : skin)
      for (const Index n : facet) ring_[n].insert(ring_[n].end(), facet.begin(), facet.end());
    for (std::size_t n = 0; n < ring_.size(); ++n)
      if (!ring_[n].empty()) nodes_.push_back({{static_cast<Index>(n), -1, -1, -1}, 1});
  }
  const std::vector<Facet>& nodes() const { return nodes_; }

  /// Thickness by the ray from facet f's centre to another facet; nothing where it does not meet that.
  std::optional<double> to_facet(std::size_t f, Index other) const {
    if (piece_[skin_[other][0]] != piece_[skin_[f][0]]) return std::nullopt;
    const PlacedFacet facet = place(skin_[f], x_), far = place(skin_[other], x_);
    const ParentPoint centre = facet_centre(facet.size);
    const FacetFrame frame = facet_frame(facet, centre.xi, centre.eta);
    const Vec3 inward = scaled(frame.normal, -1.0);
    const std::optional<RayHit> hit = intersect(far, frame.position, inward);
    if (!hit || hit->distance <= 0.0 || dot(facet_frame(far, hit->xi, hit->eta).normal, inward) <= 0.0)
      return std::nullopt;
    return hit->distance;
  }

  /// Distance of a node behind facet f; nothing where it is in front or near it along the skin.
  std::optional<double> to_node(std::size_t f, Index n) const {
    const Facet& facet = skin_[f];
    const auto is_near = [&](Index m) { return std::find(facet.begin(), facet.end(), m) != facet.end(); };
    if (piece_[n] != piece_[facet[0]] || std::any_of(ring_[n].begin(), ring_[n].end(), is_near)) return std::nullopt;
    const Projection p = project(place(facet, x_), x_[n]);
    if (p.gap >= 0.0 || dot(p.normal, normals_[n]) >= may_oppose) return std::nullopt;
    return p.distance;
  }

 private:
  std::span<const Vec3> x_;
  const std::vector<Facet>& skin_;
  std::vector<Index> piece_;
  std::vector<std::vector<Index>> ring_;  ///< by node: the nodes of its facets
  std::vector<Vec3> normals_;
  std::vector<Facet> nodes_;
};

}  // namespace

std::vector<double> half_thickness(std::span<const Vec3> coordinates, const std::vector<Facet>& skin,
                                   std::span<const Index> body, double limit) {
  const Skin all(coordinates, skin, body);
  BroadPhase facets(skin, skin, limit, 0.0), nodes(skin, all.nodes(), limit, 0.0);
  facets.update(coordinates);
  nodes.update(coordinates);
  std::vector<double> half(skin.size(), 0.5 * limit);
  parallel_each(skin.size(), [&](std::size_t f) {
    double least = limit;
    for (const Index other : facets.targets_of(f)) least = std::min(least, all.to_facet(f, other).value_or(limit));
    for (const Index i : nodes.targets_of(f))
      least = std::min(least, all.to_node(f, all.nodes()[i][0]).value_or(limit));
    half[f] = 0.5 * least;
  });
  return half;
}

}  // namespace carom
