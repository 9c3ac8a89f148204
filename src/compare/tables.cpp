#include "compare/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace carom::compare {

namespace {

using Json = nlohmann::ordered_json;

std::string number(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c == '\n' ? ' ' : c);
  return quoted + '"';
}

Json json_number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// Names of all quantities that were compared, in the order of their first appearance.
std::vector<std::string> quantities(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const Result& r : comparison.results) {
    for (const NamedError& e : r.quantities) {
      if (std::find(names.begin(), names.end(), e.name) == names.end()) names.push_back(e.name);
    }
  }
  return names;
}

double l1_of(const Result& r, const std::string& quantity) {
  for (const NamedError& e : r.quantities) {
    if (e.name == quantity) return e.l1;
  }
  return std::nan("");
}

double peak_ratio(const Result& r) {
  return r.reference_peak_force > 0.0 ? r.peak_force / r.reference_peak_force : std::nan("");
}

Json errors_json(const std::vector<NamedError>& errors) {
  Json json = Json::object();
  for (const NamedError& e : errors) json[e.name] = {{"l2", json_number(e.l2)}, {"l1", json_number(e.l1)}};
  return json;
}

Json result_json(const Result& r) {
  const Variant& v = r.variant;
  Json json = {{"name", v.name},
               {"label", v.label},
               {"scheme", v.scheme},
               {"enforcement", v.enforcement},
               {"stiffness", v.choice.stiffness ? Json(*v.choice.stiffness) : Json(nullptr)},
               {"cells", v.cells > 0 ? Json(v.cells) : Json(nullptr)},
               {"allowed", r.exit_code != 2},
               {"status", status_text(r)},
               {"notes", v.notes}};
  if (!r.failure.empty()) return json;
  json["reference"] = r.is_reference;
  json["step"] = r.step();
  json["courant"] = r.step() / v.element_step;
  json["steps"] = r.summary->scheme.steps;
  json["cpu_seconds"] = r.cpu_seconds();
  json["claimed_error"] = json_number(r.claimed);
  json["basis_of_claim"] = r.basis;
  json["shares_nothing_with_reference"] = r.is_judged;
  json["peak_force"] = r.peak_force;
  json["peak_force_over_reference"] = json_number(peak_ratio(r));
  json["energy_kept"] = json_number(r.energy_kept);
  json["penetration"] = json_number(r.penetration);
  json["errors"] = errors_json(r.quantities);
  json["errors_of_columns"] = errors_json(r.columns);
  return json;
}

Json orders_json(const Comparison& comparison) {
  Json json = Json::object();
  const auto add = [&](const char* name, Along along) {
    json[name] = Json::object();
    for (const Series& s : series_along(comparison.results, along, comparison.quantity))
      if (s.order)
        json[name][s.name] = {{"order", s.order->slope}, {"least", s.order->least}, {"largest", s.order->largest}};
  };
  add("cells", Along::cells);
  add("step", Along::step);
  add("stiffness", Along::stiffness);
  return json;
}

void add_remark(std::vector<Remark>& remarks, const std::string& label, const std::string& text) {
  if (text.empty()) return;
  const auto same = std::find_if(remarks.begin(), remarks.end(), [&](const Remark& r) { return r.text == text; });
  if (same == remarks.end()) {
    remarks.push_back({label, text});
  } else {
    same->variants += "; " + label;
  }
}

}  // namespace

const Result* Comparison::finest() const {
  const auto found = std::find_if(results.begin(), results.end(), [](const Result& r) { return r.is_reference; });
  return found == results.end() ? nullptr : &*found;
}

std::string Comparison::reference_text() const {
  const Result* run = finest();
  if (run == nullptr) return "the exact solution of the case";
  if (reference == ReferenceKind::named) return fmt::format("the run that was named ({})", run->variant.label);
  return fmt::format(
      "the finest run of the least noisy scheme ({}, whose force goes up and down {:.3g} times its peak)",
      run->variant.label, variation(run->curves));
}

std::string status_text(const Result& result) {
  if (!result.failure.empty()) return result.failure;
  const std::vector<std::string> items = result.failed_items();
  return items.empty() ? "passed" : fmt::format("failed: {}", fmt::join(items, ", "));
}

std::vector<Remark> failures(const Comparison& comparison) {
  std::vector<Remark> remarks;
  for (const Result& r : comparison.results) add_remark(remarks, r.variant.label, r.failure);
  return remarks;
}

std::vector<Remark> changes(const Comparison& comparison) {
  std::vector<Remark> remarks;
  for (const Result& r : comparison.results)
    add_remark(remarks, r.variant.label, fmt::format("{}", fmt::join(r.variant.notes, "; ")));
  return remarks;
}

