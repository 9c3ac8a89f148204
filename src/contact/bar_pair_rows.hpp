// Rows of bars that touch bars with their sides.
#pragma once

#include <array>
#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// Closest points a(s) and b(t) of two segments, 0 <= s, t <= 1. Of parallel ones, of whose closest points there are
/// many, those in the middle of what lies side by side.
struct SegmentPair {
  double s = 0.0, t = 0.0;
  Vec3 normal{};  ///< from b to a
  double distance = 0.0;
};

/// C. Ericson, Real-Time Collision Detection, 2005, section 5.1.9. Where the segments meet, some normal is taken.
SegmentPair closest_points(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b);

/// One row for every two bars that come near each other, at the closest points of their axes:
///   g = |x_1 - x_2| - r_1 - r_2,  x_1 = (1 - s) a_0 + s a_1,  x_2 = (1 - t) b_0 + t b_1,
/// whose gradient is (1 - s) n, s n, -(1 - t) n, -t n, since it is least in s and t: forces act along the line between
/// the points and leave no moment. Bars that hang together by less than twice the sum of their radii do not see each
/// other. The measure is the lesser side, 2 r L. Multipliers hold a node that is closest for several bars by one of
/// them. Every bar has eight slots; those of the pairs that lie deepest are taken.
///
/// Throws std::invalid_argument naming the contact for friction: bars have no rotations that a force at their sides
/// could turn.
std::unique_ptr<RowMaker> bar_pair_rows(const Model& model, const PairContact& contact, Index source);

}  // namespace carom
