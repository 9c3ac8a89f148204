// The exact solutions that a case can name, one row each: the keys of [exact], their documentation, and the curves
// beside those of a run follow from the rows.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/units.hpp"
#include "exact/bar_motion.hpp"
#include "math/interval.hpp"

namespace carom {

/// A number that a solution is made from.
struct ExactParameter {
  std::string key;      ///< in case files
  std::string meaning;  ///< one sentence
  Dimension unit = Dimension::none;
  Interval range{};
  std::optional<double> initial{};  ///< its value where it is not given; empty: it must be

  bool operator==(const ExactParameter&) const = default;
};

/// A section within [exact]: what another body is made from.
struct ExactBody {
  std::string key;
  std::string meaning;
  std::vector<ExactParameter> parameters;
};

/// The numbers of a case by their keys; those of a section within [exact] as "section.key".
using ExactValues = std::map<std::string, double>;

/// A function of time.
using ExactCurve = std::function<double(double t)>;

/// At a place: displacement, velocity and axial stress; an empty one says nothing.
struct ExactPoint {
  ExactCurve displacement{}, velocity{}, stress{};
};

/// A place of a body in the mesh of a case.
struct ExactPlace {
  double x = 0.0;  ///< coordinate along the axis of the motion
  int part = 0;    ///< position in the case of its part
};

/// What the solutions go by of the case, beside their numbers.
struct ExactCase {
  double until = 0.0;   ///< curves are asked for times up to it
  double lowest = 0.0;  ///< lowest coordinate of the parts along the axis
  std::size_t parts = 0;
  int pressed_part = 1;  ///< that the force of the first contact acts on
};

/// What a solution says of a run, along the axis of the motion. An empty function says nothing; the functions keep what
/// they need.
struct ExactMotion {
  std::function<ExactPoint(const ExactPlace&)> at{};
  ExactCurve force{};                                          ///< of the only contact on the part that it presses
  ExactCurve obstacle_velocity{};                              ///< of the only contact's obstacle
  std::vector<std::pair<std::string, ExactCurve>> energies{};  ///< by terms of the ledger
};

/// A row of the table.
struct ExactSolution {
  std::string name{};     ///< in case files
  std::string summary{};  ///< a phrase
  std::vector<ExactParameter> parameters{};
  std::vector<ExactBody> bodies{};
  /// The values are those of all parameters. Throws std::invalid_argument for numbers that make no sense together.
  ExactMotion (*motion)(const ExactValues& values, const ExactCase& given) = nullptr;
};

/// The solutions there are: one line each. For X(name): name_row() gives its row, defined in a source file of its own.
#define CAROM_EXACT_SOLUTIONS(X) \
  X(bar_on_rigid_wall)           \
  X(bar_on_penalty_wall)         \
  X(bar_on_free_mass)            \
  X(bouncing_bar)                \
  X(two_bars)                    \
  X(sphere_on_rigid_wall)        \
  X(sliding_block)               \
  X(friction_oscillator)

#define CAROM_DECLARE_SOLUTION(solution) ExactSolution solution##_row();
CAROM_EXACT_SOLUTIONS(CAROM_DECLARE_SOLUTION)
#undef CAROM_DECLARE_SOLUTION

/// The table.
const std::vector<ExactSolution>& exact_solutions();
/// The row of this name, which the table must have.
const ExactSolution& exact_solution(std::string_view name);

/// A parameter that must be given, > 0.
ExactParameter positive(std::string key, std::string meaning, Dimension unit);
/// A parameter >= 0, which is 0 where it is not given.
ExactParameter not_negative(std::string key, std::string meaning, Dimension unit);
/// length, area, modulus and density of an elastic bar, which is called "of the bar".
std::vector<ExactParameter> bar_parameters();
/// The distance at the start.
ExactParameter gap_parameter();
ExactParameter gravity_parameter();

/// The bar that these values describe; its velocity is `speed`, where it is one of them.
ElasticBar bar_of(const ExactValues& values, const std::string& section = "");

}  // namespace carom
