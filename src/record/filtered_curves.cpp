#include "record/filtered_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "output/cfc_filter.hpp"
#include "output/csv.hpp"
#include "report/csv_table.hpp"

namespace carom {

namespace {

/// What is to be known of a record beside its class; "" when nothing is.
std::string shortness(const std::string& place, double cfc, double seconds) {
  constexpr double enough = 3.0;
  const double periods = seconds * cfc_limit(cfc);
  if (periods >= enough) return {};
  return fmt::format(
      "note: {}: the record of {:.3g} s is {:.2g} periods of the limit of CFC {:g} ({:.4g} Hz), less than {:g}: how "
      "the filter continues its ends shapes all of it",
      place, seconds, periods, cfc, cfc_limit(cfc), enough);
}

}  // namespace

void write_filtered(const FilteredTable& table, const std::vector<FilterWish>& wishes) {
  if (wishes.empty()) return;
  const std::optional<CsvTable> raw = read_csv(table.from);
  if (!raw || raw->rows() < 3) return;
  const double second = si_factor(Dimension::time, table.units);
  std::vector<double> time;
  for (const double t : raw->values[0]) time.push_back(t * second);
  double highest = 0.0, longest = 0.0;
  for (const FilterWish& wish : wishes) highest = std::max(highest, wish.cfc);
  for (std::size_t i = 1; i < time.size(); ++i) longest = std::max(longest, time[i] - time[i - 1]);
  const std::vector<double> at = equal_times(time, highest);
  const double dt = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
  std::vector<std::string> columns{"time"}, header = table.comments;
  std::vector<std::vector<double>> values;
  for (const FilterWish& wish : wishes) {
    std::string last;
    for (const std::string& column : wish.columns) {
      const std::string place = column.substr(0, column.rfind('.'));
      std::string note = place == last ? "" : shortness(place, wish.cfc, at.back() - at.front());
      if (!note.empty()) header.push_back(std::move(note));
      last = place;
      if (longest * wish.cfc > cfc_longest_sampling * (1.0 + 1e-9)) {
        header.push_back(fmt::format(
            "{}: not filtered: CFC {:g} needs a sample at least every {:.3g} s (10 times the class); some are {:.3g} s "
            "apart",
            column, wish.cfc, cfc_longest_sampling / wish.cfc, longest));
        continue;
      }
      values.push_back(cfc_filter(resampled(time, *raw->column(column), at), dt, wish.cfc));
      columns.push_back(column);
      header.push_back(fmt::format("{}: SAE J211 CFC {:g}", column, wish.cfc));
    }
  }
  CsvFile file(table.to, columns, header);
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<double> row{at[i] / second};
    for (const auto& column : values) row.push_back(column[i]);
    file.append(row);
  }
  file.close();
}

}  // namespace carom
