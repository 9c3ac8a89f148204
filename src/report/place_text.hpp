// How pages write a place.
#pragma once

#include <string>

#include "base/types.hpp"

namespace carom {

/// "(0, 12.5, 3) mm": a place, without the round-off of coordinates, which is relative to `reach`.
std::string place_text(const Vec3& x, double reach, const std::string& unit);

}  // namespace carom
