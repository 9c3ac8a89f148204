// Which curves the report shows and how they are grouped.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/units.hpp"
#include "report/csv_table.hpp"

namespace carom {

/// How a curve is drawn: the exact solution is dashed over the computed curve before it.
enum class CurveKind : std::uint8_t { computed, filtered, exact };

struct Curve {
  std::string name;
  std::vector<double> time, values;
  CurveKind kind{};
  bool shown = true;  ///< until the reader clicks its name
};

/// One picture: curves of one unit over time.
struct Chart {
  std::string section;  ///< "Energies", "Contact", "Probes", "Time steps"
  std::string title;
  std::string label, unit;  ///< of the vertical axis
  std::vector<Curve> curves;
  std::string note;  ///< what is not drawn and why
};

/// The tables of a results folder, as far as they are there.
struct Tables {
  std::optional<CsvTable> energy{}, contact{}, probes{}, probes_filtered{}, exact{};
};

/// A column over the table's times, reduced to what a screen can show (decimate.hpp).
Curve make_curve(const CsvTable& table, const std::vector<double>& values, std::string name, CurveKind kind);

/// Charts of probes, contact and energies; columns of the same name in probes_filtered.csv and exact.csv are laid over.
/// Components below 1e-9 of the largest of their chart are named in its note instead of drawn; charts that are zero
/// throughout are left out.
std::vector<Chart> make_charts(const Tables& tables, const Units& units);

/// The charts as JSON for curves.js, safe inside a <script> element.
std::string charts_json(const std::vector<Chart>& charts, const Units& units);

}  // namespace carom
