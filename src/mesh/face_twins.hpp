// Which faces of cells are the same.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// The corners of a face in increasing order, by which it is known; what it does not need is larger than any.
using FaceKey = std::array<Index, 4>;
FaceKey face_key(std::span<const Index> corners);

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// Of each face the position of another one with the same key, no_twin where there is none. Time is linear in the
/// number of faces while few have their smallest node in common.
std::vector<std::uint32_t> face_twins(std::span<const FaceKey> faces, std::size_t node_count);

}  // namespace carom
