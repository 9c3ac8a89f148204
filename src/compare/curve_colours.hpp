// Which colour a variant has in all pictures of a comparison.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/measure.hpp"

namespace carom::compare {

/// By position of the result the number of its colour: that of its scheme; where all have one scheme, that of its
/// enforcement; where all have one enforcement as well, its own.
std::vector<std::size_t> curve_colours(const std::vector<Result>& results);

}  // namespace carom::compare
