// The key figures at the head of the report.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "output/units.hpp"
#include "report/charts.hpp"
#include "report/xy_plot.hpp"

namespace carom {

/// One number with what it is and a remark.
struct KeyFigure {
  std::string title, value, remark;
  double number = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`, where it can be compared with others
  std::string unit{};
};

/// First what does not depend on how contact is enforced: impulse of each contact, how long it was closed, how fast
/// bodies were before and after. Then its peak force and when: the filtered one where its curve is filtered, else that
/// of a step, with the largest mean over the time of a wave through a cell there (Summary::crossings) where this is
/// less. The force of ties, which meet nothing, apart. Of probes' accelerations the filtered peak alone, since nodes of
/// a mesh shake as no sensor does. Head injury criterion and pulse where they are asked for; the largest stress. From
/// the tables and the summary, as far as they are there; of many contacts, probes or parts the largest four in the
/// order of the case, and in one more figure what the others are.
std::vector<KeyFigure> key_figures(const Tables& tables, const std::optional<Summary>& summary, const Units& units);

/// When the largest force of all contacts is, of ties where nothing else has one; nothing where there is none.
std::optional<double> time_of_largest_force(const std::optional<CsvTable>& contact,
                                            const std::vector<std::string>& ties = {});

/// The largest magnitude of something over the run.
struct LargestValue {
  std::string quantity, value, time, where;
  std::string place{};                                       ///< probe, contact or part alone
  double number = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`
  std::string unit{};
};

/// Of every contact the largest force and penetration, of every probe the largest of each of its quantities (of a
/// tensor that of its components), of both what is left of it by their filters, and the largest stress of all.
std::vector<LargestValue> largest_values(const Tables& tables, const std::optional<Summary>& summary,
                                         const Units& units);

/// Of every probe that asks for shock one picture of its spectra, in Hz and g; of its acceleration where the unit
/// system is unknown. Components below a thousandth of the largest are left out.
std::vector<XyPlot> spectrum_plots(const std::optional<CsvTable>& table, const std::optional<Summary>& summary,
                                   const Units& units);

/// The largest of each quantity of each part, with when: "3.41 J", "0.21 ms"; "–" where it is zero.
struct PartValues {
  struct Value {
    std::string value, time;
    double number = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`
    std::string unit{};
  };
  std::vector<std::string> quantities{};
  std::vector<std::string> parts{};
  std::vector<std::vector<Value>> values{};  ///< by part and quantity
};

/// Of parts.csv; empty where it has one part, whose energies are those of the ledger.
PartValues largest_of_parts(const std::optional<CsvTable>& table, const Units& units);

}  // namespace carom
