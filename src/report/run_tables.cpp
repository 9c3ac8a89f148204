#include "report/run_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "report/case_differences.hpp"

namespace carom {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What a run has in a row: as text, and where it can be compared as a number.
struct Entry {
  std::string text = "–";
  double number = kNone;
  std::string unit{};
  bool is_plain = false;  ///< the text is the number as it is, not in a readable unit
  double rounding = 0.0;  ///< differences up to it say nothing
};

std::string plain_number(double value, int digits, const std::string& unit) {
  return number_text(value, digits) + (unit.empty() ? "" : " " + unit);
}

std::string difference_text(const Entry& first, const Entry& other) {
  const double difference = other.number - first.number;
  if (std::isnan(difference)) return "–";
  if (difference == 0.0) return "none";
  const double largest = std::max(std::abs(first.number), std::abs(other.number));
  constexpr double bits = 1e-12;  // of sums over many steps
  if (std::abs(difference) <= std::max({bits * largest, first.rounding, other.rounding})) return "round-off";
  const auto is_signed = [difference](const std::string& text) { return (difference > 0.0 ? "+" : "") + text; };
  std::string text = is_signed(other.is_plain ? plain_number(difference, 3, other.unit)
                                              : with_readable_unit(difference, other.unit, 3));
  const double share = 100.0 * difference / std::abs(first.number);
  constexpr double most = 1000.0;  // percent; more says no more than the values themselves
  if (std::abs(share) <= most) text += fmt::format(" ({} %)", is_signed(fmt::format("{:.3g}", share)));
  return text;
}

/// A KeyFigure, a LargestValue or a value of parts. What is counted (g, the head injury criterion) is written without
/// prefixes, and so is its difference.
template <class Figure>
Entry entry_of(const Figure& f) {
  return {f.value, f.number, f.unit, f.unit.empty() || f.unit == "g"};
}

/// One row per name in the order in which the runs know them.
class Rows {
 public:
  explicit Rows(const std::vector<NamedRun>& runs) : runs_(runs) {}

  void set(const std::string& name, std::size_t run, Entry entry) {
    auto [row, is_new] = entries_.try_emplace(name, runs_.size());
    if (is_new) names_.push_back(name);
    row->second[run] = std::move(entry);
  }

  DataTable table(std::string title, std::string heading) const {
    DataTable table{std::move(title), {{std::move(heading)}}, {}};
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      table.columns.push_back({runs_[r].name, true});
      if (r > 0) table.columns.push_back({fmt::format("{} − {}", runs_[r].name, runs_.front().name), true});
    }
    for (const std::string& name : names_) {
      const std::vector<Entry>& entries = entries_.at(name);
      table.rows.push_back({name});
      for (std::size_t r = 0; r < entries.size(); ++r) {
        table.rows.back().push_back(entries[r].text);
        if (r > 0) table.rows.back().push_back(difference_text(entries.front(), entries[r]));
      }
    }
    return table;
  }

 private:
  const std::vector<NamedRun>& runs_;
  std::vector<std::string> names_;
  std::map<std::string, std::vector<Entry>> entries_;
};

/// With an ellipsis where it is long; never within a character of UTF-8.
std::string cut(const std::string& text) {
  constexpr std::size_t most = 160;
  if (text.size() <= most) return text;
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "…";
}

/// A row where not all runs have the same text.
template <class TextOf>
void add_if_different(DataTable& table, const std::vector<NamedRun>& runs, const std::string& name,
                      const TextOf& text_of) {
  std::vector<std::string> row{name};
  for (const NamedRun& run : runs) row.push_back(run.data.summary ? text_of(*run.data.summary) : "–");
  if (std::any_of(row.begin() + 2, row.end(), [&row](const std::string& text) { return text != row[1]; }))
    table.rows.push_back(std::move(row));
}

/// Is an energy zero in all runs?
bool none_has(const std::vector<NamedRun>& runs, const std::string& energy) {
  return std::all_of(runs.begin(), runs.end(), [&energy](const NamedRun& run) {
    if (!run.data.summary) return true;
    const std::vector<NamedValue>& ledger = run.data.summary->ledger;
    return std::none_of(ledger.begin(), ledger.end(),
                        [&energy](const NamedValue& term) { return term.name == energy && term.value != 0.0; });
  });
}

}  // namespace

