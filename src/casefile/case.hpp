// The case: what the user asked for, typed, with defaults filled; every value knows where it was written.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/errors.hpp"
#include "base/types.hpp"
#include "base/units.hpp"
#include "casefile/case_contact.hpp"
#include "casefile/located.hpp"
#include "exact/solution.hpp"
#include "material/law.hpp"
#include "math/time_function.hpp"
#include "mesh/structured_block.hpp"
#include "model/compatibility.hpp"
#include "model/options.hpp"

namespace carom {

struct CaseMesh {
  Location where;
  Located<std::string> file;  ///< "" when blocks are given; relative to the case file's folder
  /// What a mesh file would hold, where a program gives the mesh (write_gmsh.hpp); `file` is then the name of it.
  std::shared_ptr<const std::string> text;
  std::vector<StructuredBlock> blocks;
  enum class Order : std::uint8_t { as_written, linear };
  Order order = Order::as_written;  ///< linear: cells of second order are taken by their corners
  int refine = 0;                   ///< how often every cell is cut in halves
  enum class Unused : std::uint8_t { refuse, ignore };
  Unused unused = Unused::refuse;  ///< cells that no part, interface or rigid surface takes
};

struct CaseMaterial {
  std::string name;
  Location where;
  Located<std::string> law;       ///< the name of a row of the table of laws, or of the library
  Located<std::string> library;   ///< "": none; relative to the case file's folder
  Located<std::string> checksum;  ///< of the library's file; in case files it may be left out
  const Law* loaded = nullptr;    ///< the law of the library
  Located<double> rho;
  std::map<std::string, Located<double>> values;  ///< of the parameters of the law, by their keys
  Located<std::vector<std::array<double, 2>>> curve;
  std::vector<double> rates;
  std::optional<JohnsonCookDamage> damage;

