// How far the search for the points where nodes touch a surface looks.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/facet.hpp"

namespace carom {

/// The lengths that say how far a search looks.
struct SearchRange {
  /// Of a facet's size: its continuation beyond an end of the surface.
  static constexpr double rim_slack = 0.1;
  /// Of a facet's size: how far sides that do not count are moved out.
  static constexpr double side_slack = 0.02;

  double reach = 0.0;           ///< largest distance of a point that counts
  double margin = 0.0;          ///< of the lists that are kept (BroadPhase)
  std::vector<double> depth;    ///< of each facet: largest distance behind it that counts
  std::vector<double> width;    ///< of each facet: how far it acts beyond its edges (none: where it is nearest only)
  std::vector<Index> body{};    ///< by node, where nodes may touch their own body; else empty
  bool moves_sides_out = true;  ///< sides that do not count, always; else where nobody knows what was behind alone
  bool fades = true;  ///< gaps fade beyond the end of the surface, as the potential of springs has to; multipliers,
                      ///< whose rows would depend on each other there, keep them whole

  /// The distance up to which the direction to an edge or a corner is round-off.
  double tiny() const { return 1e-6 * reach; }
  /// Of a node; all are of one where nodes do not touch their own.
  Index body_of(Index node) const { return body.empty() ? 0 : body[node]; }
};

/// For SearchRange::width: a tenth of each facet's size.
std::vector<double> edge_widths(std::span<const Vec3> coordinates, std::span<const Facet> facets);

}  // namespace carom
