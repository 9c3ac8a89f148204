// Facets that approximate a smooth surface: how far it bulges out of each of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/row_maker.hpp"
#include "mesh/mesh.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/tangent_dual.hpp"

namespace carom {

/// The bulge of a facet: for each edge (from corner k to the next; a segment has one) the vector c_k, by its components
/// along a_1, a_2 and n of the facet's frame at its centre, with which it turns and stretches. With L_k the shape
/// functions of a triangle and s, t in [0, 1] the parent coordinates of a segment and of a quadrilateral the surface is
///   triangle       x = sum_a N_a x_a - L_0 L_1 c_0 - L_1 L_2 c_1 - L_2 L_0 c_2
///   segment        x = sum_a N_a x_a - s (1 - s) c_0
///   quadrilateral  x = sum_a N_a x_a - s (1 - s) ((1 - t) c_0 + t c_2) - t (1 - t) (s c_1 + (1 - s) c_3)
/// (T. Nagata, Computer Aided Geometric Design 22, 2005, 327). Flat facets have none.
struct Bulge {
  std::array<Vec3, 4> edge{};
};

/// The vector c of the edge d = x_1 - x_0 between points of unit normals n_0 and n_1: the curve
/// x_0 + (d - c) s + c s^2 is normal to both. Of Nagata's c the part along n_0 - n_1 is left out where the edge is far
/// from symmetric, |(n_0 + n_1) . d| > |(n_0 - n_1) . d| / 2: it is ill-conditioned there. At most 0.25 |d| long.
Vec3 edge_bulge(const Vec3& d, const Vec3& n_0, const Vec3& n_1);

/// The bulges of a surface in its reference configuration.
///
/// It is smooth across an edge (a node between segments) of exactly two facets of linear cells whose normals at their
/// centres differ by less than 30 degrees, as in feature_edges.hpp. The normal at a corner is that of all facets that
/// hang together with its own around the node across such edges,
///   n = sum of (e_1 x e_2) / (|e_1|^2 |e_2|^2) over their corners there   (segments: sum of n / length),
/// e_1, e_2 being the edges at the corner: exact on spheres (N. Max, J. Graphics Tools 4(2), 1999). Facets whose
/// bulges are all below a thousandth of their edges are flat.
///
/// At a plane of symmetry it goes on as its mirror image: across edges (an end of segments) whose nodes all have the
/// same coordinate i and are held along i, where the facet and its image turn by less than 30 degrees.
class SmoothSurface {
 public:
  /// beside: more facets of the same bodies, that go on beyond the surface's ends (the skin; facets of the surface may
  /// be in it). is_held: by node and component; empty: no node is held.
  SmoothSurface(const Mesh& mesh, std::span<const Facet> facets, std::span<const Facet> beside,
                std::span<const std::array<bool, 3>> is_held = {});

  bool has_curved() const { return has_curved_; }
  bool is_curved(Index f) const { return is_curved_[static_cast<std::size_t>(f)]; }
  const Bulge& bulge(Index f) const { return bulges_[static_cast<std::size_t>(f)]; }
  /// True of edge `edge` of facet f (from its corner to the next; of a segment that node).
  bool goes_on(Index f, std::size_t edge) const { return goes_on_[static_cast<std::size_t>(f)][edge]; }
  /// True when no sharp edge and no end of the surface meets the node, and some facet there is curved.
  bool is_smooth_node(Index n) const { return has(n, curved_inside); }
  /// True when no sharp edge and no end of the surface meets the node.
  bool is_inner_node(Index n) const { return has(n, inside) || has(n, curved_inside); }
  /// True of edges of curved facets that the surface is smooth across, and of their diagonals. Nodes: increasing.
  bool is_smooth_across(const std::array<Index, 2>& edge) const {
    return std::ranges::binary_search(inner_edges_, edge);
  }

 private:
  enum State : std::uint8_t { none, ends, inside, curved_inside };
  void find_inner_edges(std::span<const Facet> facets);
  bool has(Index n, State state) const {
    return static_cast<std::size_t>(n) < nodes_.size() && nodes_[static_cast<std::size_t>(n)] == state;
  }

  bool has_curved_ = false;
  std::vector<bool> is_curved_;
  std::vector<Bulge> bulges_;
  std::vector<std::array<bool, 4>> goes_on_;
  std::vector<State> nodes_;
  std::vector<std::array<Index, 2>> inner_edges_;  ///< sorted
};

/// The smooth surface over a facet at its current position.
class SmoothPatch {
 public:
  SmoothPatch(const PlacedFacet& facet, const Bulge& bulge);

  const PlacedFacet& facet() const { return facet_; }
  const FacetFrame& centre() const { return centre_; }  ///< of the facet
  /// Bounds of the longest offset from the facet, and of the curvature (1 / length).
  double rise() const { return rise_; }
  double curvature() const;
  /// Position, tangents, normal and Jacobian of the surface.
  FacetFrame at(const ParentPoint& p) const;
  /// Foot of the perpendicular from x by Newton's method, also a little outside of the facet; nothing where there is
  /// none.
  std::optional<ParentPoint> foot(const Vec3& x) const;
  /// A vector by its components along a_1, a_2 and n of the facet's centre.
  Vec3 components(const Vec3& v) const { return {dot(dual_.dual_1, v), dot(dual_.dual_2, v), dot(centre_.normal, v)}; }

  /// weight_a of a point sum_a N_a x_a + o that goes with the facet, o having the components c. It moves by
  ///   sum_a (weight_a du_a - c_3 turn_a (n . du_a)),   turn_a and n of the facet's centre (turn_of_normal).
  std::array<double, 4> weights(const ParentPoint& p, const Vec3& c) const;

 private:
  PlacedFacet facet_;
  FacetFrame centre_;
  TangentDual dual_;
  std::array<Vec3, 4> edge_{};
  double rise_ = 0.0;
};

/// Two surfaces of which one at least is smooth.
struct SmoothSides {
  Surface slave, master;
  std::shared_ptr<const SmoothSurface> of_slave, of_master;
  bool self = false;
};

}  // namespace carom
