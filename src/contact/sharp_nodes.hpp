// Nodes at sharp edges and corners: how they stick out towards a face.
#pragma once

#include <map>
#include <span>
#include <utility>
#include <vector>

#include "contact/surface_search.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// By how much a node sticks out towards the face that it meets, and the gradient of that. Lists are empty where f does
/// not change.
struct NodeStand {
  double factor = 1.0;                            ///< f, 0 <= f <= 1
  Vec3 of_node{};                                 ///< gradient of f by the node itself,
  std::vector<std::pair<Index, Vec3>> of_others;  ///< by the other nodes of its facets,
  std::vector<Vec3> of_normals;                   ///< and by the normals of the feet, each of length 1

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
/// for nothing on flat faces, and the patch test is that of the overlaps. The gradient holds the weights w_f.
class SharpNodes {
 public:
  SharpNodes(const Mesh& mesh, std::span<const Facet> surface);

  bool has(Index n) const { return facets_.contains(n); }
  /// x: current positions. A factor below 1e-4 is given as 0.
  NodeStand stand(Index n, const SurfacePoint& met, std::span<const Vec3> x) const;

 private:
  std::map<Index, std::vector<Facet>> facets_;  ///< those of the body at each of the nodes
};

}  // namespace carom
