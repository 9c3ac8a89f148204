#include "output/summary.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "output/file_writer.hpp"

namespace carom {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 4> kOutcomes{"good", "failed", "stopped", "error"};
constexpr std::array<std::string_view, 2> kToleranceKinds{"relative", "absolute"};

template <class Enum, std::size_t n>
Enum parse(const std::string& text, const std::array<std::string_view, n>& names) {
  for (std::size_t i = 0; i < n; ++i) {
    if (names[i] == text) return static_cast<Enum>(i);
  }
  throw std::runtime_error(fmt::format("unknown word \"{}\"", text));
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

double number(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json vector(const Vec3& v) {
  return Json::array({number(v[0]), number(v[1]), number(v[2])});
}

Vec3 vector(const Json& json) {
  return {number(json.at(0)), number(json.at(1)), number(json.at(2))};
}

/// {"name": value, ...} in the given order.
Json named_values(const std::vector<NamedValue>& values) {
  Json json = Json::object();
  for (const NamedValue& entry : values) json[entry.name] = number(entry.value);
  return json;
}

std::vector<NamedValue> named_values(const Json& json) {
  std::vector<NamedValue> values;
  for (const auto& [name, value] : json.items()) values.push_back({name, number(value)});
  return values;
}

Json to_json(const MeshSummary& mesh) {
  Json groups = Json::array();
  for (const MeshSummary::Group& group : mesh.groups) {
    groups.push_back({{"name", group.name}, {"nodes", group.nodes}, {"cells", group.cells}});
  }
  return {{"nodes", mesh.nodes},
          {"cells", mesh.cells},
          {"groups", groups},
          {"reach", number(mesh.reach)},
          {"checksum", mesh.checksum}};
}

MeshSummary mesh_from(const Json& json) {
  MeshSummary mesh{json.at("nodes").get<std::size_t>(),
                   json.at("cells").get<std::size_t>(),
                   {},
                   number(json.at("reach")),
                   json.value("checksum", "")};
  for (const Json& group : json.at("groups")) {
    mesh.groups.push_back({group.at("name").get<std::string>(), group.at("nodes").get<std::size_t>(),
                           group.at("cells").get<std::size_t>()});
  }
  return mesh;
}

Json to_json(const PartSummary& part) {
  return {{"name", part.name},
          {"mass", number(part.mass)},
          {"velocity_begin", vector(part.velocity_begin)},
          {"velocity_end", vector(part.velocity_end)}};
}

PartSummary part_from(const Json& json) {
  return {json.at("name").get<std::string>(), number(json.at("mass")), vector(json.at("velocity_begin")),
          vector(json.at("velocity_end"))};
}

Json to_json(const ShockSummary& shock) {
  Json json{{"probe", shock.probe}, {"quantity", shock.quantity}};
  for (const auto& [name, member] : shock_numbers) json[name] = number(shock.*member);
  return json;
}

ShockSummary shock_from(const Json& json) {
  ShockSummary shock{json.at("probe").get<std::string>(), json.at("quantity").get<std::string>()};
  for (const auto& [name, member] : shock_numbers) shock.*member = number(json.at(name));
  return shock;
}

Json to_json(const StressSummary& stress) {
  return {{"value", number(stress.value)}, {"time", number(stress.time)},         {"part", stress.part},
          {"cell", stress.cell},           {"position", vector(stress.position)}, {"instants", stress.instants}};
}

StressSummary stress_from(const Json& json) {
  return {number(json.at("value")),           number(json.at("time")),
          json.at("part").get<std::string>(), json.at("cell").get<std::int64_t>(),
          vector(json.at("position")),        json.at("instants").get<std::int64_t>()};
}

Json to_json(const ProbeSummary& probe) {
  return {{"name", probe.name}, {"place", probe.place}, {"position", vector(probe.position)}};
}

ProbeSummary probe_from(const Json& json) {
  return {json.at("name").get<std::string>(), json.at("place").get<std::string>(), vector(json.at("position"))};
}

Json to_json(const StageSummary& stage) {
  return {{"name", stage.name}, {"begin", number(stage.begin)}, {"end", number(stage.end)}};
}

StageSummary stage_from(const Json& json) {
  return {json.at("name").get<std::string>(), number(json.at("begin")), number(json.at("end"))};
}

/// The entries of a list, each made by from(json).
template <class From>
auto list_from(const Json& json, const From& from) {
  std::vector<decltype(from(json))> entries;
  for (const Json& entry : json) entries.push_back(from(entry));
  return entries;
}

Json to_json(const SchemeSummary& scheme) {
  Json stages = Json::array();
  for (const StageSummary& stage : scheme.stages) stages.push_back(to_json(stage));
  return {{"name", scheme.name},
          {"solver", scheme.solver},
          {"dt_smallest", number(scheme.dt_smallest)},
          {"dt_largest", number(scheme.dt_largest)},
          {"steps", scheme.steps},
          {"time_end", number(scheme.time_end)},
          {"time_reached", number(scheme.time_reached)},
          {"added_mass", number(scheme.added_mass)},
          {"added_mass_share", number(scheme.added_mass_share)},
          {"mass_notes", scheme.mass_notes},
          {"stages", stages}};
}

SchemeSummary scheme_from(const Json& json) {
  return {json.at("name").get<std::string>(),      json.at("solver").get<std::string>(),
          number(json.at("dt_smallest")),          number(json.at("dt_largest")),
          json.at("steps").get<std::int64_t>(),    number(json.at("time_end")),
          number(json.at("time_reached")),         number(json.at("added_mass")),
          number(json.at("added_mass_share")),     json.at("mass_notes").get<std::vector<std::string>>(),
          list_from(json.at("stages"), stage_from)};
}

Json to_json(const CostSummary& cost) {
  return {{"wall_seconds", number(cost.wall_seconds)},
          {"cpu_seconds", number(cost.cpu_seconds)},
          {"phases", named_values(cost.phases)},
          {"peak_memory_bytes", cost.peak_memory_bytes},
          {"ranks", cost.ranks},
          {"messages", cost.messages},
          {"sent_bytes", cost.sent_bytes}};
}

CostSummary cost_from(const Json& json) {
  return {number(json.at("wall_seconds")),         number(json.at("cpu_seconds")),
          named_values(json.at("phases")),         json.at("peak_memory_bytes").get<std::size_t>(),
          json.value("ranks", std::size_t{1}),     json.value("messages", std::size_t{0}),
          json.value("sent_bytes", std::size_t{0})};
}

Json to_json(const MomentumSummary& momentum) {
  return {{"begin", vector(momentum.begin)},
          {"end", vector(momentum.end)},
          {"impulse", vector(momentum.impulse)},
          {"error", number(momentum.error)}};
}

MomentumSummary momentum_from(const Json& json) {
  return {vector(json.at("begin")), vector(json.at("end")), vector(json.at("impulse")), number(json.at("error"))};
}

Json to_json(const CheckSummary& check) {
  return {{"name", check.name},
          {"quantity", check.quantity},
          {"place", check.place},
          {"time", number(check.time)},
          {"value", number(check.value)},
          {"reference", number(check.reference)},
          {"difference", number(check.difference)},
          {"tolerance", number(check.tolerance)},
          {"tolerance_kind", kToleranceKinds.at(static_cast<std::size_t>(check.tolerance_kind))},
          {"pass", check.pass},
          {"source", check.source}};
}

CheckSummary check_from(const Json& json) {
  CheckSummary check;
  check.name = json.at("name").get<std::string>();
  check.quantity = json.at("quantity").get<std::string>();
  check.place = json.at("place").get<std::string>();
  check.time = number(json.at("time"));
  check.value = number(json.at("value"));
  check.reference = number(json.at("reference"));
  check.difference = number(json.at("difference"));
  check.tolerance = number(json.at("tolerance"));
  check.tolerance_kind = parse<ToleranceKind>(json.at("tolerance_kind").get<std::string>(), kToleranceKinds);
  check.pass = json.at("pass").get<bool>();
  check.source = json.at("source").get<std::string>();
  return check;
}

Json to_json(const VerdictItem& item) {
  return {{"name", item.name},
          {"value", number(item.value)},
          {"limit", number(item.limit)},
          {"pass", item.pass},
          {"explanation", item.explanation}};
}

VerdictItem verdict_item_from(const Json& json) {
  return {json.at("name").get<std::string>(), number(json.at("value")), number(json.at("limit")),
          json.at("pass").get<bool>(), json.at("explanation").get<std::string>()};
}

template <class T>
Json list(const std::vector<T>& entries) {
  Json json = Json::array();
  for (const T& entry : entries) json.push_back(to_json(entry));
  return json;
}

Json to_json(const Summary& s) {
  Json json;
  json["outcome"] = to_string(s.outcome);
  json["message"] = s.message;
  json["program"] = {{"version", s.program.version},
                     {"compiler", s.program.compiler},
                     {"isa", s.program.isa},
                     {"threads", s.program.threads}};
  json["case"] = {{"file", s.case_info.file}, {"title", s.case_info.title}, {"units", s.case_info.units}};
  json["mesh"] = to_json(s.mesh);
  json["scheme"] = to_json(s.scheme);
  json["cost"] = to_json(s.cost);
  json["ledger"] = named_values(s.ledger);
  json["code_aster"] = named_values(s.code_aster);
  json["linear_momentum"] = to_json(s.linear_momentum);
  json["angular_momentum"] = to_json(s.angular_momentum);
  json["parts"] = list(s.parts);
  json["contacts"] = s.contacts;
  json["ties"] = s.ties;
  json["crossing_times"] = named_values(s.crossings);
  json["stress"] = to_json(s.stress);
  json["probes"] = list(s.probes);
  json["shock"] = list(s.shock);
  json["verdict"] = list(s.verdict);
  json["checks"] = list(s.checks);
  json["warnings"] = s.warnings;
  json["doubts"] = s.doubts;
  json["notes"] = s.notes;
  return json;
}

Summary summary_from(const Json& json) {
  Summary s;
  s.outcome = parse<Outcome>(json.at("outcome").get<std::string>(), kOutcomes);
  s.message = json.at("message").get<std::string>();
  const Json& program = json.at("program");
  s.program = {program.at("version").get<std::string>(), program.at("compiler").get<std::string>(),
               program.at("isa").get<std::string>(), program.at("threads").get<int>()};
  const Json& case_info = json.at("case");
  s.case_info = {case_info.at("file").get<std::string>(), case_info.at("title").get<std::string>(),
                 case_info.at("units").get<std::string>()};
  s.mesh = mesh_from(json.at("mesh"));
  s.scheme = scheme_from(json.at("scheme"));
  s.cost = cost_from(json.at("cost"));
  s.ledger = named_values(json.at("ledger"));
  s.code_aster = named_values(json.at("code_aster"));
  s.linear_momentum = momentum_from(json.at("linear_momentum"));
  s.angular_momentum = momentum_from(json.at("angular_momentum"));
  s.parts = list_from(json.at("parts"), part_from);
  s.contacts = json.at("contacts").get<std::vector<std::string>>();
  if (json.contains("ties")) s.ties = json.at("ties").get<std::vector<std::string>>();
  if (json.contains("crossing_times")) s.crossings = named_values(json.at("crossing_times"));
  s.stress = stress_from(json.at("stress"));
  s.probes = list_from(json.at("probes"), probe_from);
  if (json.contains("shock")) s.shock = list_from(json.at("shock"), shock_from);
  s.verdict = list_from(json.at("verdict"), verdict_item_from);
  s.checks = list_from(json.at("checks"), check_from);
  s.warnings = json.at("warnings").get<std::vector<std::string>>();
  s.doubts = json.at("doubts").get<std::vector<std::string>>();
  s.notes = json.at("notes").get<std::vector<std::string>>();
  return s;
}

}  // namespace

std::string_view to_string(Outcome outcome) {
  return kOutcomes.at(static_cast<std::size_t>(outcome));
}

std::string_view verdict_words(const Summary& summary) {
  const bool is_in_doubt = summary.outcome == Outcome::good && !summary.doubts.empty();
  return is_in_doubt ? "good, with doubts" : to_string(summary.outcome);
}

std::string summary_text(const Summary& summary) {
  // Bytes of titles or paths that are not UTF-8 become the replacement character rather than an error.
  return to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_summary(const std::string& path, const Summary& summary) {
  write_file(path, summary_text(summary));
}

Summary parse_summary(std::string_view text) {
  return summary_from(Json::parse(text));
}

Summary read_summary(const std::string& path) {
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error(fmt::format("{}: cannot be opened", path));
  try {
    return parse_summary(std::string{std::istreambuf_iterator<char>(stream), {}});
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace carom
