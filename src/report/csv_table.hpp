// A table of a results folder as the report reads it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "output/units.hpp"

namespace carom {

struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;  ///< one vector per column, all of one length
  std::vector<std::string> comments;        ///< without "# "
  std::optional<Units> units;               ///< from the comments
  std::string damage;                       ///< why rows were left out; "" when none were

  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
  /// Values of a column or nullptr.
  const std::vector<double>* column(std::string_view name) const;
};

/// Reads a table by the name of its first column; nothing when there is no such file. Stops at the first row that is
/// not whole and says so in `damage`.
std::optional<CsvTable> read_csv(const std::string& path, std::string_view first = "time");

}  // namespace carom
