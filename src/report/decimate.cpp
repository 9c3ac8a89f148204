#include "report/decimate.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

std::vector<std::size_t> decimate(std::span<const double> time, std::span<const double> values, std::size_t intervals) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) && std::isfinite(time[i])) rows.push_back(i);
  }
  if (rows.size() <= 2 * intervals) return rows;
  const double begin = time[rows.front()];
  const double scale = static_cast<double>(intervals) / (time[rows.back()] - begin);
  const auto interval = [&](std::size_t row) { return std::floor((time[row] - begin) * scale); };

  std::vector<std::size_t> kept{rows.front()};
  const auto keep = [&kept](std::size_t row) {
    if (row != kept.back()) kept.push_back(row);
  };
  for (std::size_t i = 0; i < rows.size();) {
    std::size_t smallest = rows[i], largest = rows[i];
    const double current = interval(rows[i]);
    for (++i; i < rows.size() && interval(rows[i]) == current; ++i) {
      if (values[rows[i]] < values[smallest]) smallest = rows[i];
      if (values[rows[i]] > values[largest]) largest = rows[i];
    }
    keep(std::min(smallest, largest));
    keep(std::max(smallest, largest));
  }
  keep(rows.back());
  return kept;
}

}  // namespace carom
