// Nodes at sharp edges and corners, which have rows as far as they stick out towards a face.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "surface/surface_search.hpp"

namespace carom {

/// The factor f by which a node sticks out towards the face that it meets, and the gradient of f. Lists are empty where
/// f does not change.
struct NodeStand {
  double factor = 1.0;                            ///< f, 0 <= f <= 1
  Vec3 of_node{};                                 ///< gradient of f by the node itself, that by its gap apart,
  double of_gap = 0.0;                            ///< by its gap,
  std::vector<std::pair<Index, Vec3>> of_others;  ///< by the other nodes of its facets,
  std::vector<Vec3> of_normals;                   ///< by the normals of the feet, each of length 1, then of `sides`,
  std::vector<FacetFoot::Slope> of_weights;       ///< by the weights of the feet,
  std::vector<FacetFoot> sides;                   ///< and by the gaps of feet on other sides of the body that it is in,
  std::vector<double> of_sides;                   ///< whose share in what the node meets is nothing

  static NodeStand nothing() {
    NodeStand stand;
    stand.factor = 0.0;
    return stand;
  }
};

/// The nodes of a surface at edges that turn by more than 30 degrees. Rows of overlaps see a corner by the small part
/// of a facet that is inside of the other body, so that it would sink in deep before they hold it. Rows of these nodes
/// hold it from the touch on; their gap is f g with
///   f^2 = product of S(z_k / w) over the facets k of the body at the node,  z_k = 1 + n_k . n,  w = 0.06,
/// n_k the outward normal of facet k at its corner there, n = sum_f w_f n_f the mean normal of the feet, S the fade
/// (fade.hpp). z_k is 0 where the facet lies flat on the other body, and w at 20 degrees from that. So these rows count
/// for nothing on flat faces, and the patch test is that of the overlaps.
///
/// Beside an edge of the other body the nearest face may change, and a node that lay flat on the one sticks out towards
/// the other. So f^2 has a factor 1 - (1 - f_h^2) S(2 - d_h / |g|) for each other face h that the node is behind, by
/// d_h and at its foot, f_h^2 being the product above for h's normal: where two faces are as near, both count alike.
class SharpNodes {
 public:
  SharpNodes(const Model& model, std::span<const Facet> surface);

  bool has(Index n) const { return facets_.contains(n); }
  /// x: current positions; others: of the facets, those of the other body that may be near, none where the
  /// gap is not below zero. A factor below 1e-4 is given
  /// as 0.
  NodeStand stand(Index n, const SurfacePoint& met, std::span<const Vec3> x, std::span<const Facet> facets,
                  std::span<const Index> others) const;

 private:
  double product(Index n, const Vec3& normal, std::span<const Vec3> x) const;
  Vec3 add_product(Index n, const Vec3& normal, std::span<const Vec3> x, double w, NodeStand& stand) const;
  bool take_side(Index n, const SurfacePoint& met, const FacetFoot& side, std::span<const Vec3> x,
                 NodeStand& stand) const;

  std::map<Index, std::vector<Facet>> facets_;  ///< those of the body at each of the nodes
};

}  // namespace carom
