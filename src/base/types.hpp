// Plain number and index types shared by every folder.
#pragma once

#include <array>
#include <cstdint>

namespace carom {

/// Local (0-based) index of a node, cell, face or degree of freedom.
using Index = std::int32_t;

/// A vector of space, components x, y, z.
using Vec3 = std::array<double, 3>;

}  // namespace carom
