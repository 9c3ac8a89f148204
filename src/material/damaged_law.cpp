#include "material/damaged_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace carom {

namespace {

std::optional<int> place_of(const Law& law, std::string_view variable) {
  const auto found = std::ranges::find(law.history, variable);
  if (found == law.history.end()) return std::nullopt;
  return static_cast<int>(found - law.history.begin());
}

bool has_parameter(const Law& law, std::string_view key) {
  return std::ranges::find(law.parameters, key, &LawParameter::key) != law.parameters.end();
}

std::optional<double> reference_rate_of(const Material& material) {
  if (material.damage->reference_rate) return material.damage->reference_rate;
  if (has_parameter(*material.law, "reference_rate")) return material.value("reference_rate");
  return std::nullopt;
}

}  // namespace

bool yields(const Law& law) {
  return place_of(law, yielding_by).has_value();
}

PreparedLaw with_damage(const Material& material, const PreparedLaw& law, const LawKernels& damaged) {
  DamagedLaw own{law.kernels, law.parameters.get(), law.parameters};
  own.history = law.history;
  own.plastic_strain = place_of(*material.law, yielding_by).value();
  own.is_finite = material.law->measure == Measure::green_lagrange;
  own.values = *material.damage;
  own.reference_rate = reference_rate_of(material).value_or(0.0);
  own.temperature_rise = place_of(*material.law, heating_by);
  if (own.temperature_rise) {
    const double reference = material.value("reference_temperature");
    own.theta_by_rise = 1.0 / (material.value("melting_temperature") - reference);
    own.theta = (material.value("initial_temperature") - reference) * own.theta_by_rise;
  }
  return {damaged, std::make_shared<const DamagedLaw>(std::move(own)), law.history + 1};
}

std::optional<LawProblem> check_damage(const Material& material) {
  const JohnsonCookDamage& d = *material.damage;
  const double in_tension = d.D1 + d.D2 * std::exp(d.D3 / 3.0);
  if (!(in_tension > 0.0))
    return LawProblem{"D1", fmt::format("D1 + D2 exp(D3 / 3) = {:g}", in_tension), "a strain at fracture > 0",
                      "That is the strain at which a bar under slow tension breaks."};
  if (d.D4 != 0.0 && !reference_rate_of(material))
    return LawProblem{"D4", fmt::format("{:g} without reference_rate", d.D4), "reference_rate beside it",
                      fmt::format("The law {} has none of its own.", material.law->name)};
  if (d.D5 != 0.0 && !place_of(*material.law, heating_by))
    return LawProblem{"D5", fmt::format("{:g} with law = \"{}\"", d.D5, material.law->name),
                      "a law that knows the temperature", "Take \"johnson_cook\", or leave D5 out."};
  return std::nullopt;
}

}  // namespace carom