std::vector<Remark> observations(const Comparison& comparison) {
  std::vector<Remark> remarks = equal_runs(comparison.results, comparison.quantity);
  for (Remark& remark : worsening_orders(comparison.results, comparison.quantity)) remarks.push_back(std::move(remark));
  return remarks;
}

DataTable variants_table(const Comparison& comparison) {
  const std::string of = comparison.quantity.empty() ? "" : " " + comparison.quantity;
  DataTable table{comparison.common.empty() ? "" : "in all variants: " + comparison.common,
                  {{"variant"},
                   {(comparison.reference == ReferenceKind::exact ? "error" : "off ref.") + of, true},
                   {"claimed", true},
                   {"peak/ref", true},
                   {"energy", true},
                   {"penetration", true},
                   {"steps", true},
                   {"CPU s", true},
                   {"verdict"}},
                  {}};
  for (const Result& r : comparison.results) {
    if (!r.failure.empty()) continue;
    table.rows.push_back({r.variant.label, r.is_reference ? "-" : number(r.error(comparison.quantity), 4),
                          number(r.claimed, 3), number(peak_ratio(r), 4), number(r.energy_kept, 5),
                          number(r.penetration, 3), fmt::format("{}", r.summary->scheme.steps),
                          number(r.cpu_seconds(), 3), status_text(r) + (r.is_reference ? " (the reference)" : "")});
  }
  return table;
}

std::string remarks_text(const Comparison& comparison) {
  std::string text;
  for (const auto& remarks : {failures(comparison), observations(comparison)})
    for (const Remark& remark : remarks) text += fmt::format("{}\n  {}\n", remark.variants, remark.text);
  if (!comparison.quantity.empty())
    text += fmt::format("{} {}\n", comparison.reference == ReferenceKind::exact ? "errors against" : "differences to",
                        comparison.reference_text());
  const Recommendation& advice = comparison.recommendation;
  text += fmt::format("\n{}{}\n", advice.result ? "Recommended: " : "", advice.headline);
  for (const std::string& reason : advice.reasons) text += "  " + reason + "\n";
  return text;
}

std::string csv_table(const Comparison& comparison) {
  const std::vector<std::string> names = quantities(comparison);
  std::string text = "name,scheme,enforcement,stiffness,cells,courant,step,steps,cpu_seconds";
  for (const std::string& name : names) text += fmt::format(",l2_{0},l1_{0}", name);
  text += ",claimed_error,peak_force,peak_force_over_reference,energy_kept,penetration,status\n";
  for (const Result& r : comparison.results) {
    const Variant& v = r.variant;
    text += fmt::format("{},{},{},{},{}", v.name, csv_text(v.scheme), csv_text(v.enforcement),
                        v.choice.stiffness ? csv_text(*v.choice.stiffness) : "",
                        v.cells > 0 ? std::to_string(v.cells) : "");
    const bool ended = r.failure.empty();
    text += ended ? fmt::format(",{},{},{},{}", r.step() / v.element_step, r.step(), r.summary->scheme.steps,
                                r.cpu_seconds())
                  : ",,,,";
    for (const std::string& name : names)
      text += fmt::format(",{},{}", csv_number(r.error(name)), csv_number(l1_of(r, name)));
    text += ended ? fmt::format(",{},{},{},{},{}", csv_number(r.claimed), r.peak_force, csv_number(peak_ratio(r)),
                                csv_number(r.energy_kept), csv_number(r.penetration))
                  : ",,,,,";
    text += fmt::format(",{}\n", csv_text(status_text(r)));
  }
  return text;
}

std::string json_table(const Comparison& comparison) {
  Json json = {
      {"case", {{"file", comparison.file}, {"title", comparison.title}, {"units", comparison.units}}},
      {"common", comparison.common},
      {"reference", comparison.reference == ReferenceKind::exact   ? "exact"
                    : comparison.reference == ReferenceKind::named ? "named run"
                                                                   : "finest run"},
      {"reference_run", comparison.finest() == nullptr ? Json(nullptr) : Json(comparison.finest()->variant.name)},
      {"ranked_by", comparison.quantity},
      {"enforcement_spread", json_number(comparison.claims.spread)},
      {"variants", Json::array()},
      {"orders", orders_json(comparison)}};
  for (const Result& r : comparison.results) json["variants"].push_back(result_json(r));
  const Recommendation& advice = comparison.recommendation;
  json["recommendation"] = {
      {"variant", advice.result ? Json(comparison.results[*advice.result].variant.name) : Json(nullptr)},
      {"headline", advice.headline},
      {"reasons", advice.reasons}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace carom::compare
