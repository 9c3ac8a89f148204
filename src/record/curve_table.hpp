// One row of named numbers at a time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Names and values of one table; the first column is always `time`.
struct CurveTable {
  std::vector<std::string> columns;
  std::vector<double> row;

  /// Position of a column, if there is one.
  std::optional<std::size_t> find(const std::string& column) const {
    const auto found = std::find(columns.begin(), columns.end(), column);
    if (found == columns.end()) return std::nullopt;
    return static_cast<std::size_t>(found - columns.begin());
  }
};

}  // namespace carom
