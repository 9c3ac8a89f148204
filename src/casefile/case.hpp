// The case: what the user asked for, typed, with defaults filled; every value knows where it was written.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "base/units.hpp"
#include "math/time_function.hpp"
#include "mesh/structured_block.hpp"

namespace carom {

/// A value and the place where the user wrote it (or where its section begins, when it is a default).
template <class T>
struct Located {
  T value{};
  Location where;

  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

struct CaseMesh {
  Location where;
  Located<std::string> file;  ///< "" when blocks are given; relative to the case file's folder
  std::vector<StructuredBlock> blocks;
};

struct CaseMaterial {
  std::string name;
  Location where;
  Located<std::string> law;  ///< "linear_elastic"
  Located<double> E, nu, rho;
};

struct CasePart {
  Location where;
  Located<std::string> name;
  Located<std::string> cells;     ///< cell group
  Located<std::string> material;  ///< key of [materials]
};

/// [[support]]: what is imposed on a group of nodes.
struct CaseSupport {
  Location where;
  Located<std::string> nodes;  ///< node or cell group, or "all"
  std::optional<Located<std::string>>
      symmetry;                   ///< "x", "y" or "z": normal of the symmetry plane; blocks that component
  std::array<bool, 3> blocked{};  ///< blocked = ["x", "y"]
  enum class Kind : std::uint8_t { displacement, velocity, acceleration };
  struct Motion {
    Kind kind{};
    int component = 0;
    Located<double> amplitude;
    std::optional<Located<std::string>> function;  ///< key of [functions]; constant 1 when absent
  };
  std::vector<Motion> motions;
};

/// [[load]]
struct CaseLoad {
  Location where;
  enum class Kind : std::uint8_t { force, pressure, gravity };
  Kind kind{};
  std::optional<Located<std::string>> group;  ///< nodes (force) or faces (pressure)
  Vec3 vector{};                              ///< force on each node, or acceleration of gravity
  double pressure = 0.0;
  std::optional<Located<std::string>> function;  ///< key of [functions]; constant 1 when absent
};

/// [[initial]]
struct CaseInitial {
  Location where;
  std::optional<Located<std::string>> nodes;  ///< node or cell group; exactly one of nodes, part
  std::optional<Located<std::string>> part;
  std::optional<Vec3> displacement, velocity;
};

/// [[contact]]
struct CaseContact {
  Location where;
  Located<std::string> name;
  enum class Kind : std::uint8_t { interface, plane, stop };
  Kind kind{};
  Located<std::string> group;         ///< cells (interface), faces or nodes (plane), nodes (stop)
  Located<double> stiffness;          ///< eps_N: stress per length (interface, plane per_area), force per length (else)
  bool per_node = false;              ///< plane: measure = "node" instead of "area"
  double tangential_stiffness = 0.0;  ///< interface, plane
  double friction = 0.0;              ///< Coulomb mu
  Vec3 point{};                       ///< plane
  Located<Vec3> normal;  ///< plane: towards the body; stop: direction from the stop to the node. Normalised on reading
  double gap = 0.0;      ///< stop
  double damping = 0.0;  ///< stop
};

struct CaseFunction {
  std::string name;
  Location where;
  TimeFunction function;
};

struct CaseScheme {
  Location where;
  enum class Kind : std::uint8_t { newmark, central_differences };
  Kind kind{};
  double beta = 0.25, gamma = 0.5;  ///< newmark
  enum class Mass : std::uint8_t { consistent, lumped };
  Mass mass{};  ///< default: consistent for newmark, lumped for central differences
};

struct CaseTime {
  Location where;
  Located<double> end;
  std::optional<Located<double>> step;  ///< newmark: required; central differences: default from the stable step
  bool fixed = false;                   ///< newmark: never halve (a failing step ends the run)
  double safety = 0.9;                  ///< central differences: fraction of the stable step
};

struct CaseSolver {
  enum class Kind : std::uint8_t { automatic, cg, cholmod };
  Kind kind = Kind::automatic;
  int max_contact_iterations = 50;
};

struct CaseOutput {
  Location where;
  /// Of displacement, velocity, acceleration, stress.
  std::vector<Located<std::string>> fields{{"displacement", {}}, {"velocity", {}}, {"stress", {}}};
  int fields_every = 0;  ///< steps; 0: about 50 times over the run
  int curves_every = 1;  ///< steps between rows of the .csv files
};

/// [[probe]]: exactly one of node, point, group.
struct CaseProbe {
  Location where;
  Located<std::string> name;
  std::optional<Located<std::int64_t>> node;     ///< file number
  std::optional<Located<Vec3>> point;            ///< nearest node
  std::optional<Located<std::string>> group;     ///< mean over its nodes; for `stress` the cells that touch them;
                                                 ///< for `section_force` the cells that touch them on the side `side`
  std::vector<Located<std::string>> quantities;  ///< displacement, velocity, acceleration, stress, section_force
  std::optional<Vec3> side;                      ///< section_force: direction to the cells whose forces are summed
  std::optional<double> cfc;                     ///< SAE J211 channel frequency class
};

/// [[check]]
struct CaseCheck {
  Location where;
  Located<std::string> quantity;              ///< "displacement_z", "energy.ENER_CIN", "contact.force_z", ...
  std::optional<Located<std::string>> place;  ///< probe, contact or nothing for global quantities
  std::optional<Located<double>> time;        ///< default: the end
  std::optional<Located<double>> value;       ///< reference value; or
  bool exact = false;                         ///< reference = "exact": from [exact]
  double tolerance = 0.0;                     ///< relative to the reference unless absolute is set
  bool absolute = false;
  std::string source;
};

/// [exact]: the exact solution of this case, for checks and curves (see exact/bar_impact.hpp).
struct CaseExact {
  Location where;
  Located<std::string> solution;  ///< "bar_on_rigid_wall" or "bar_on_penalty_wall"
  double length = 0.0, area = 0.0, modulus = 0.0, density = 0.0, speed = 0.0, gap = 0.0;
  double stiffness = 0.0;             ///< penalty wall: stress per length
  double initial_displacement = 0.0;  ///< added to displacements (SDNV100 counts its initial +2 mm)
  int axis = 2;
};

struct Case {
  std::string file;
  std::string title;
  UnitSystem units = UnitSystem::si;
  CaseMesh mesh;
  std::vector<CaseMaterial> materials;
  std::vector<CasePart> parts;
  std::vector<CaseSupport> supports;
  std::vector<CaseLoad> loads;
  std::vector<CaseInitial> initial;
  std::vector<CaseContact> contacts;
  std::vector<CaseFunction> functions;
  CaseScheme scheme;
  CaseTime time;
  CaseSolver solver;
  CaseOutput output;
  std::vector<CaseProbe> probes;
  std::vector<CaseCheck> checks;
  std::optional<CaseExact> exact;
};

}  // namespace carom
