#include "compare/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>

#include "base/errors.hpp"
#include "energy/energy_terms.hpp"
#include "output/units.hpp"

namespace carom::compare {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double largest_magnitude(std::span<const double> values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

std::string quantity_of(const std::string& column) {
  return std::string(parse_column(column).quantity);
}

/// Columns that two runs of one case can be compared by.
bool is_compared(const std::string& column) {
  const ColumnName name = parse_column(column);
  if (!name.place.empty())
    return name.quantity != "impulse" && name.quantity != "moment" && name.quantity != "penetration" &&
           name.quantity != "closed" && name.quantity != "closings";
  return std::any_of(energy_terms.begin(), energy_terms.end(),
                     [&](const EnergyTerm& term) { return term.kind == TermKind::stored && term.name == column; });
}

/// Curves with the times they stand at.
struct ReferenceCurves {
  const CsvTable* table = nullptr;
  std::vector<std::string> columns;
};

ReferenceCurves reference_curves(const CsvTable& table, bool is_exact) {
  ReferenceCurves reference{&table, {}};
  std::map<std::string, double> largest;
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    double& most = largest[quantity_of(table.columns[c])];
    most = std::max(most, largest_magnitude(table.values[c]));
  }
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    const std::string& column = table.columns[c];
    const bool is_zero = largest_magnitude(table.values[c]) <= 1e-9 * largest[quantity_of(column)];
    if ((is_exact || is_compared(column)) && !is_zero) reference.columns.push_back(column);
  }
  return reference;
}

void compare_curves(Result& result, const ReferenceCurves& reference) {
  const std::vector<double>& times = reference.table->values.front();
  std::map<std::string, std::size_t> position;
  std::vector<Deviation> sums;
  for (const std::string& column : reference.columns) {
    const std::vector<double>* values = result.curves.column(column);
    if (values == nullptr) continue;
    const std::vector<double>& r = *reference.table->column(column);
    const Deviation d = deviation(times, interpolated(result.curves.values.front(), *values, times), r);
    result.columns.push_back({column, d.l2(), d.l1()});
    const std::string quantity = quantity_of(column);
    if (position.emplace(quantity, sums.size()).second) {
      sums.emplace_back();
      result.quantities.push_back({quantity, 0.0, 0.0});
    }
    sums[position[quantity]] += d;
    if (quantity != "force") continue;
    result.peak_force = std::max(result.peak_force, largest_magnitude(*values));
    result.reference_peak_force = std::max(result.reference_peak_force, largest_magnitude(r));
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    result.quantities[i].l2 = sums[i].l2();
    result.quantities[i].l1 = sums[i].l1();
  }
}

/// Appends the columns of a table with the same rows.
void append(CsvTable& all, const std::optional<CsvTable>& more) {
  if (!more) return;
  if (all.columns.empty()) {
    all = *more;
    return;
  }
  if (more->rows() != all.rows()) throw std::runtime_error("its tables have rows of different times");
  all.columns.insert(all.columns.end(), more->columns.begin() + 1, more->columns.end());
  all.values.insert(all.values.end(), more->values.begin() + 1, more->values.end());
}

/// What is left of a message once "error: " and the place in the generated case are gone.
std::string plain_message(std::string log) {
  while (!log.empty() && log.back() == '\n') log.pop_back();
  const std::size_t error = log.rfind("error: ");
  if (error != std::string::npos) log.erase(0, error + 7);
  const std::size_t place = log.find("case.toml:");
  if (place == std::string::npos) return log;
  const std::size_t end = log.find(": ", place);
  return end == std::string::npos ? log : log.substr(end + 2);
}

std::string failure_of(const Result& result, const std::string& log) {
  if (result.exit_code == 2) return "not allowed: " + plain_message(log);
  if (result.exit_code < 0) return "not started";
  if (result.exit_code > 128) return fmt::format("ended by signal {}", result.exit_code - 128);
  if (!result.summary) return plain_message(log);
  const bool at_end = result.summary->outcome == Outcome::good || result.summary->outcome == Outcome::failed;
  return at_end ? "" : result.summary->message;
}

double worst_penetration(const CsvTable& curves) {
  double worst = kNone;
  for (std::size_t c = 1; c < curves.columns.size(); ++c) {
    if (!curves.columns[c].ends_with(".penetration")) continue;
    for (const double v : curves.values[c]) worst = std::fmax(worst, v);
  }
  return worst;
}

}  // namespace

