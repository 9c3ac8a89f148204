#include "record/shock_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "math/vec3.hpp"
#include "output/cfc_filter.hpp"
#include "output/csv.hpp"
#include "output/shock.hpp"
#include "report/csv_table.hpp"

namespace carom {

namespace {

/// A record on equal intervals, in seconds and the case's unit of acceleration.
struct ShockRecord {
  ShockWish wish;  ///< cfc: 0 where it could not be filtered
  double begin = 0.0, dt = 0.0, highest = 0.0;
  std::array<std::vector<double>, 3> a;

  double duration() const { return dt * static_cast<double>(a[0].size() - 1); }
};

ShockRecord record_of(const ShockWish& wish, const CsvTable& table, bool is_filtered, double second) {
  ShockRecord record{wish, 0.0, 0.0, 0.0, {}};
  if (!is_filtered) record.wish.cfc = 0.0;
  std::vector<double> time;
  for (const double t : table.values.front()) time.push_back(t * second);
  const double mean = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  constexpr double finest = 0.25;  // of the mean interval: steps that a guard has shortened are few
  const std::vector<double> at = is_filtered ? time : equal_times(time, 1e-3 / (finest * mean));
  record.begin = at.front();
  record.dt = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
  for (std::size_t c = 0; c < 3; ++c)
    record.a[c] = resampled(time, *table.column(fmt::format("{}.{}_{}", wish.probe, wish.quantity, "xyz"[c])), at);
  constexpr double most = 1e4, to_a_period = 20.0;
  record.highest = std::min(1.0 / (to_a_period * record.dt), record.wish.cfc > 0.0 ? record.wish.cfc : most);
  return record;
}

ShockSummary numbers_of(const ShockRecord& record, UnitSystem units) {
  const double second = si_factor(Dimension::time, units);
  const double g = standard_gravity / si_factor(Dimension::acceleration, units);
  const auto time = [&](double since_begin) { return (record.begin + since_begin) / second; };
  ShockSummary shock{record.wish.probe, record.wish.quantity, record.wish.cfc, record.wish.quality_factor};
  const ShockPulse pulse = shock_pulse(record.a, record.dt);
  shock.peak = pulse.peak;
  shock.peak_g = pulse.peak / g;
  shock.time = time(pulse.time);
  shock.pulse_begin = time(pulse.begin);
  shock.pulse_end = time(pulse.end);
  shock.velocity_change = pulse.velocity_change / second;
  std::vector<double> resultant;
  for (std::size_t i = 0; i < record.a[0].size(); ++i)
    resultant.push_back(norm(Vec3{record.a[0][i], record.a[1][i], record.a[2][i]}) / g);
  const auto hic = [&](double window, double& value, double& begin, double& end) {
    const HeadInjury injury = head_injury_criterion(resultant, record.dt, window);
    value = injury.value;
    begin = time(injury.begin);
    end = time(injury.end);
  };
  hic(0.015, shock.hic15, shock.hic15_begin, shock.hic15_end);
  hic(0.036, shock.hic36, shock.hic36_begin, shock.hic36_end);
  return shock;
}

void write_spectra(const ShockTables& tables, const std::vector<ShockRecord>& records) {
  double highest = 0.0;
  for (const ShockRecord& record : records) highest = std::max(highest, record.highest);
  const double second = si_factor(Dimension::time, tables.units);
  const std::vector<double> frequencies = spectrum_frequencies(records.front().duration(), highest);
  std::vector<std::string> columns{"frequency"}, header = tables.comments;
  std::vector<std::vector<double>> values;
  for (const ShockRecord& record : records)
    for (std::size_t c = 0; c < 3; ++c) {
      columns.push_back(fmt::format("{}.{}_{}", record.wish.probe, record.wish.quantity, "xyz"[c]));
      const auto own = std::ranges::upper_bound(frequencies, record.highest * (1.0 + 1e-9));
      values.push_back(
          shock_response_spectrum(record.a[c], record.dt, {frequencies.begin(), own}, record.wish.quality_factor));
      values.back().resize(frequencies.size(), std::numeric_limits<double>::quiet_NaN());
      header.push_back(fmt::format("{}: maximax absolute acceleration, Q = {:g}, {}", columns.back(),
                                   record.wish.quality_factor,
                                   record.wish.cfc > 0.0 ? fmt::format("of the record behind CFC {:g}", record.wish.cfc)
                                                         : "of the record as it is"));
    }
  CsvFile file(tables.spectra, columns, header);
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    std::vector<double> row{frequencies[k] * second};
    for (const std::vector<double>& column : values) row.push_back(column[k]);
    file.append(row);
  }
  file.close();
}

}  // namespace

std::vector<ShockSummary> write_shock(const ShockTables& tables, const std::vector<ShockWish>& wishes) {
  if (wishes.empty()) return {};
  const std::optional<CsvTable> raw = read_csv(tables.raw), filtered = read_csv(tables.filtered);
  if (!raw || raw->rows() < 3) return {};
  std::vector<ShockRecord> records;
  std::vector<ShockSummary> all;
  for (const ShockWish& wish : wishes) {
    const bool is_filtered =
        wish.cfc > 0.0 && filtered && filtered->column(fmt::format("{}.{}_x", wish.probe, wish.quantity)) != nullptr;
    records.push_back(
        record_of(wish, is_filtered ? *filtered : *raw, is_filtered, si_factor(Dimension::time, tables.units)));
    all.push_back(numbers_of(records.back(), tables.units));
  }
  write_spectra(tables, records);
  return all;
}

}  // namespace carom
