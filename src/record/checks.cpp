#include "record/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

/// energy.csv has plain column names, the other tables have place.quantity.
std::string column_name(const CaseCheck& check) {
  constexpr std::string_view energy = "energy.", contact = "contact.";
  std::string quantity = *check.quantity;
  if (quantity.starts_with(energy)) return quantity.substr(energy.size());
  if (quantity.starts_with(contact)) quantity = quantity.substr(contact.size());
  return check.place ? **check.place + "." + quantity : quantity;
}

/// What to write instead of a column that is not there: where one surface touches itself, forces are those between its
/// parts; else a near spelling.
std::string remedy(const CaseCheck& check, const std::string& name, const std::vector<std::string>& columns) {
  const std::string quantity = name.substr(name.rfind('.') + 1), place = check.place ? **check.place + "." : "";
  std::vector<std::string> between;
  for (const std::string& column : columns) {
    if (!place.empty() && column.starts_with(place) && column.ends_with("." + quantity))
      between.push_back(fmt::format("\"{}\"", column.substr(0, column.rfind('.'))));
  }
  if (!between.empty())
    return fmt::format("Forces of this contact are those between parts: place = {}.", fmt::join(between, " or "));
  const std::string near = nearest(name, columns);
  return near.empty() ? "" : fmt::format("Did you mean \"{}\"?", near);
}

}  // namespace

Checks::Checks(const Simulation& simulation, const std::vector<const CurveTable*>& tables, const ExactCurves* exact)
    : case_(simulation.given()) {
  for (const CaseCheck& check : case_.checks) watches_.push_back(watch(check, tables, exact));
}

Checks::Watch Checks::watch(const CaseCheck& check, const std::vector<const CurveTable*>& tables,
                            const ExactCurves* exact) const {
  const std::string name = column_name(check);
  if (check.place && check.quantity->starts_with("energy.")) {
    throw CaseError(check.place->where, "check.place", fmt::format("\"{}\" beside {}", **check.place, *check.quantity),
                    "no place: energies are those of the whole case");
  }
  Watch w;
  w.name = name;
  w.time = check.time ? **check.time : *case_.time.end;
  w.reference = check.value ? **check.value : 0.0;
  std::vector<std::string> all;
  for (const CurveTable* table : tables) {
    all.insert(all.end(), table->columns.begin() + 1, table->columns.end());
    const auto column = table->find(name);
    if (!column) continue;
    w.table = table;
    w.column = *column;
  }
  if (w.table == nullptr) {
    throw CaseError(check.quantity.where, "check.quantity",
                    fmt::format("\"{}\", which no table of this run holds", name),
                    "a column of probes.csv or contact.csv (with `place`), or energy.<term>", remedy(check, name, all));
  }
  if (check.exact) {
    const std::optional<double> reference = exact == nullptr ? std::nullopt : exact->value(name, w.time);
    if (!reference) {
      throw CaseError(check.where, "check.reference", fmt::format("no exact value of \"{}\"", name),
                      "a quantity that [exact] covers: displacement, velocity or stress along its axis, contact force, "
                      "energy.kinetic, energy.strain, energy.contact_stored");
    }
    w.reference = *reference;
  }
  return w;
}

bool Checks::is_due(double t, double dt) const {
  constexpr double slack = 1.0 + 1e-6;
  return std::any_of(watches_.begin(), watches_.end(),
                     [&](const Watch& w) { return !w.value && std::abs(t - w.time) <= slack * dt; });
}

void Checks::sample(double t) {
  for (Watch& w : watches_) {
    if (w.value) continue;
    const double now = w.table->row[w.column];
    const double slack = 1e-9 * *case_.time.end;  // far below any step, far above the round-off of a time
    if (std::abs(t - w.time) <= slack) {
      w.value = now;
    } else if (t > w.time) {
      w.value = w.last_value + (now - w.last_value) * (w.time - w.last_time) / (t - w.last_time);
    }
    w.last_time = t;
    w.last_value = now;
  }
}

std::vector<CheckSummary> Checks::results() const {
  std::vector<CheckSummary> results;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    const Watch& w = watches_[i];
    const CaseCheck& check = case_.checks[i];
    CheckSummary r;
    r.name = w.name;
    r.quantity = *check.quantity;
    r.place = check.place ? **check.place : "";
    r.time = w.time;
    r.value = w.value.value_or(std::numeric_limits<double>::quiet_NaN());
    r.reference = w.reference;
    r.difference = r.value - r.reference;
    r.tolerance = check.tolerance;
    r.tolerance_kind = check.absolute ? ToleranceKind::absolute : ToleranceKind::relative;
    r.pass = std::abs(r.difference) <= check.tolerance * (check.absolute ? 1.0 : std::abs(r.reference));
    r.source = check.exact && check.source.empty() ? "exact solution " + *case_.exact->solution : check.source;
    results.push_back(std::move(r));
  }
  return results;
}

}  // namespace carom
