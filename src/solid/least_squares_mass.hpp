// Masses that keep total, centre and inertia.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

struct MassPoint {
  Vec3 x{};
  double mass = 0.0;
};

/// Changes dm_a of the kept masses that make up for the removed ones:
///   minimise sum of (dm_a)^2 / m_a  subject to  sum of dm_a p(x_a) = sum over removed of m p(x),  dm_a >= -(1 - floor)
///   m_a,
/// p running over 1, x, y, z and their products of second degree, so that mass, centre and inertia stay (conditions
/// that follow from others, as in bodies that lie in a plane, are left out). Solved on the conditions' multipliers y by
/// semismooth Newton: dm_a = m_a max(p_a . y, floor - 1) (the dual of a strictly convex quadratic programme is concave
/// and piecewise quadratic; e.g. Hintermueller, Ito and Kunisch, SIAM J. Optim. 13, 2003). Throws std::invalid_argument
/// when there is no solution.
std::vector<double> redistribute(std::span<const MassPoint> kept, std::span<const MassPoint> removed, double floor);

}  // namespace carom
