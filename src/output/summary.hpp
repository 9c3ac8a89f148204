// summary.json: what was run, what it cost and whether its results can be trusted (docs/results.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace carom {

struct NamedValue {
  std::string name;
  double value = 0.0;
};

struct ProgramSummary {
  std::string version;   ///< of carom
  std::string compiler;  ///< name and version
  std::string isa;       ///< instruction set of the kernels: "v2", "v3", "v4"
  int threads = 1;
};

struct CaseSummary {
  std::string file;
  std::string title;
  std::string units;  ///< label: "SI", "mm-t-s", "mm-kg-ms"
};

struct MeshSummary {
  struct Group {
    std::string name;
    std::size_t nodes = 0;
    std::size_t cells = 0;
  };
  std::size_t nodes = 0;
  std::size_t cells = 0;  ///< solid cells
  std::vector<Group> groups;
  double reach = 0.0;      ///< largest distance of a node from the origin
  std::string checksum{};  ///< of nodes, cells and groups, 16 hexadecimal digits; "" where an older program has run
};

/// A deformable body: mass, and the velocity of its centre of mass.
struct PartSummary {
  std::string name;
  double mass = 0.0;
  Vec3 velocity_begin{}, velocity_end{};
};

/// The largest von Mises stress of the cells (volume means) at the instants that were looked at.
struct StressSummary {
  double value = 0.0, time = 0.0;
  std::string part;
  std::int64_t cell = 0;      ///< its number in the mesh file
  Vec3 position{};            ///< of its centre, in the reference configuration
  std::int64_t instants = 0;  ///< how many were looked at; 0: nothing is known
};

template <class A>
void fields(A& archive, StressSummary& x) {
  archive("value", x.value);
  archive("time", x.time);
  archive("part", x.part);
  archive("cell", x.cell);
  archive("position", x.position);
  archive("instants", x.instants);
}

/// Where a probe is: on a node, or over a group.
struct ProbeSummary {
  std::string name;
  std::string place;  ///< "node 12", "25 nodes of HEAD"
  Vec3 position{};    ///< mean reference position
};

/// What a probe's acceleration does to what it shakes (output/shock.hpp). Times and accelerations in the units of the
/// case, HIC in seconds and g.
struct ShockSummary {
  std::string probe, quantity;                  ///< "acceleration" or "local_acceleration"
  double cfc = 0.0;                             ///< class of the filter; 0: none
  double quality_factor = 0.0;                  ///< of the spectrum, shock_spectra.csv
  double peak = 0.0, peak_g = 0.0, time = 0.0;  ///< of the resultant
  double pulse_begin = 0.0, pulse_end = 0.0, velocity_change = 0.0;
  double hic15 = 0.0, hic15_begin = 0.0, hic15_end = 0.0;
  double hic36 = 0.0, hic36_begin = 0.0, hic36_end = 0.0;
};

/// name, member: the numbers of a ShockSummary in summary.json.
inline constexpr std::array shock_numbers{
    std::pair{"cfc", &ShockSummary::cfc},
    std::pair{"quality_factor", &ShockSummary::quality_factor},
    std::pair{"peak", &ShockSummary::peak},
    std::pair{"peak_g", &ShockSummary::peak_g},
    std::pair{"time", &ShockSummary::time},
    std::pair{"pulse_begin", &ShockSummary::pulse_begin},
    std::pair{"pulse_end", &ShockSummary::pulse_end},
    std::pair{"velocity_change", &ShockSummary::velocity_change},
    std::pair{"hic15", &ShockSummary::hic15},
    std::pair{"hic15_begin", &ShockSummary::hic15_begin},
    std::pair{"hic15_end", &ShockSummary::hic15_end},
    std::pair{"hic36", &ShockSummary::hic36},
    std::pair{"hic36_begin", &ShockSummary::hic36_begin},
    std::pair{"hic36_end", &ShockSummary::hic36_end},
};

/// One of the schemes that follow each other.
struct StageSummary {
  std::string name;
  double begin = 0.0, end = 0.0;
};

