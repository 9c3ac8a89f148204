// LINE2: the two-node bar in space. Knows no physics.
#pragma once

#include <array>

#include "base/types.hpp"

namespace carom::line2 {

/// Distance of the two nodes.
double length(const std::array<Vec3, 2>& x);
/// Unit vector from node 0 to node 1; not a number when they coincide.
Vec3 axis(const std::array<Vec3, 2>& x);

}  // namespace carom::line2
