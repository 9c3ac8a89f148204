// One node that looks for the point where it touches a surface, and the facets that count for it.
#pragma once

#include <algorithm>
#include <span>

#include "math/vec3.hpp"
#include "surface/search_range.hpp"
#include "surface/target_surface.hpp"

namespace carom {

/// A node and what it brings along; a value on the stack, whose references and lists outlive it.
struct NodeQuery {
  /// Product of the normals of a node and of a facet that it was behind, from which on it is behind it no longer.
  static constexpr double no_longer_opposed = 0.5;
  /// Product of the normals of facets that pass a node on to each other.
  static constexpr double smooth = 0.5;

  const TargetSurface& surface;
  const SearchRange& range;
  std::span<const Index> excluded;  ///< facets that never count, increasing: neighbours of its own
  Index node;
  Vec3 x;
  Vec3 normal;                           ///< its averaged normal, or zero
  std::span<const Index> candidates;     ///< facets
  std::span<const double> box_distance;  ///< squared, of their boxes
  Index behind = -1;                     ///< the facet that counts which it was behind at x_begin; -1: none
  bool is_behind = false;                ///< it is known to be behind the surface, however deep
  bool moves_sides_out = true;           ///< see SearchRange::moves_sides_out

  bool was_behind() const { return behind >= 0; }
  bool has_normal() const { return dot(normal, normal) > 0.0; }
  bool is_excluded(Index f) const { return std::ranges::binary_search(excluded, f); }
  /// Where the node is, or was at x_begin.
  Projection projection_on(Index f) const { return project(surface.placed(f), x); }
  Projection projection_at_begin(Index f) const {
    return project(surface.placed_at_begin(f), surface.motion().x_begin[node]);
  }

  bool counts(Index f) const {
    if (!excluded.empty() && is_excluded(f)) return false;
    if (!has_normal()) return true;
    const double product = dot(normal, surface.normal(f));
    return product < opposed || (product < no_longer_opposed && stays_behind(f));
  }
  /// True of the facet that the node was behind, and of those that it passes on to from there.
  bool stays_behind(Index f) const {
    return was_behind() && (f == behind || dot(surface.normal(f), surface.normal(behind)) > smooth);
  }
  /// True behind a facet deeper than what touches it can be. What is deep behind a facet of its own body, and has not
  /// come through its front, is the body's other side, however thin the body has become.
  bool is_too_deep(Index f, double gap) const;
  /// How far facet f is continued beyond an end.
  double rim_width(Index f) const;
};

}  // namespace carom
