// Plain number and index types shared by every folder.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace carom {

/// Local (0-based) index of a node, cell, face or degree of freedom.
using Index = std::int32_t;

/// A vector of space, components x, y, z.
using Vec3 = std::array<double, 3>;

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// An index as the position in a container that it is.
constexpr std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

}  // namespace carom
