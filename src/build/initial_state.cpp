#include "build/initial_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>

#include "base/checksum.hpp"
#include "base/units.hpp"
#include "base/version.hpp"
#include "build/build_mesh.hpp"
#include "build/digests.hpp"
#include "build/groups.hpp"
#include "casefile/document.hpp"
#include "casefile/read_case.hpp"
#include "casefile/resolved_case.hpp"
#include "casefile/write_toml.hpp"
#include "energy/energy_terms.hpp"
#include "math/vec3.hpp"
#include "output/found_checkpoint.hpp"
#include "output/results_folder.hpp"
#include "solid/point_history.hpp"

namespace carom {

namespace {

namespace fs = std::filesystem;

constexpr const char* from_key = "initial_state.from";

fs::path folder_of(const Case& given) {
  const fs::path from = *given.initial_state->from;
  return from.is_absolute() ? from : fs::path(given.file).parent_path() / from;
}

CaseError from_error(const Case& given, const std::string& found, const std::string& expected,
                     const std::string& remedy = "") {
  const Located<std::string>& from = given.initial_state->from;
  return {from.where, from_key, toml_string(*from) + ", " + found, expected, remedy};
}

/// The last checkpoint of the folder. An older one would be another state than the one that is asked for.
FoundCheckpoint last_checkpoint(const Case& given, const fs::path& folder) {
  constexpr const char* expected = "the results folder of a run that has ended or has been stopped";
  if (!fs::exists(folder))
    throw from_error(given, fmt::format("and no folder {}", toml_string(folder.string())), expected,
                     "The path is relative to the folder of the case file.");
  if (!fs::is_directory(folder)) throw from_error(given, "which is a file", expected, "Name the folder that it is in.");
  if (checkpoint_files(folder.string()).empty())
    throw from_error(given, "a folder without a checkpoint (checkpoints/step_<number>.h5)", expected,
                     "Has that run come to an end? Is this the folder that it was given with --out?");
  const std::string mend = fmt::format(
      "`carom resume {}` goes on from the checkpoint before, where there is one, and writes the last one anew.",
      folder.string());
  try {
    FoundCheckpoint found = find_checkpoint(folder.string());
    if (found.passed_over.empty()) return found;
    throw from_error(given, "whose last checkpoint cannot be used: " + found.passed_over, "a checkpoint that is whole",
                     mend);
  } catch (const CheckpointError& e) {
    throw from_error(given, fmt::format("which cannot be used: {}", e.what()), "a checkpoint that is whole", mend);
  }
}

/// The case that the checkpoint is of.
Case case_of(const Case& given, const fs::path& file, const FoundCheckpoint& found) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream || checksum(text) != found.info.case_digest) {
    throw from_error(
        given, fmt::format("where {} {}", resolved_case_file, stream ? "has been changed since the run" : "is missing"),
        "the folder as that run has left it", "Put the file back, or run that case anew.");
  }
  return read_case(file.string());
}

/// Compares the case with that of the state, by the values that both are run with.
class Comparison {
 public:
  Comparison(const Case& given, const Case& before)
      : given_(given), now_(resolved_tree(given)), before_(resolved_tree(before)) {}

  void refuse_other_units() const { compare({given_.file}, "units", find(now_, "units"), find(before_, "units")); }

  void refuse_other_parts() const {
    const List &now = std::get<List>(find(now_, "part")->value), &before = std::get<List>(find(before_, "part")->value);
    for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i)
      compare_tables(given_.parts[i].where, fmt::format("part[{}]", i), now[i], before[i]);
    if (now.size() != before.size())
      refuse(given_.parts.back().where, "part", fmt::format("{} parts", now.size()), std::to_string(before.size()));
    for (const CasePart& part : given_.parts) {
      const auto material = std::find_if(given_.materials.begin(), given_.materials.end(),
                                         [&](const CaseMaterial& m) { return m.name == *part.material; });
      const auto values = [&](const Node& root) {
        return std::get<Table>(find(root, "materials")->value).find(material->name);
      };
      compare_tables(material->where, join("materials", material->name), *values(now_), *values(before_));
    }
  }

 private:
  [[noreturn]] void refuse(const Location& where, const std::string& key, const std::string& found,
                           const std::string& before) const {
    throw CaseError(where, key, found,
                    fmt::format("{}, as in {}", before,
                                toml_string((fs::path(*given_.initial_state->from) / resolved_case_file).string())),
                    "A state goes on in the same mesh, parts and materials; all else may differ.");
  }
  void compare(const Location& where, const std::string& key, const Node* now, const Node* before) const {
    const auto text = [](const Node* node) { return node == nullptr ? std::string("nothing") : toml_value(*node); };
    if (text(now) != text(before)) refuse(where, key, text(now), text(before));
  }
  void compare_tables(const Location& where, const std::string& path, const Node& now, const Node& before) const {
    const Table &a = std::get<Table>(now.value), &b = std::get<Table>(before.value);
    const auto is_place = [](const Member& m) { return m.key == "library"; };  // its checksum says what it is
    for (const Member& m : a.members)
      if (!is_place(m)) compare(where, join(path, m.key), &m.value, b.find(m.key));
    for (const Member& m : b.members)
      if (!is_place(m)) compare(where, join(path, m.key), a.find(m.key), &m.value);
  }

  const Case& given_;
  Node now_, before_;
};

