#include "contact/sharp_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/vec3.hpp"
#include "model/outer_facets.hpp"
#include "surface/fade.hpp"
#include "surface/feature_edges.hpp"
#include "surface/surface_point.hpp"

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

SharpNodes::SharpNodes(const Model& model, std::span<const Facet> surface) {
  const Mesh& mesh = *model.mesh;
  const std::vector<Facet> beside = facets_beside(surface, skin(model));
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

/// f^2 towards a face with this normal.
double SharpNodes::product(Index n, const Vec3& normal, std::span<const Vec3> x) const {
  double squared = 1.0;
  for (const Facet& facet : facets_.at(n))
    squared *= fade((1.0 + dot(corner_of(facet, n, x).normal, normal)) / lies_flat).value;
  return squared;
}

/// Adds w times the gradient of the logarithm of f towards the mean normal of a point.
void SharpNodes::add_product(Index n, const SurfacePoint& point, std::span<const Vec3> x, double w, NodeStand& stand,
                             NodeStand::OfPoint& of_point) const {
  const Vec3 normal = mean_normal(point);
  Vec3 of_normal{};
  for (const Facet& facet : facets_.at(n)) {
    const Corner corner = corner_of(facet, n, x);
    const double cosine = dot(corner.normal, normal), slope = w * fade((1.0 + cosine) / lies_flat).slope / lies_flat;
    if (slope == 0.0) continue;
    const Vec3 v = scaled(subtract(normal, scaled(corner.normal, cosine)), slope / corner.size);
    const Vec3 of_next = cross(corner.to_previous, v), of_previous = cross(v, corner.to_next);
    stand.of_node = subtract(stand.of_node, add(of_next, of_previous));
    stand.of_others.emplace_back(corner.next, of_next);
    if (corner.previous >= 0) stand.of_others.emplace_back(corner.previous, of_previous);
    of_normal = add(of_normal, scaled(corner.normal, slope));
  }
  if (of_normal == Vec3{}) return;
  const auto along = [&](std::size_t f) { return dot(of_normal, point.feet[f].facet_normal); };
  for_each_slope_of_weights(point, along, [&](std::size_t f, const FacetFoot::Slope& slope) {
    of_point.normals.push_back(scaled(of_normal, point.feet[f].weight));
    of_point.weights.push_back(slope);
    stand.of_node = add(stand.of_node, add(slope.gradient, slope.at_closest));
  });
}

/// Takes the factor of another side of the body. False where nothing is left of f.
bool SharpNodes::take_side(Index n, const SurfacePoint& met, const SurfacePoint& side, std::span<const Vec3> x,
                           NodeStand& stand) const {
  NodeStand::OfPoint& of_side = stand.of_sides.emplace_back();
  const double deep = -met.gap;
  const Fade near = fade(2.0 + side.gap / deep);
  if (near.value == 0.0) return true;
  const double squared = product(n, mean_normal(side), x), part = 1.0 - (1.0 - squared) * near.value;
  if (part == 1.0) return true;
  stand.factor *= std::sqrt(std::max(part, 0.0));
  if (!(stand.factor > least_factor)) return false;
  const double slope = -(1.0 - squared) * near.value * near.slope / part;  // of log f by 2 - d_h / |g|
  of_side.gap = slope / deep;
  stand.of_node = add(stand.of_node, scaled(side.gradient, of_side.gap));
  stand.of_met.gap += slope * side.gap / (deep * deep);
  if (squared > 0.0) add_product(n, side, x, near.value * squared / part, stand, of_side);
  return true;
}

NodeStand SharpNodes::stand(Index n, const SurfacePoint& met, std::span<const SurfacePoint> sides,
                            std::span<const Vec3> x) const {
  NodeStand stand;
  stand.factor = std::sqrt(product(n, mean_normal(met), x));
  if (!(stand.factor > least_factor)) return NodeStand::nothing();
  add_product(n, met, x, 1.0, stand, stand.of_met);
  for (const SurfacePoint& side : sides)
    if (!take_side(n, met, side, x, stand)) return NodeStand::nothing();
  const auto times_factor = [&stand](NodeStand::OfPoint& of) {
    of.gap *= stand.factor;
    for (Vec3& slope : of.normals) slope = scaled(slope, stand.factor);
    for (FacetFoot::Slope& slope : of.weights) slope = scaled(slope, stand.factor);
  };
  stand.of_node = scaled(stand.of_node, stand.factor);
  for (auto& [other, slope] : stand.of_others) slope = scaled(slope, stand.factor);
  times_factor(stand.of_met);
  std::ranges::for_each(stand.of_sides, times_factor);
  return stand;
}

}  // namespace carom
