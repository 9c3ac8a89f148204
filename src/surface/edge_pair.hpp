// Two edges that cross: gap, what it counts, and its exact gradient.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/types.hpp"
#include "surface/feature_edges.hpp"

namespace carom {

/// A segment of an edge at its current position.
struct PlacedEdge {
  std::array<Vec3, 2> x{};    ///< of its nodes
  std::array<Vec3, 2> far{};  ///< means of the other nodes of its facets
};

/// One vector by node of an edge and by mean of the other nodes of its facets.
struct EdgeShares {
  std::array<Vec3, 2> x{}, far{};
};

/// Says which pairs of edges have a factor, and whether the factor is a part of their motion. held: for forces that
/// follow from the motion that is allowed. Both edges have to stick out, and the factor is not a
///   part of the motion: a pair behind each other would else be allowed to close on by sliding to where the factor is
///   smaller, and be thrown out where it is larger.
/// stopped: for forces that only stop a motion. As `held`, but one of the edges that sticks out is enough.
/// moves: for a row's force that grows with its gap; the energy that is stored is then a function of the positions. One
///   of the edges has to stick out.
/// border: as `moves`, for two edges at which faces end; neither has to stick out.
/// fold: as `moves`, for a diagonal of a facet that is flat unless it bends; both have to stick out.
enum class PairFactor : std::uint8_t { held, stopped, moves, border, fold };

/// Closest points x_1 = a_1 + s d_1 and x_2 = a_2 + t d_2 of the lines of two segments.
struct EdgePair {
  Vec3 normal{};  ///< n = +-d_1 x d_2 / |d_1 x d_2|, out of the second body towards the first
  double s = 0.0, t = 0.0;
  double gap = 0.0;                  ///< g = n . (x_1 - x_2)
  double factor = 0.0;               ///< f, 0 < f <= 1
  Vec3 point{};                      ///< x_1
  std::array<EdgeShares, 2> of_gap;  ///< gradient of f g; of g alone, times f, where f is held or g > 0
  /// Tangential motion along the unit vector m normal to n, times f: f (m . (dx_1 - dx_2) - g m . dn), with s and t
  /// held. The second term turns the foot with the normal, so that a rigid rotation gives nothing.
  std::array<EdgeShares, 2> along(const Vec3& m) const;
  /// n . (x_1 - x_2) of the lines of the same segments elsewhere, with n on the same side of d_1 x d_2; not a number
  /// where they are parallel.
  double line_gap(const PlacedEdge& first, const PlacedEdge& second) const;

 private:
  friend class EdgePairing;
  Vec3 d_1_{}, d_2_{};
  double turning_ = 0.0;  ///< +-1 / |d_1 x d_2|
};

/// The pair, or nothing where f = 0. The row of a pair has the gap f g with
///   f^2 = m(x) F prod over the four ends of S(y),  S(z) = z^2 (3 - 2 z), 0 below z = 0 and 1 above 1.
/// With b the unit vector in a facet, normal to the edge, away from it: z = b . n for the facets of the first edge and
/// -b . n for those of the second. An edge sticks out by s_i = prod of S(z / w) over its two facets, w = 0.05, and lies
/// at least flat by t_i = prod of S((z + w) / 2 w): 1/4 amid a flat face, 1/2 at the border of a face that lies flat on
/// the other body.
///   held, fold:
///           F = s_1 s_2           edges that stick out, 0 with zero slope where a facet lies flat on the other body
///                                 (Ferguson et al., "Geometric contact potential", ACM Trans. Graph. 2025, take the
///                                 local minima of the distance in this way);
///   stopped, moves: F = s_1 t_2 + t_1 s_2 - s_1 s_2   one that sticks out, over any edge of the other face: 1 over
///   another that
///                                 sticks out, 1/4 over one amid a flat face, 0 flat on flat;
///   border: F = t_1 t_2           also where the sides of two faces that lie flat on each other cross, 1/4 there.
/// Parallel edges, whose closest points are not defined, fade by m(x) = (x / e)(2 - x / e), x = sin^2 of the angle
/// between them, below e = 1e-2, 5.7 degrees (Li et al., "Incremental potential contact", ACM Trans. Graph. 39, 2020).
/// y takes a pair from one segment to the next where the edge goes on,
/// within a tenth of the segment to both sides of the node, so that their factors' squares add up to 1 on a straight
/// edge, and to nothing within a twenty-fifth before an end.
std::optional<EdgePair> edge_pair(const PlacedEdge& first, const std::array<EdgeEnd, 2>& ends_1,
                                  const PlacedEdge& second, const std::array<EdgeEnd, 2>& ends_2, PairFactor factor);

/// False where edge_pair gives nothing since the closest points of the lines lie too far beyond an end.
bool may_cross(const std::array<Vec3, 2>& first, const std::array<EdgeEnd, 2>& ends_1,
               const std::array<Vec3, 2>& second, const std::array<EdgeEnd, 2>& ends_2);

}  // namespace carom