  const Located<double>& value(const std::string& key) const { return values.at(key); }
  /// Of a value, or of the law where it has none of this name.
  const Location& place_of(const std::string& key) const {
    return values.contains(key) ? values.at(key).where : law.where;
  }
  /// The row of its law; nullptr where that could not be read.
  const Law* row() const { return loaded != nullptr ? loaded : find_law(*law); }
  Material made() const;
};

struct CasePart {
  Location where;
  Located<std::string> name;
  Located<std::string> cells;     ///< cell group
  Located<std::string> material;  ///< key of [materials]
  Section section = Section::solid;
  std::optional<Located<std::string>> type;            ///< of the cells, "TETRA4"; absent: what the group has
  double thickness = 1.0;                              ///< plane_strain, plane_stress
  double area = 0.0;                                   ///< bar
  std::optional<Located<std::string>> formulation;     ///< absent: the element's first
  std::optional<Located<double>> hourglass;            ///< one_point
  std::optional<Located<double>> hourglass_viscosity;  ///< one_point
  std::optional<Located<double>> distortion_control;
  double linear_bulk_viscosity = 0.0, quadratic_bulk_viscosity = 0.0;
};

/// [[support]]: what is imposed on a group of nodes.
struct CaseSupport {
  Location where;
  Located<std::string> nodes;  ///< node or cell group, or "all"
  std::optional<Located<std::string>>
      symmetry;                   ///< "x", "y" or "z": normal of the symmetry plane; blocks that component
  std::array<bool, 3> blocked{};  ///< blocked = ["x", "y"]
  struct Motion {
    MotionKind kind{};
    int component = 0;
    Located<double> amplitude;
    std::optional<Located<std::string>> function;  ///< key of [functions]; constant 1 when absent
  };
  std::vector<Motion> motions;
};

/// [[load]]
struct CaseLoad {
  Location where;
  enum class Kind : std::uint8_t { force, total_force, pressure, gravity };
  Kind kind{};
  std::optional<Located<std::string>> group;  ///< nodes (force), faces (pressure), or either (total force)
  Vec3 vector{};                              ///< force on each node or in all, or acceleration of gravity
  double pressure = 0.0;
  std::optional<Located<std::string>> function;  ///< key of [functions]; constant 1 when absent
};

/// [[point_mass]]: exactly one of mass (of each node) and total.
struct CasePointMass {
  Location where;
  Located<std::string> nodes;
  std::optional<double> mass, total;
};

/// [[spring]]: to the ground (stiffness, total_stiffness) or to nodes of the group `to` (axial).
struct CaseSpring {
  Location where;
  Located<std::string> nodes;
  std::optional<Located<Vec3>> stiffness, total_stiffness;  ///< along x, y, z: of each node, or of all together
  std::optional<Located<std::string>> to;
  std::optional<double> axial;  ///< along the line between the two nodes
};

/// [[erosion]]: the cells of a part go when one of these is reached.
struct CaseErosion {
  Location where;
  Located<std::string> part;
  std::optional<double> plastic_strain, damage, distortion, time;
};

/// [[rigid_body]]: the cells of parts, and nodes of others, that move as one.
struct CaseRigidPart {
  Location where;
  Located<std::string> name;
  std::vector<Located<std::string>> parts;
  std::optional<Located<std::string>> nodes;   ///< of other parts, joined to the body
  std::optional<Located<std::string>> points;  ///< nodes of no part, which go along
  // Of the cells, where it is not given.
  std::optional<double> mass;
  std::optional<Located<Vec3>> inertia, centre_of_mass;
  std::optional<Vec3> products_of_inertia;
  std::optional<double> rigidity;
  CaseGuide guide;
};

/// [[equation]]: the sum over the terms of coefficient x displacement is zero; the first term is the dependent one.
struct CaseEquation {
  struct Term {
    Location where;
    Located<std::string> nodes;
    Located<std::string> dof;  ///< "x", "y" or "z"
    Located<double> coefficient;
  };
  Location where;
  std::string name;
  std::vector<Term> terms;
};

/// [[initial]]
struct CaseInitial {
  Location where;
  std::optional<Located<std::string>> nodes;  ///< node or cell group; exactly one of nodes, part
  std::optional<Located<std::string>> part;
  std::optional<Vec3> displacement;
  // The velocity is the sum of what is given of these.
  std::optional<Vec3> velocity;
  std::optional<Vec3> angular_velocity;
  std::optional<Vec3> centre;                                         ///< of the rotation
  std::optional<std::array<Located<std::string>, 3>> velocity_field;  ///< a formula in x, y, z for each component
  std::optional<Located<double>> drop_height;
  Vec3 fall{};  ///< the velocity after that fall