DataTable input_differences(const std::vector<NamedRun>& runs) {
  DataTable table{"What differs in the inputs", {{"Key"}}, {}};
  std::vector<CaseText> cases;
  for (const NamedRun& run : runs) {
    table.columns.push_back({run.name});
    cases.push_back({run.data.folder, run.data.case_text});
  }
  const bool all_there = std::none_of(cases.begin(), cases.end(), [](const CaseText& c) { return c.text.empty(); });
  for (const KeyDifference& difference : all_there ? case_differences(cases) : std::vector<KeyDifference>()) {
    table.rows.push_back({difference.key});
    for (const std::string& value : difference.values) table.rows.back().push_back(cut(value));
  }
  const auto add = [&](const char* name, const auto& text_of) { add_if_different(table, runs, name, text_of); };
  add("nodes of the mesh", [](const Summary& s) { return fmt::format("{}", s.mesh.nodes); });
  add("cells of the mesh", [](const Summary& s) { return fmt::format("{}", s.mesh.cells); });
  add("checksum of the mesh",
      [](const Summary& s) { return s.mesh.checksum.empty() ? std::string("not known") : s.mesh.checksum; });
  add("version of carom", [](const Summary& s) { return s.program.version; });
  add("instruction set", [](const Summary& s) { return s.program.isa; });
  add("threads", [](const Summary& s) { return fmt::format("{}", s.program.threads); });
  return table;
}

DataTable figures_of_runs(const std::vector<NamedRun>& runs) {
  Rows rows(runs);
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const KeyFigure& f : runs[r].data.figures) rows.set(f.title, r, entry_of(f));
  return rows.table("Key figures", "Figure");
}

DataTable largest_of_runs(const std::vector<NamedRun>& runs) {
  const char* const title = "Largest values";
  if (runs.size() == 1) {
    DataTable table{title, {{"Quantity"}, {"value", true}, {"time", true}, {"where"}}, {}};
    for (const LargestValue& l : runs.front().data.largest)
      table.rows.push_back({l.quantity, l.value, l.time, l.where});
    return table;
  }
  Rows rows(runs);
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const LargestValue& l : runs[r].data.largest)
      rows.set(fmt::format("{}, {}", l.quantity, l.place), r, entry_of(l));
  return rows.table(title, "Quantity");
}

DataTable parts_of_runs(const std::vector<NamedRun>& runs) {
  const char* const title = "Largest values of the parts";
  DataTable table{title, {{"Part"}, {"quantity"}, {"value", true}, {"time", true}}, {}};
  Rows rows(runs);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const PartValues& of = runs[r].data.parts;
    for (std::size_t p = 0; p < of.parts.size(); ++p)
      for (std::size_t q = 0; q < of.quantities.size(); ++q) {
        const PartValues::Value& value = of.values[p][q];
        if (!std::isnan(value.number)) table.rows.push_back({of.parts[p], of.quantities[q], value.value, value.time});
        rows.set(fmt::format("{}, {}", of.parts[p], of.quantities[q]), r, entry_of(value));
      }
  }
  return runs.size() == 1 ? table : rows.table(title, "Part and quantity");
}

DataTable checks_of_runs(const std::vector<NamedRun>& runs) {
  Rows rows(runs);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r].data.summary) continue;
    const Units& units = runs[r].data.units;
    for (const CheckSummary& check : runs[r].data.summary->checks) {
      const std::string unit = unit_of_column(units, check.quantity);
      const std::string name = fmt::format("{} at t = {}", check.name, plain_number(check.time, 6, units.time));
      rows.set(
          name, r,
          {fmt::format("{} {}", plain_number(check.value, 7, unit), check.pass ? "✓" : "✗"), check.value, unit, true});
    }
  }
  return rows.table("Checks", "Quantity");
}

DataTable energies_of_runs(const std::vector<NamedRun>& runs) {
  Rows rows(runs);
  const std::string& unit = runs.front().data.units.energy;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r].data.summary) continue;
    double largest = 0.0;
    for (const NamedValue& term : runs[r].data.summary->ledger) largest = std::max(largest, std::abs(term.value));
    for (const NamedValue& term : runs[r].data.summary->ledger) {
      if (none_has(runs, term.name)) continue;
      std::string name = term.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      rows.set(name, r, {number_text(term.value, 6), term.value, "", true, 1e-10 * largest});
    }
  }
  return rows.table("Energy at the end", unit.empty() ? "energy" : fmt::format("energy [{}]", unit));
}

std::string tables_text(const std::vector<NamedRun>& runs, const std::string& format) {
  std::string text;
  for (const DataTable& table :
       {runs.size() > 1 ? input_differences(runs) : DataTable{}, figures_of_runs(runs), checks_of_runs(runs),
        largest_of_runs(runs), parts_of_runs(runs), energies_of_runs(runs)})
    if (!table.rows.empty()) text += (text.empty() ? "" : "\n") + format_table(table, format);
  return text;
}

}  // namespace carom
