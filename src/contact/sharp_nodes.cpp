#include "contact/sharp_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/fade.hpp"
#include "contact/feature_edges.hpp"
#include "math/vec3.hpp"
#include "mesh/skin.hpp"

namespace carom {
namespace {

constexpr double sharp_turn = std::numbers::pi / 6.0;
constexpr double lies_flat = 0.06;     // w: 1 + n_k . n of a facet that is 20 degrees from lying flat
constexpr double least_factor = 1e-4;  // 1e-8 of the force

/// The corner of a facet at one of its nodes. A segment has e_z as the way to a node before or after it.
struct Corner {
  Index next = -1, previous = -1;
  Vec3 to_next{}, to_previous{};
  double size = 0.0;  ///< |to_next x to_previous|
  Vec3 normal{};      ///< outward
};

Corner corner_of(const Facet& facet, Index n, std::span<const Vec3> x) {
  const auto count = static_cast<std::size_t>(facet.size);
  const auto at = static_cast<std::size_t>(std::find(facet.begin(), facet.end(), n) - facet.begin());
  Corner corner;
  corner.next = facet[(at + 1) % count];
  corner.to_next = subtract(x[corner.next], x[n]);
  if (count == 2) {
    corner.to_previous = {0.0, 0.0, at == 0 ? 1.0 : -1.0};
  } else {
    corner.previous = facet[(at + count - 1) % count];
    corner.to_previous = subtract(x[corner.previous], x[n]);
  }
  const Vec3 c = cross(corner.to_next, corner.to_previous);
  corner.size = norm(c);
  corner.normal = direction(c);
  return corner;
}

}  // namespace

SharpNodes::SharpNodes(const Mesh& mesh, std::span<const Facet> surface) {
  const std::vector<Facet> beside = facets_beside(surface, skin(mesh));
  for (const FeatureEdge& edge : feature_edges(mesh.coordinates, surface, beside, sharp_turn))
    for (const Index n : edge.node) facets_.try_emplace(n);
  for (const Facet& facet : surface)  // in the plane an edge is a node, and which of them are sharp is found below
    if (facet.size == 2)
      for (const Index n : facet) facets_.try_emplace(n);
  for (const std::span<const Facet> facets : {surface, std::span<const Facet>(beside)}) {
    for (const Facet& facet : facets) {
      for (const Index n : facet) {
        const auto at = facets_.find(n);
        if (at != facets_.end()) at->second.push_back(facet);
      }
    }
  }
  const auto normal_of = [&](Index n, const Facet& facet) { return corner_of(facet, n, mesh.coordinates).normal; };
  std::erase_if(facets_, [&](const auto& entry) {
    const std::vector<Facet>& at = entry.second;
    if (at.empty() || at.front().size != 2) return at.empty();
    return at.size() != 2 || dot(normal_of(entry.first, at[0]), normal_of(entry.first, at[1])) > std::cos(sharp_turn);
  });
}

NodeStand SharpNodes::stand(Index n, const SurfacePoint& met, std::span<const Vec3> x) const {
  NodeStand stand;
  Vec3 normal{};
  for (const FacetFoot& foot : met.feet) normal = add(normal, scaled(foot.facet_normal, foot.weight));
  double squared = 1.0;
  for (const Facet& facet : facets_.at(n)) {
    const Corner corner = corner_of(facet, n, x);
    const double z = 1.0 + dot(corner.normal, normal);
    const Fade part = fade(z / lies_flat);
    squared *= part.value;
    if (!(squared > least_factor * least_factor)) return NodeStand::nothing();
    if (part.slope == 0.0) continue;
    stand.of_normals.resize(met.feet.size());
    const double slope = part.slope / lies_flat;  // of log f, until the end
    const Vec3 v = scaled(subtract(normal, scaled(corner.normal, dot(normal, corner.normal))), slope / corner.size);
    const Vec3 of_next = cross(corner.to_previous, v), of_previous = cross(v, corner.to_next);
    stand.of_node = subtract(stand.of_node, add(of_next, of_previous));
    stand.of_others.emplace_back(corner.next, of_next);
    if (corner.previous >= 0) stand.of_others.emplace_back(corner.previous, of_previous);
    for (std::size_t f = 0; f < met.feet.size(); ++f)
      stand.of_normals[f] = add(stand.of_normals[f], scaled(corner.normal, slope * met.feet[f].weight));
  }
  stand.factor = std::sqrt(squared);
  stand.of_node = scaled(stand.of_node, stand.factor);
  for (auto& [other, slope] : stand.of_others) slope = scaled(slope, stand.factor);
  for (Vec3& slope : stand.of_normals) slope = scaled(slope, stand.factor);
  return stand;
}

}  // namespace carom