  bool has_velocity() const { return velocity || angular_velocity || velocity_field || drop_height; }
};

/// [initial_state]
struct CaseInitialState {
  Location where;
  Located<std::string> from;  ///< results folder of another run; relative to the case file's folder
};

struct CaseFunction {
  std::string name;
  Location where;
  bool is_called = false;  ///< computed by the program that uses Carom as a library, which sets function.called
  TimeFunction function;
};

/// Of the augmented Lagrangian: largest penetration, relative to the smallest cell.
inline constexpr double default_penetration = 1e-3;

/// [scheme], and the same keys of a [[stage]].
struct CaseScheme {
  Location where;
  Located<SchemeKind> kind;
  SchemeParameters parameters;                          ///< those of the kind, filled on reading
  std::optional<Located<EnforcementKind>> enforcement;  ///< filled on reading
  bool is_enforcement_chosen = false;                   ///< the case says none
  std::optional<double> penetration;  ///< augmented_lagrangian: largest penetration, relative to the smallest cell
  enum class Mass : std::uint8_t { consistent, lumped, modified };
  std::optional<Located<Mass>> mass;  ///< filled on reading: the scheme's default
  bool is_mass_chosen = false;        ///< the case says none
  enum class Redistribution : std::uint8_t { layers, least_squares };
  std::optional<Redistribution> redistribution;      ///< modified mass; filled on reading
  std::optional<int> layers;                         ///< modified mass over layers: their number; filled on reading
  std::optional<Located<double>> mass_scaling_step;  ///< explicit schemes: stable step that cells are made heavier for
  std::optional<double> mass_scaling_limit;          ///< largest share of mass added; filled on reading
};

/// [time], and the same keys of a [[stage]].
struct CaseTime {
  Location where;
  Located<double> end;
  std::optional<Located<double>> step;    ///< implicit schemes: required; explicit ones: default from the stable step
  bool fixed = false;                     ///< implicit schemes: never halve (a failing step ends the run)
  std::optional<double> event_tolerance;  ///< implicit schemes: closing rows cut the step, to this share of it
  double safety = 0.9;                    ///< explicit schemes: fraction of the stable step
};

/// [[stage]]: the run goes on with another scheme.
struct CaseStage {
  Location where;
  CaseScheme scheme;
  CaseTime time;
  std::vector<CaseInitial> initial;  ///< velocities that begin with it
};

struct CaseSolver {
  SolverKind kind = SolverKind::automatic;
  int max_contact_iterations = 50;
};

/// [guards]: what warns and what stops a run on the way.
struct CaseGuards {
  double energy_growth = 0.05;    ///< share of the initial and supplied energy
  double rotation_warning = 1.0;  ///< degrees
  double rotation_stop = 5.0;     ///< degrees
};

/// Those of output/quantities.hpp that are written by default.
std::vector<Located<std::string>> default_fields();

struct CaseOutput {
  Location where;
  std::vector<Located<std::string>> fields = default_fields();  ///< quantities, and variables that laws remember
  int fields_every = 0;  ///< steps; 0: about 50 times over the run, fewer times where that takes much disk
  enum class Format : std::uint8_t { xdmf, vtu };  ///< rows of frame_formats() (output/frame_format.hpp)
  Format format = Format::xdmf;
  enum class Precision : std::uint8_t { in_single, in_double };
  Precision precision = Precision::in_single;  ///< of the values of fields
  int curves_every = 1;                        ///< steps between rows of the .csv files
  int checkpoint_every = 0;                    ///< steps between checkpoints; 0: by time alone
  double checkpoint_minutes = 10.0;            ///< between checkpoints; 0: by steps alone
};

/// [[probe]]: exactly one of node, point, group, part.
struct CaseProbe {
  Location where;
  Located<std::string> name;
  std::optional<Located<std::int64_t>> node;     ///< file number
  std::optional<Located<Vec3>> point;            ///< nearest node
  std::optional<double> within;                  ///< largest distance from point to node; default: the cell at the node
  std::optional<Located<std::string>> group;     ///< mean over its nodes; of cells over those that touch them
  std::optional<Located<std::string>> part;      ///< sums over it
  std::vector<Located<std::string>> quantities;  ///< of output/quantities.hpp, and variables that laws remember
  std::optional<Vec3> side;                      ///< section_force: direction to the cells whose forces are summed
  std::optional<double> cfc;                     ///< SAE J211 channel frequency class
  bool shock = false;                            ///< of its accelerations (output/shock.hpp)
  std::optional<double> quality_factor;          ///< of the shock response spectrum; with shock 10
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

/// [exact]: the exact solution of this case, for checks and curves.
struct CaseExact {
  Location where;
  Located<std::string> solution;  ///< the name of a row of exact_solutions()
  ExactValues values;             ///< of all parameters of the row
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
  std::vector<CasePointMass> point_masses;
  std::vector<CaseSpring> springs;
  std::vector<CaseEquation> equations;
  std::vector<CaseErosion> erosion;
  std::vector<CaseRigidPart> rigid_parts;
  std::vector<CaseLoad> loads;
  std::optional<CaseInitialState> initial_state;
  std::vector<CaseInitial> initial;
  std::vector<CaseContact> contacts;
  std::vector<CaseFunction> functions;
  CaseScheme scheme;
  CaseTime time;
  std::vector<CaseStage> stages;  ///< after [scheme] and [time]
  CaseSolver solver;
  CaseGuards guards;
  CaseOutput output;
  std::vector<CaseProbe> probes;
  std::vector<CaseCheck> checks;
  std::optional<CaseExact> exact;
};

}  // namespace carom
