// Long curves, reduced to what a screen can show.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace carom {

/// Rows to draw so that the curve looks the same: all of them up to 2 intervals, else the first and the last finite row
/// and the rows of the smallest and largest value in each of `intervals` equal intervals of time. Ascending; rows that
/// are not finite are left out. Precondition: time does not decrease.
std::vector<std::size_t> decimate(std::span<const double> time, std::span<const double> values, std::size_t intervals);

}  // namespace carom
