#include "run/cost_estimate.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string_view>
#include <utility>

#include "base/types.hpp"
#include "contact/delassus.hpp"
#include "run/recorder.hpp"

namespace carom {

namespace {

constexpr double gigabyte = 1e9;

bool is_implicit(const Stage& stage) {
  return !is_explicit(stage.settings().kind);
}

/// True where the implicit steps of a stage factor their matrix: what the scheme will choose, with the bound of the
/// frequency by elements and c / m of Newmark's average acceleration.
bool has_factor(const Stage& stage) {
  if (!is_implicit(stage)) return false;
  const SchemeSettings& settings = stage.settings();
  const double ratio = settings.kind == SchemeKind::statics ? infinity : 0.25 * stage.dt() * stage.dt();
  const double omega_squared = stage.system().solid.largest_frequency_bound();
  const SolverKind kind = chosen_solver(stage.system(), settings.solver, settings.enforcement, ratio, omega_squared);
  return kind == SolverKind::cholesky || kind == SolverKind::ldlt;
}

/// True where each row of contact acts on every other: its compliance is that of the bodies (exact contact in implicit
/// steps, nodes without mass) or of a consistent mass (stops that implicit steps give to what touches).
bool has_dense_rows(const Stage& stage) {
  const SchemeSettings& settings = stage.settings();
  if (settings.kind == SchemeKind::modified_mass) return true;
  if (!is_implicit(stage)) return false;
  const EnforcementTraits& enforcement = traits(settings.enforcement);
  const bool stops = enforcement.stops_touches && settings.kind != SchemeKind::statics;
  return enforcement.is_exact || (stops && stage.system().mass.kind() != MassKind::lumped);
}

/// What to say where more rows may act at once than a dense compliance may have. Surfaces that meet themselves do so in
/// places only.
std::string rows_warning(const Simulation& s) {
  const std::vector<ContactDefinition>& contacts = s.model().contacts;
  const bool is_dense = std::ranges::any_of(s.stages(), [](const auto& stage) { return has_dense_rows(*stage); });
  const bool meets_itself = std::ranges::any_of(contacts, [](const auto& c) { return parts_of(c).is_self; });
  const bool has_tangents = std::ranges::any_of(contacts, [](const ContactDefinition& c) {
    return parts_of(c).nature == ContactNature::bonds || (law_of(c) != nullptr && law_of(c)->mu > 0.0);
  });
  const std::size_t rows = s.contact().slots(), most = Delassus::most_rows(has_tangents);
  if (!is_dense || meets_itself || rows <= most) return {};
  return fmt::format(
      "up to {} rows may be in contact at once, and exact contact of this scheme goes on with {} at most, since each "
      "acts on every other: choose enforcement = \"penalty\", or an explicit scheme with a lumped mass "
      "(kind = \"cd_lagrange\")",
      rows, most);
}

/// Of one .vtu file (output/vtu.hpp): coordinates and cells, and the fields with the types that the recorder gives
/// them.
double frame_bytes(const Simulation& s) {
  static const std::map<std::string_view, double> per_node{
      {"displacement", 24.0},    {"velocity", 24.0},   {"acceleration", 24.0},  {"contact_force", 12.0},
      {"contact_pressure", 4.0}, {"contact_gap", 4.0}, {"contact_status", 1.0}, {"contact_damage", 4.0}};
  static const std::map<std::string_view, double> per_cell{{"stress", 24.0}, {"strain", 24.0}, {"von_mises", 4.0}};
  if (s.given().output.fields.empty()) return 0.0;
  double of_node = 28.0, of_cell = 13.0, corners = 0.0;  // with numbers and parts
  for (std::size_t k = 0; k < s.solid().cell_count(); ++k)
    corners += static_cast<double>(s.solid().nodes_of_cell(k).size());
  for (const auto& field : s.given().output.fields) {
    const bool is_off = (field->starts_with("contact_") && s.given().contacts.empty()) ||
                        (*field == "contact_damage" && s.solid().cohesive().empty());
    if (const auto found = per_node.find(*field); found != per_node.end() && !is_off) of_node += found->second;
    if (const auto found = per_cell.find(*field); found != per_cell.end()) of_cell += found->second;
    if (!s.solid().cell_history(*field, s.solid().initial_history()).empty()) of_cell += 4.0;
  }
  return of_node * static_cast<double>(s.mesh().node_count()) + of_cell * static_cast<double>(s.solid().cell_count()) +
         4.0 * corners;
}

/// Numbers in a row of the tables, each with about 14 characters.
double row_bytes(const Simulation& s) {
  const RunTables tables(s);
  const std::size_t columns = tables.energy.table().columns.size() + tables.contact.table().columns.size() +
                              tables.probes.table().columns.size() +
                              (tables.exact ? tables.exact->table().columns.size() : 0);
  return 14.0 * static_cast<double>(columns);
}

std::string rounded(double value, const char* unit) {
  const double magnitude = std::pow(10.0, std::floor(std::log10(value)));
  return fmt::format("about {:g} {}", std::round(value / magnitude) * magnitude, unit);
}

struct Unit {
  double size;
  const char* name;
};

template <std::size_t n>
std::string in_units(double value, const std::array<Unit, n>& units) {
  if (!std::isfinite(value)) return "unknown";
  const auto fits = std::find_if(units.begin(), units.end(), [&](const Unit& u) { return value >= u.size; });
  if (fits == units.end()) return fmt::format("less than 1 {}", units.back().name);
  return rounded(value / fits->size, fits->name);
}

}  // namespace

long long frame_interval(const Simulation& s) {
  const int wanted = s.given().output.fields_every;
  return wanted > 0 ? wanted : std::max(1LL, (s.steps() + 49) / 50);
}

CostEstimate estimate_cost(const Simulation& s) {
  const double cells = static_cast<double>(s.solid().cell_count()), nodes = static_cast<double>(s.mesh().node_count());
  CostEstimate cost;
  // A core does about eight million cells a second in explicit steps, and fifty times that work in an implicit one, ten
  // times more where it factors in every iteration. Pairs cost some times their cells in explicit steps.
  const double implicit_work = s.solid().is_linear() ? 50.0 : 500.0, explicit_work = s.contact().is_fixed() ? 1.0 : 5.0;
  for (const auto& stage : s.stages())
    cost.seconds +=
        cells * static_cast<double>(stage->steps()) * (is_implicit(*stage) ? implicit_work : explicit_work) / 8e6;
  // 0.5 kB per cell for the mesh, the kernels' tables and the states (0.44 to 0.46 measured), 2 kB where steps are
  // implicit, with grids and a consistent mass (2.2 measured for 655,000 cells), and twice what points remember. A
  // factor of nested dissection has about 8 n^(4/3) blocks of 3 x 3 over n nodes of a cube (A. George, SIAM J. Numer.
  // Anal. 10, 1973), less where a body is slender; with the matrix and the space of its factorisation 14 (measured:
  // 0.90 GB for 28^3 cells, 0.28 GB for 8 x 8 x 160).
  const bool has_matrix =
      std::any_of(s.stages().begin(), s.stages().end(), [](const auto& stage) { return has_factor(*stage); });
  const bool has_implicit =
      std::any_of(s.stages().begin(), s.stages().end(), [](const auto& stage) { return is_implicit(*stage); });
  const double history = 8.0 * static_cast<double>(s.solid().history_size());
  cost.memory_bytes = 2.4e7 + (has_implicit ? 2e3 : 5e2) * cells + 2.0 * history +
                      (has_matrix ? 14.0 * 72.0 * std::pow(nodes, 4.0 / 3.0) : 0.0);
  cost.frames = s.given().output.fields.empty() ? 0 : s.steps() / frame_interval(s) + 2;
  const long long rows = s.steps() / s.given().output.curves_every + 1;
  constexpr double page = 2.5e5;                         // of the report, with what draws its curves
  constexpr double checkpoints = 3.0 * 9.0 * 3.0 * 8.0;  // per node: two and one being written, of nine vectors of dofs
  cost.disk_bytes = page + static_cast<double>(cost.frames) * frame_bytes(s) +
                    static_cast<double>(rows) * row_bytes(s) + checkpoints * nodes + 3.0 * history;
  return cost;
}

std::string about_bytes(double bytes) {
  return in_units(bytes, std::array<Unit, 4>{{{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}}});
}

std::string about_seconds(double seconds) {
  return in_units(seconds, std::array<Unit, 4>{{{86400.0, "d"}, {3600.0, "h"}, {60.0, "min"}, {1.0, "s"}}});
}

double available_memory() {
  double available = infinity;
  std::ifstream file("/proc/meminfo");
  for (std::string key, rest; file >> key; std::getline(file, rest)) {
    double kilobytes = 0.0;
    if (key == "MemAvailable:" && file >> kilobytes) available = 1024.0 * kilobytes;
  }
  rlimit limit{};
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA})
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      available = std::min(available, static_cast<double>(limit.rlim_cur));
  return available;
}

