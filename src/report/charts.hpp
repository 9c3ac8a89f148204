// Which curves the report shows and how they are grouped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "output/units.hpp"
#include "report/csv_table.hpp"

namespace carom {

struct Curve {
  std::string name;
  std::vector<double> time, values;
  bool exact = false;  ///< the exact solution of the curve before it: drawn dashed in the same colour
};

/// One picture: curves of one unit over time.
struct Chart {
  std::string section;  ///< "Energies", "Contact", "Probes", "Time steps"
  std::string title;
  std::string label, unit;  ///< of the vertical axis
  std::vector<Curve> curves;
  std::string note;  ///< what is not drawn and why
};

/// Charts of energy.csv, contact.csv and probes.csv with the columns of the same name in exact.csv laid over them.
/// Components below 1e-9 of the largest of their chart are named in its note instead of drawn; charts that are zero
/// throughout are left out.
std::vector<Chart> make_charts(const std::optional<CsvTable>& energy, const std::optional<CsvTable>& contact,
                               const std::optional<CsvTable>& probes, const std::optional<CsvTable>& exact,
                               const Units& units);

/// The charts as JSON for curves.js, safe inside a <script> element.
std::string charts_json(const std::vector<Chart>& charts, const Units& units);

}  // namespace carom