void refuse_other_mesh(const Case& given, const CheckpointInfo& info, const Model& model, std::size_t nodes) {
  const std::string expected =
      fmt::format("the mesh of that run, {} nodes, with the same cells in its parts", info.nodes);
  const std::string remedy = "Name the same mesh file, or give the same blocks, order and refinement.";
  if (static_cast<std::size_t>(info.nodes) != nodes)
    throw from_error(given, fmt::format("the state of another mesh: this case has {} nodes", nodes), expected, remedy);
  if (info.bodies_digest != bodies_digest(model, nodes))
    throw from_error(given, "the state of another mesh: nodes stand elsewhere, or cells are others", expected, remedy);
}

/// What is read of the checkpoint.
struct Read {
  std::vector<double> q, v, points;
  EnergyTerms energies;
  std::vector<std::uint8_t> alive;  ///< by solid cell; empty: none has gone
};

Read read_state(const Case& given, const Case& before, const std::string& file) {
  Read read;
  try {
    read_checkpoint(file, [&](Archive& archive) {
      archive("march.state.q", read.q);
      archive("march.state.v", read.v);
      archive("march.state.points", read.points);
      archive("march.state.forces.stored", read.energies);
      if (!before.erosion.empty()) archive("march.alive", read.alive);
    });
  } catch (const CheckpointError& e) {
    throw from_error(given, fmt::format("which cannot be used: {}", e.what()), "a checkpoint of a run");
  }
  if (const auto gone = std::ranges::count(read.alive, 0); gone > 0)
    throw from_error(given, fmt::format("a state in which {} cells have gone", gone),
                     "one in which all cells are there, since this case begins with all of them",
                     "Go on with `carom resume`, or add what follows to that case as a [[stage]].");
  return read;
}

std::vector<Vec3> of_nodes(const std::vector<double>& values, std::size_t nodes) {
  std::vector<Vec3> out(nodes);
  for (std::size_t i = 0; i < 3 * nodes; ++i) out[i / 3][i % 3] = values[i];
  return out;
}

double largest(const std::vector<Vec3>& values) {
  double most = 0.0;
  for (const Vec3& value : values) most = std::max(most, norm(value));
  return most;
}

double diagonal_of(const std::vector<Vec3>& x) {
  Vec3 low = x.front(), high = x.front();
  for (const Vec3& X : x) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], X[c]);
      high[c] = std::max(high[c], X[c]);
    }
  }
  return norm(subtract(high, low));
}

double value_at_start(const Case& given, const CaseSupport::Motion& motion) {
  if (!motion.function) return *motion.amplitude;
  const auto found = std::find_if(given.functions.begin(), given.functions.end(),
                                  [&](const CaseFunction& f) { return f.name == **motion.function; });
  return *motion.amplitude * found->function(0.0);
}

/// An imposed displacement that begins elsewhere would tear the nodes there within no time.
void refuse_other_places(const Case& given, const Mesh& mesh, const std::vector<Vec3>& displacement) {
  constexpr double rounding = 1e-12;  // of the size of the mesh: that of a function, or of a velocity over many steps
  const double tolerance = rounding * diagonal_of(mesh.coordinates);
  const Groups groups(mesh);
  for (std::size_t i = 0; i < given.supports.size(); ++i) {
    const CaseSupport& support = given.supports[i];
    for (const CaseSupport::Motion& motion : support.motions) {
      if (motion.kind != MotionKind::displacement) continue;
      const double begin = value_at_start(given, motion);
      for (const Index n : groups.nodes(support.nodes, "support.nodes")) {
        const double taken = displacement[static_cast<std::size_t>(n)][static_cast<std::size_t>(motion.component)];
        if (std::abs(begin - taken) <= tolerance) continue;
        throw CaseError(
            motion.amplitude.where, fmt::format("support[{}].displacement", i),
            fmt::format("{} along {} at t = 0, where the initial state has node {} at {}", begin,
                        "xyz"[motion.component], mesh.node_label(n), taken),
            fmt::format("a displacement that begins where the state is, to {:.1g} of the size of the mesh", rounding),
            "Displacements count from the undeformed mesh: let the function begin with that value. Imposed "
            "velocities, and blocked components, begin wherever the nodes are.");
      }
    }
  }
}

bool has_inertia(const Case& given) {
  const auto is_static = [](const CaseScheme& scheme) { return !has_inertia(*scheme.kind); };
  return !is_static(given.scheme) || std::any_of(given.stages.begin(), given.stages.end(),
                                                 [&](const CaseStage& stage) { return !is_static(stage.scheme); });
}