Deviation& Deviation::operator+=(const Deviation& o) {
  square += o.square;
  reference_square += o.reference_square;
  magnitude += o.magnitude;
  reference_magnitude += o.reference_magnitude;
  return *this;
}

double Deviation::l2() const {
  return reference_square > 0.0 ? std::sqrt(square / reference_square) : kNone;
}

double Deviation::l1() const {
  return reference_magnitude > 0.0 ? magnitude / reference_magnitude : kNone;
}

Deviation deviation(std::span<const double> time, std::span<const double> values, std::span<const double> reference) {
  Deviation sum;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double before = i > 0 ? time[i] - time[i - 1] : 0.0;
    const double after = i + 1 < time.size() ? time[i + 1] - time[i] : 0.0;
    const double weight = 0.5 * (before + after), d = values[i] - reference[i], r = reference[i];
    sum += {weight * d * d, weight * r * r, weight * std::abs(d), weight * std::abs(r)};
  }
  return sum;
}

std::vector<double> interpolated(std::span<const double> from, std::span<const double> values,
                                 std::span<const double> to) {
  std::vector<double> out;
  out.reserve(to.size());
  for (const double t : to) {
    const auto next = static_cast<std::size_t>(std::lower_bound(from.begin(), from.end(), t) - from.begin());
    if (next == from.size()) {
      out.push_back(values.back());
    } else if (next == 0 || from[next] == t) {
      out.push_back(values[next]);
    } else {
      const double w = (t - from[next - 1]) / (from[next] - from[next - 1]);
      out.push_back(values[next - 1] + w * (values[next] - values[next - 1]));
    }
  }
  return out;
}

double energy_kept(const CsvTable& energy) {
  if (energy.rows() == 0 || energy.column("kinetic") == nullptr) return kNone;
  const auto terms_at = [&](std::size_t row) {
    EnergyTerms terms;
    for (const EnergyTerm& term : energy_terms) {
      const std::vector<double>* values = energy.column(std::string(term.name));
      terms.*term.value = values == nullptr ? 0.0 : (*values)[row];
    }
    return terms;
  };
  const std::size_t last = energy.rows() - 1;
  const double begin = terms_at(0).mechanical();
  double scale = begin;
  for (std::size_t row = 0; row <= last; ++row) scale = std::max(scale, std::abs(terms_at(row).supplied()));
  const EnergyTerms end = terms_at(last);
  const double lost = begin + end.supplied() - (end.lost() - end.impact - end.viscous) - end.mechanical();
  return scale > 0.0 ? 1.0 - lost / scale : kNone;
}

bool Result::passed() const {
  return summary && failure.empty() && (failed_items().empty() || has_rounding_only());
}

bool Result::has_rounding_only() const {
  constexpr double rounding = 1e-8;  // of the energy: far below every error that curves are ranked by
  const auto is_passed = [](const VerdictItem& item) { return item.pass; };
  const auto is_rounding = [&](const VerdictItem& item) {
    return item.pass || (item.name == "energy balance" && item.value <= rounding);
  };
  return summary && !std::all_of(summary->verdict.begin(), summary->verdict.end(), is_passed) &&
         std::all_of(summary->verdict.begin(), summary->verdict.end(), is_rounding);
}

std::vector<std::string> Result::failed_items() const {
  std::vector<std::string> items;
  if (!summary) return items;
  for (const VerdictItem& item : summary->verdict) {
    if (!item.pass) items.push_back(fmt::format("{} {:.3g} > {:g}", item.name, item.value, item.limit));
  }
  return items;
}

double Result::error(const std::string& quantity) const {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedError& e) { return e.name == quantity; });
  return found == quantities.end() ? kNone : found->l2;
}

