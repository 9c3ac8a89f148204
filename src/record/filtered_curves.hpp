// Curves of a run that are filtered by a channel frequency class, written after its end.
#pragma once

#include <string>
#include <vector>

#include "base/units.hpp"

namespace carom {

/// Columns that ask for a class, those of one place one after the other.
struct FilterWish {
  double cfc = 0.0;
  std::vector<std::string> columns;
};

/// A table and where it goes to.
struct FilteredTable {
  std::string from, to;               ///< files
  std::vector<std::string> comments;  ///< the first lines
  UnitSystem units = UnitSystem::si;
};

/// Writes the columns filtered, on equal intervals of time, with the class of each in the comments, and why a column
/// could not be filtered. Nothing where nothing is wished for or the table has less than three rows.
void write_filtered(const FilteredTable& table, const std::vector<FilterWish>& wishes);

}  // namespace carom