double available_disk(const std::string& folder) {
  std::error_code error;
  std::filesystem::path path = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(path, error) && path.has_relative_path()) path = path.parent_path();
  const std::filesystem::space_info space = std::filesystem::space(path, error);
  return error ? infinity : static_cast<double>(space.available);
}

std::string memory_statement(const Simulation& s) {
  return fmt::format("it needs {} in all, and {} are there", about_bytes(estimate_cost(s).memory_bytes),
                     about_bytes(available_memory()));
}

std::vector<std::string> cost_warnings(const Simulation& s, const std::string& folder) {
  constexpr double many_bytes = 4.0 * gigabyte, day = 86400.0;
  const CostEstimate cost = estimate_cost(s);
  std::vector<std::string> out;
  const double disk = available_disk(folder), memory = available_memory();
  if (!folder.empty() && cost.disk_bytes > std::min(many_bytes, 0.5 * disk)) {
    out.push_back(
        fmt::format("the results will take {} ({} files of fields), and {} are free: raise output.fields_every "
                    "or output.curves_every, or shorten output.fields",
                    about_bytes(cost.disk_bytes), cost.frames, about_bytes(disk)));
  }
  if (cost.memory_bytes > 0.5 * memory) {
    out.push_back(fmt::format("the run will need {} of memory, and {} are there{}", about_bytes(cost.memory_bytes),
                              about_bytes(memory),
                              is_implicit(s.first()) ? ": explicit schemes and solver = \"cg\" need least" : ""));
  }
  if (std::string rows = rows_warning(s); !rows.empty()) out.push_back(std::move(rows));
  if (cost.seconds > day) {
    out.push_back(fmt::format("the run will take {} on one core", about_seconds(cost.seconds)));
  }
  return out;
}

}  // namespace carom