struct SchemeSummary {
  std::string name;    ///< e.g. "Newmark beta 0.25 gamma 0.5"
  std::string solver;  ///< e.g. "CG", "CHOLMOD"; "" when there is none
  double dt_smallest = 0.0, dt_largest = 0.0;
  std::int64_t steps = 0;
  double time_end = 0.0;                            ///< asked for
  double time_reached = 0.0;                        ///< less when the run was stopped
  double added_mass = 0.0, added_mass_share = 0.0;  ///< the most that mass scaling has added in a stage
  std::vector<std::string> mass_notes{};            ///< what was done to the mass, and where
  std::vector<StageSummary> stages{};               ///< in their order, as far as the case has them
};

struct CostSummary {
  double wall_seconds = 0.0, cpu_seconds = 0.0;
  std::vector<NamedValue> phases;  ///< wall seconds by phase, e.g. "setup", "steps", "output"
  std::size_t peak_memory_bytes = 0;
  std::size_t ranks = 1;
  std::size_t messages = 0, sent_bytes = 0;  ///< that the first rank has sent to the others
};

/// Momentum at the beginning and the end against the impulse of all external forces.
/// error: largest |p(t) - p(0) - impulse(t)| over the run, relative to the largest |p| or impulse.
struct MomentumSummary {
  Vec3 begin{}, end{}, impulse{};
  double error = 0.0;
};

enum class ToleranceKind : std::uint8_t { relative, absolute };

struct CheckSummary {
  std::string name;      ///< how the report calls it, e.g. "B.displacement_z"
  std::string quantity;  ///< e.g. "displacement_z", "energy.ENER_CIN"
  std::string place;     ///< probe or contact; "" for global quantities
  double time = 0.0;
  double value = 0.0, reference = 0.0;
  double difference = 0.0;  ///< value - reference
  double tolerance = 0.0;
  ToleranceKind tolerance_kind{};  ///< relative: to |reference|
  bool pass = false;
  std::string source;  ///< where the reference value comes from
};

/// pass means value <= limit.
struct VerdictItem {
  std::string name;
  double value = 0.0, limit = 0.0;
  bool pass = false;
  std::string explanation;
};

/// good: every check and verdict item passed; failed: one did not; stopped: interrupted by the user; error: the run
/// could not go on.
enum class Outcome : std::uint8_t { good, failed, stopped, error };

/// "good", "failed", "stopped", "error".
std::string_view to_string(Outcome outcome);

struct Summary {
  ProgramSummary program;
  CaseSummary case_info;
  MeshSummary mesh;
  SchemeSummary scheme;
  CostSummary cost;
  std::vector<NamedValue> ledger;      ///< totals at the end by term, in the order of energy.csv
  std::vector<NamedValue> code_aster;  ///< ENER_CIN, ENER_TOT, TRAV_EXT, TRAV_AMOR, TRAV_LIAI, DISS_SCH at the end
  MomentumSummary linear_momentum, angular_momentum;
  std::vector<CheckSummary> checks;
  std::vector<PartSummary> parts;
  std::vector<std::string> contacts;  ///< their names, in the order of the case
  std::vector<std::string> ties;      ///< of them the ties that do not tear, which meet nothing
  std::vector<NamedValue> crossings;  ///< by contact: how long a wave takes through a cell there (run/crossings.hpp)
  StressSummary stress;
  std::vector<ProbeSummary> probes;
  std::vector<ShockSummary> shock;
  std::vector<VerdictItem> verdict;
  std::vector<std::string> warnings;  ///< what is doubtful about the case, as `check` says it, and about the run
  std::vector<std::string> doubts;    ///< of warnings: why numbers may be wrong though all passed, in a few words each
  std::vector<std::string> notes;     ///< what was chosen or mended
  Outcome outcome = Outcome::error;
  std::string message;  ///< one sentence for the banner; the error's text when there is one
};

/// "good", "good, with doubts", "failed", "stopped" or "error".
std::string_view verdict_words(const Summary& summary);

/// As JSON; NaN and infinities become null.
std::string summary_text(const Summary& summary);

/// Writes it; replaces an older file at once, never leaving half a file. Throws OutputError.
void write_summary(const std::string& path, const Summary& summary);

/// What summary_text wrote. Throws std::exception where it is not JSON or lacks a field.
Summary parse_summary(std::string_view text);
/// Reads what write_summary wrote; null numbers become NaN. Throws std::runtime_error naming the path when the file is
/// missing, not JSON, or lacks a field.
Summary read_summary(const std::string& path);

}  // namespace carom
