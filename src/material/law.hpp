// A constitutive law as a row of the table, and a material: a law with the values of its parameters.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/units.hpp"
#include "material/isotropic_elastic.hpp"
#include "material/johnson_cook_damage.hpp"
#include "math/interval.hpp"

struct carom_law;  // material/carom_law.h

namespace carom {

/// Variables of a history that others than the law go by: equivalent plastic strain, rise of the temperature, damage.
inline constexpr const char* yielding_by = "equivalent_plastic_strain";
inline constexpr const char* heating_by = "temperature_rise";
inline constexpr const char* damaged_by = "damage";

/// A number that the user of a law gives.
struct LawParameter {
  std::string key;      ///< in case files
  std::string meaning;  ///< one sentence, with its symbol where that is not the key
  Dimension unit = Dimension::none;
  Interval range{};
  std::optional<double> initial{};     ///< its value where it is not given; empty: it must be
  std::vector<std::string> aliases{};  ///< other names that people try
  std::string initial_phrase{};        ///< in place of a value that stands for none
  std::string remedy{};                ///< what helps where a value is not taken

  bool operator==(const LawParameter&) const = default;
};

/// What is wrong about values that are each in their range.
struct LawProblem {
  std::string key, found, expected, remedy;
};

struct Law;

/// A law with the values that it was given.
struct Material {
  const Law* law = nullptr;                  ///< a row of laws() or of a library (material/loaded_law.hpp)
  double rho = 0.0;                          ///< mass per (reference) volume
  std::vector<double> values;                ///< in the order of Law::parameters
  std::vector<std::array<double, 2>> curve;  ///< of the law's key curve_key; empty: not given
  std::vector<double> rates;                 ///< of the law's key rates_key
  std::optional<JohnsonCookDamage> damage;   ///< of laws that yield

  /// Hooke's law without stiffness.
  Material() : Material(LinearElastic{}) {}
  Material(const LinearElastic& given);      // NOLINT(google-explicit-constructor): the same in another form
  Material(const StVenantKirchhoff& given);  // NOLINT(google-explicit-constructor)
  Material(const NeoHookean& given);         // NOLINT(google-explicit-constructor)
  /// Values by their keys; those that are not named have their initial values. Throws std::invalid_argument for names
  /// that are not in the table.
  Material(std::string_view law, double rho, const std::vector<std::pair<std::string_view, double>>& values);

  Material(const Law& law, double rho, const std::vector<std::pair<std::string_view, double>>& values);

  /// The value of a parameter of the law; throws std::invalid_argument for others.
  double value(std::string_view key) const;
  /// Names of the variables that a point remembers: those of the law, and its damage.
  std::vector<std::string> history() const;
  /// The moduli of small changes of the body at rest.
  IsotropicElastic at_rest() const;
};

/// What the strain and the stress of a law are (material/point_batch.hpp).
enum class Measure : std::uint8_t { small_strain, green_lagrange };

/// One row of the table: all that is known of a law but for its kernels (material/law_table.hpp).
struct Law {
  std::string name{};     ///< in case files
  std::string summary{};  ///< a phrase
  std::string formula{};  ///< formulas with their sources, for docs/material_laws.md
  Measure measure = Measure::small_strain;
  /// Of small strain: the laws to take where cells turn, for messages.
  std::string when_turning{};
  std::vector<LawParameter> parameters{};
  std::string curve_key{}, curve_meaning{};  ///< a table of pairs (abscissa, stress); "": the law takes none
  std::string rates_key{}, rates_meaning{};  ///< a list of rates; "": the law takes none
  /// Names of the variables that a point remembers. All are 0 at rest.
  std::vector<std::string> history{};
  bool is_linear = false;  ///< the stress is a fixed linear function of the strain
  /// Without one, schemes and sections that need it are refused. Tangents are symmetric: all solvers count on it.
  bool has_tangent = true;
  IsotropicElastic (*at_rest)(const Material&) = nullptr;
  /// What the kernels take as their parameters.
  std::shared_ptr<const void> (*prepare)(const Material&) = nullptr;
  /// Rules between the values; nothing when all is well.
  std::optional<LawProblem> (*check)(const Material&) = nullptr;
  /// The share of the plastic work that heats the point where it is done. Null: 0.
  double (*heating_share)(const Material&) = nullptr;
  /// The strain in the last `count` directions under which the stress there vanishes, where it has a closed form: of
  /// what prepare() made, and the other strains. Null: it is found by iteration.
  double (*lateral_strain)(const void* parameters, const double strain[6], int count) = nullptr;
  const carom_law* loaded = nullptr;  ///< of a library: its functions; null: a row of laws()
};

/// The table.
const std::vector<Law>& laws();
/// The row of this name; nullptr when there is none.
const Law* find_law(std::string_view name);
/// Its position in the table.
std::size_t index_of(const Law& law);

}  // namespace carom
