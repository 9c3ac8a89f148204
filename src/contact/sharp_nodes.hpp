// Nodes at sharp edges and corners, which have rows as far as they stick out towards a face.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "surface/surface_search.hpp"

namespace carom {

/// The factor f by which a node sticks out towards the face that it meets, and the gradient of f.
struct NodeStand {
  /// Slopes of f in what a node meets: in its gap, and in the normals, each of length 1, and the weights of its feet;
  /// lists are empty where f does not change with them.
  struct OfPoint {
    double gap = 0.0;
    std::vector<Vec3> normals;
    std::vector<FacetFoot::Slope> weights;
  };

  double factor = 1.0;                            ///< f, 0 <= f <= 1
  Vec3 of_node{};                                 ///< gradient of f by the node itself, that by its gap apart,
  std::vector<std::pair<Index, Vec3>> of_others;  ///< by the other nodes of its facets,
  OfPoint of_met;                                 ///< by what it meets,
  std::vector<OfPoint> of_sides;  ///< and by what it would meet on other sides of the body that it is in

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
/// the other. So f^2 has a factor 1 - (1 - f_h^2) S(2 - d_h / |g|) for each other side h that the node is behind, by
/// d_h, f_h^2 being the product above for the mean normal there: where two sides are as near, both count alike.
class SharpNodes {
 public:
  SharpNodes(const Model& model, std::span<const Facet> surface);

  bool has(Index n) const { return facets_.contains(n); }
  /// x: current positions; sides: SurfaceSearch::other_sides. A factor below 1e-4 is given as 0.
  NodeStand stand(Index n, const SurfacePoint& met, std::span<const SurfacePoint> sides, std::span<const Vec3> x) const;

 private:
  double product(Index n, const Vec3& normal, std::span<const Vec3> x) const;
  void add_product(Index n, const SurfacePoint& point, std::span<const Vec3> x, double w, NodeStand& stand,
                   NodeStand::OfPoint& of_point) const;
  bool take_side(Index n, const SurfacePoint& met, const SurfacePoint& side, std::span<const Vec3> x,
                 NodeStand& stand) const;

  std::map<Index, std::vector<Facet>> facets_;  ///< those of the body at each of the nodes
};

}  // namespace carom