bool moves_obstacles(const Case& given) {
  return std::any_of(given.contacts.begin(), given.contacts.end(),
                     [](const CaseContact& contact) { return contact.obstacle() && contact.obstacle()->moves(); });
}

bool is_penalty(const CaseScheme& scheme) {
  return **scheme.enforcement == EnforcementKind::penalty;
}

std::string describe(const Case& given, const Case& before, const CheckpointInfo& info, const InitialState& state,
                     const EnergyTerms& energies) {
  const auto unit = [&](Dimension d) { return unit_name(d, given.units); };
  std::string text = fmt::format(
      "initial state: that of {} at t = {:.6g}, step {}; displacements up to {:.4g} {}, strain energy {:.4g} {}, "
      "dissipated {:.4g} {}",
      toml_string(*given.initial_state->from), info.time, info.step, largest(state.displacement),
      unit(Dimension::length), energies.strain + energies.hourglass + energies.distortion, unit(Dimension::energy),
      energies.sum(TermKind::spent), unit(Dimension::energy));
  const double speed = largest(state.velocity);
  if (speed > 0.0) text += fmt::format(", velocities up to {:.4g} {}", speed, unit(Dimension::velocity));
  if (!has_inertia(given)) text += "; its velocities are left, since no stage has inertia";
  const double end = before.stages.empty() ? *before.time.end : *before.stages.back().time.end;
  if (info.time < end * (1.0 - 1e-9)) text += fmt::format("; that run has not come to its end, t = {:.6g}", end);
  if (moves_obstacles(given) || moves_obstacles(before))
    text += "; obstacles that move begin where this case puts them, not where they were there";
  const CaseScheme& last = before.stages.empty() ? before.scheme : before.stages.back().scheme;
  if (!before.contacts.empty() && !is_penalty(last) && is_penalty(given.scheme))
    text +=
        "; its contacts were held by multipliers, and the springs of this case begin without their "
        "forces: give that case enforcement = \"penalty\", or make it the first stage of this one";
  return text;
}

}  // namespace

std::optional<TakenState> take_over(const Case& given, Model& model) {
  if (!given.initial_state) return std::nullopt;
  const fs::path folder = folder_of(given), case_file = folder / resolved_case_file;
  const FoundCheckpoint found = last_checkpoint(given, folder);
  const Case before = case_of(given, case_file, found);
  const Comparison comparison(given, before);
  comparison.refuse_other_units();
  comparison.refuse_other_parts();
  const std::size_t nodes = given_nodes(given, *model.mesh);
  refuse_other_mesh(given, found.info, model, nodes);
  Read read = read_state(given, before, found.path);
  InitialState state;
  state.nodes.resize(nodes);
  std::iota(state.nodes.begin(), state.nodes.end(), Index{0});
  state.displacement = of_nodes(read.q, nodes);
  if (has_inertia(given)) state.velocity = of_nodes(read.v, nodes);
  if (largest(state.velocity) == 0.0) state.velocity.clear();
  refuse_other_places(given, *model.mesh, state.displacement);
  TakenState taken{found.path, case_file.string(), found.info, std::move(read.points),
                   describe(given, before, found.info, state, read.energies)};
  model.initial.insert(model.initial.begin(), std::move(state));
  return taken;
}

void take_points(const Case& given, const Solid& solid, TakenState& taken) {
  const std::string own = version();
  if (history_size(solid) == 0 && taken.points.empty()) return;
  if (taken.info.version == own) {
    try {
      taken.points = history_of_lanes(solid, taken.points);
      return;
    } catch (const std::invalid_argument&) {
    }
  }
  throw from_error(
      given,
      fmt::format("a state of carom {}, whose points remember {} numbers", taken.info.version, taken.points.size()),
      fmt::format("one of carom {}, and {} numbers, where bodies yield", own,
                  history_by_cell(solid, initial_history(solid)).size()),
      "Run the first case again with this program.");
}

void refuse_own_folder(const Case& given, const std::string& results) {
  if (!given.initial_state) return;
  const fs::path own = fs::weakly_canonical(results) / "";
  const fs::path from = fs::weakly_canonical(folder_of(given)) / "";
  const auto [end_of_own, rest] = std::mismatch(own.begin(), std::prev(own.end()), from.begin(), from.end());
  if (end_of_own != std::prev(own.end())) return;
  throw from_error(given, "which is, or is in, the results folder of this run, that is cleared before it begins",
                   "the results folder of another run", "Give this run a folder of its own with --out.");
}

void keep_state(const TakenState& taken, const std::string& results) {
  const fs::path to = fs::path(results) / kept_state_folder;
  const fs::path checkpoint = to / checkpoint_file(taken.info.step);
  std::error_code error;
  fs::create_directories(checkpoint.parent_path(), error);
  if (!error) fs::copy_file(taken.checkpoint, checkpoint, fs::copy_options::overwrite_existing, error);
  if (!error) fs::copy_file(taken.resolved_case, to / resolved_case_file, fs::copy_options::overwrite_existing, error);
  if (error) throw OutputError(to.string(), error.message());
}

}  // namespace carom
