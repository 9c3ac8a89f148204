// Which curves the report shows and how they are grouped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"
#include "report/csv_table.hpp"

namespace carom {

/// --curve-1 and so on in page.css.
inline constexpr std::size_t colours_of_curves = 8;

/// What is below this share of the largest is left out of pictures and figures.
inline constexpr double kNegligible = 1e-9;

/// How a curve is drawn: a filtered one over the raw one of its colour, which is then pale; the exact solution dashed
/// over both.
enum class CurveKind : std::uint8_t { computed, raw, filtered, exact };

struct Curve {
  std::string name;
  std::vector<double> time, values;
  CurveKind kind{};
  bool shown = true;                    ///< until the reader clicks its name
  std::optional<std::size_t> colour{};  ///< its number where curves of several charts belong together
  std::optional<std::size_t> line{};    ///< the number of its dashes where curves of one colour are told apart by them
};

/// One picture: curves of one unit over time. Without curves it is a statement: the title and the note as text.
struct Chart {
  std::string section;  ///< "Energies", "Contact", "Probes", "Parts", "Time steps"
  std::string title;
  std::string label, unit;  ///< of the vertical axis
  std::vector<Curve> curves;
  std::string note;        ///< what is not drawn and why
  std::string place{};     ///< of a probe
  bool is_count = false;   ///< whole numbers
  bool is_folded = false;  ///< shown to readers who ask for it
};

/// A moment that is marked in every picture.
struct TimeMark {
  double time = 0.0;
  std::string name;
};

/// All that curves.js draws.
struct ChartData {
  std::vector<Chart> charts;
  std::string time_unit;
  std::vector<TimeMark> marks{};
};

/// The tables of a results folder, as far as they are there.
struct Tables {
  std::optional<CsvTable> energy{}, contact{}, probes{}, parts{}, probes_filtered{}, contact_filtered{}, exact{};
  std::optional<CsvTable> spectra{};  ///< over frequency
  std::vector<std::string> ties{};    ///< contacts that hold together and meet nothing
};

/// What numbers are compared with before they are called round-off; zero where nothing is known.
struct Scales {
  double energy = 0.0;    ///< the largest of the run
  double momentum = 0.0;  ///< of all mass with that energy
  double speed = 0.0;     ///< likewise
  double reach = 0.0;     ///< of the model from the origin
};
Scales scales_of(const Tables& tables, const std::optional<Summary>& summary);

/// A column over the table's times, reduced to what a screen can show (decimate.hpp).
Curve make_curve(const CsvTable& table, const std::vector<double>& values, std::string name, CurveKind kind);

/// Charts of probes, contact, energies, and where there are several parts of these: one for each quantity, a curve for
/// each part in the colour that it has in the view, of many the largest shown; columns of the same name in
/// probes_filtered.csv, contact_filtered.csv and exact.csv are laid over. The mechanical energy is drawn with its
/// terms. Components below 1e-9 of the largest of their chart are named in its note instead of drawn. What is round-off
/// is said instead of drawn: a whole chart below 1e-12 of the largest of its quantity, energies below 1e-10 of the
/// largest of the run, imbalances within the bound of a verdict that passed.
std::vector<Chart> make_charts(const Tables& tables, const Units& units,
                               const std::optional<Summary>& summary = std::nullopt);

/// The charts that have curves as JSON for curves.js, safe inside a <script> element; numbers as they are, beside the
/// unit and the power of ten in which they are to be read (readable_unit.hpp).
std::string charts_json(const ChartData& data);

}  // namespace carom