Result read_result(const Variant& variant, const std::string& folder, int exit_code, const std::string& log) {
  Result result;
  result.variant = variant;
  result.exit_code = exit_code;
  result.energy_kept = result.penetration = kNone;
  if (exit_code < 0 || exit_code == 2) {
    result.failure = failure_of(result, log);
    return result;
  }
  try {
    result.summary = read_summary(folder + "/summary.json");
    for (const char* name : {"probes.csv", "contact.csv", "energy.csv"})
      append(result.curves, read_csv(folder + "/" + name));
    result.exact = read_csv(folder + "/exact.csv");
    result.energy_kept = energy_kept(result.curves);
    result.penetration = worst_penetration(result.curves);
    result.failure = failure_of(result, log);
  } catch (const std::runtime_error& error) {
    result.failure = result.summary ? error.what() : failure_of(result, log);
  }
  return result;
}

double variation(const CsvTable& curves) {
  double most = 0.0;
  for (const char* wanted : {"force", "velocity"}) {
    for (std::size_t c = 1; c < curves.columns.size(); ++c) {
      const std::vector<double>& f = curves.values[c];
      const double scale = largest_magnitude(f);
      if (quantity_of(curves.columns[c]) != wanted || scale == 0.0) continue;
      double sum = 0.0;
      for (std::size_t i = 1; i < f.size(); ++i) sum += std::abs(f[i] - f[i - 1]);
      most = std::max(most, 0.5 * sum / scale);
    }
    if (most > 0.0) return most;
  }
  return most;
}

namespace {

/// The run that the others are compared with.
Result& choose_reference(const std::vector<Result*>& ended, const std::string& named) {
  std::vector<Result*> candidates;
  for (Result* r : ended)
    if (r->variant.label.find(named) != std::string::npos) candidates.push_back(r);
  if (candidates.empty()) {
    std::vector<std::string> labels;
    for (const Result* r : ended) labels.push_back(fmt::format("\"{}\"", r->variant.label));
    throw CaseError({"command line"}, "--reference",
                    fmt::format("\"{}\", which no run that reached its end has in its name", named),
                    fmt::format("a part of one of {}", fmt::join(labels, ", ")));
  }
  const auto key = [](const Result* r) {
    return std::tuple(r->summary->mesh.cells, r->passed(), -variation(r->curves), r->summary->scheme.steps);
  };
  return **std::max_element(candidates.begin(), candidates.end(),
                            [&](const Result* a, const Result* b) { return key(a) < key(b); });
}

}  // namespace

bool Result::has_contact() const {
  return std::any_of(curves.columns.begin(), curves.columns.end(),
                     [](const std::string& column) { return column.ends_with(".penetration"); });
}

bool shares_nothing(const Result& a, const Result& b) {
  constexpr double same = 1e-6;  // steps that differ by rounding alone
  const bool has_other_step = std::abs(a.step() - b.step()) > same * std::max(a.step(), b.step());
  const bool has_other_enforcement = !a.has_contact() || a.variant.enforcement != b.variant.enforcement;
  return a.variant.cells != b.variant.cells && has_other_step && has_other_enforcement;
}

double difference(const Result& of, const Result& against, const std::string& quantity) {
  Result compared;
  compared.curves = of.curves;
  compare_curves(compared, reference_curves(against.curves, false));
  return compared.error(quantity);
}

ReferenceKind measure(std::vector<Result>& results, const std::string& named) {
  std::vector<Result*> ended;
  for (Result& result : results) {
    if (result.failure.empty()) ended.push_back(&result);
  }
  const bool is_exact = std::all_of(ended.begin(), ended.end(), [](const Result* r) { return r->exact.has_value(); });
  if (named.empty() && is_exact) {
    for (Result* result : ended) {
      compare_curves(*result, reference_curves(*result->exact, true));
      result->is_judged = true;
    }
    return ReferenceKind::exact;
  }
  Result& finest = choose_reference(ended, named);
  finest.is_reference = true;
  finest.is_named = !named.empty();
  const ReferenceCurves reference = reference_curves(finest.curves, false);
  for (Result* result : ended) {
    compare_curves(*result, reference);
    result->is_judged = shares_nothing(*result, finest);
  }
  return named.empty() ? ReferenceKind::finest : ReferenceKind::named;
}

std::string ranking_quantity(const std::vector<Result>& results) {
  std::string first;
  for (const char* wanted : {"force", "velocity"}) {
    for (const Result& result : results) {
      if (std::isfinite(result.error(wanted))) return wanted;
    }
  }
  for (const Result& result : results) {
    if (!result.quantities.empty()) return result.quantities.front().name;
  }
  return first;
}

}  // namespace carom::compare
