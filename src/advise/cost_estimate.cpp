#include "advise/cost_estimate.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "advise/stage_time.hpp"
#include "base/amounts.hpp"
#include "base/types.hpp"
#include "record/frame_plan.hpp"
#include "record/recorder.hpp"
#include "rows/delassus.hpp"
#include "solid/point_history.hpp"
#include "solid/stability.hpp"

namespace carom {

namespace {

bool is_implicit(const Stage& stage) {
  return !is_explicit(stage.settings().kind);
}

/// True where each row of contact acts on every other: its compliance is that of the bodies (exact contact in implicit
/// steps, nodes without mass) or of a consistent mass (stops that implicit steps give to what touches).
bool has_dense_rows(const Stage& stage) {
  const SchemeSettings& settings = stage.settings();
  if (has_massless_contact(settings.kind)) return true;
  if (!is_implicit(stage)) return false;
  const EnforcementTraits& enforcement = traits(settings.enforcement);
  const bool stops = enforcement.stops_touches && has_inertia(settings.kind);
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

/// Numbers in a row of the tables, each with about 14 characters.
double row_bytes(const Simulation& s) {
  const RunTables tables(s);
  const std::size_t columns = tables.energy.table().columns.size() + tables.contact.table().columns.size() +
                              tables.probes.table().columns.size() + tables.parts.table().columns.size() +
                              (tables.exact ? tables.exact->table().columns.size() : 0);
  return 14.0 * static_cast<double>(columns);
}

}  // namespace

CostEstimate estimate_cost(const Simulation& s, const Rehearsal& seen) {
  const double cells = static_cast<double>(s.solid().cells().size()),
               nodes = static_cast<double>(s.mesh().node_count());
  CostEstimate cost;
  long long steps = 0;
  for (std::size_t i = 0; i < s.stages().size(); ++i) {
    cost.stages.push_back(foretell(s, i, seen));
    cost.seconds += cost.stages.back().seconds;
    steps += cost.stages.back().steps;
  }
  // 0.5 kB per cell for the mesh, the kernels' tables and the states (0.44 to 0.46 measured), 2 kB where steps are
  // implicit, with grids and a consistent mass (2.2 measured for 655,000 cells), and twice what points remember. A
  // factor of nested dissection has about 8 n^(4/3) blocks of 3 x 3 over n nodes of a cube (A. George, SIAM J. Numer.
  // Anal. 10, 1973), less where a body is slender; with the matrix and the space of its factorisation 14 (measured:
  // 0.90 GB for 28^3 cells, 0.28 GB for 8 x 8 x 160).
  const bool has_matrix =
      std::any_of(s.stages().begin(), s.stages().end(), [](const auto& stage) { return has_factor(*stage); });
  const bool has_implicit =
      std::any_of(s.stages().begin(), s.stages().end(), [](const auto& stage) { return is_implicit(*stage); });
  const double history = 8.0 * static_cast<double>(history_size(s.solid()));
  cost.memory_bytes = 2.4e7 + (has_implicit ? 2e3 : 5e2) * cells + 2.0 * history +
                      (has_matrix ? 14.0 * 72.0 * std::pow(nodes, 4.0 / 3.0) : 0.0);
  cost.frames = s.given().output.fields.empty() ? 0 : (s.steps() + frame_interval(s) - 1) / frame_interval(s) + 1;
  const long long rows = steps / s.given().output.curves_every + 1;
  constexpr double page = 2.5e5;                         // of the report, with what draws its curves
  constexpr double checkpoints = 3.0 * 9.0 * 3.0 * 8.0;  // per node: two and one being written, of nine vectors of dofs
  const FieldBytes fields = field_bytes(s);
  cost.disk_bytes = page + fields.mesh + static_cast<double>(cost.frames) * fields.frame +
                    static_cast<double>(rows) * row_bytes(s) + checkpoints * nodes + 3.0 * history;
  return cost;
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

std::vector<std::string> cost_warnings(const Simulation& s, const std::string& folder, const Rehearsal& seen) {
  constexpr double many_bytes = 4e9, day = 86400.0;
  const CostEstimate cost = estimate_cost(s, seen);
  std::vector<std::string> out;
  const double disk = available_disk(folder), memory = available_memory();
  if (!folder.empty() && cost.disk_bytes > std::min(many_bytes, 0.5 * disk)) {
    out.push_back(
        fmt::format("the results will take {} ({} frames of fields), and {} are free: raise output.fields_every "
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
