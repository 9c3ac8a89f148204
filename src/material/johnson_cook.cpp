#include "material/johnson_cook.hpp"

#include <fmt/format.h>

#include "material/isotropic_parameters.hpp"
#include "material/law_list.hpp"
#include "material/plastic_prepare.hpp"

namespace carom {

namespace {

std::shared_ptr<const void> prepare_johnson_cook(const Material& material) {
  const auto value = [&material](const char* key) { return material.value(key); };
  JohnsonCook jc{value("A"), value("B"), value("n"), value("C"), value("m"), value("reference_rate")};
  jc.reference_temperature = value("reference_temperature");
  jc.melting_temperature = value("melting_temperature");
  jc.initial_temperature = value("initial_temperature");
  jc.heating = value("taylor_quinney") / (material.rho * value("specific_heat"));
  return prepare_plastic(material, 0.0, jc);
}

std::optional<LawProblem> check_johnson_cook(const Material& material) {
  const double melting = material.value("melting_temperature");
  for (const char* key : {"reference_temperature", "initial_temperature"})
    if (!(material.value(key) < melting))
      return LawProblem{key, fmt::format("{:g} with melting_temperature = {:g}", material.value(key), melting),
                        "a temperature below that of melting", "Both are absolute, in K."};
  return std::nullopt;
}

std::vector<LawParameter> johnson_cook_parameters() {
  const Interval not_negative{.low = 0.0, .is_closed_low = true};
  const double room = 293.15;
  std::vector<LawParameter> parameters = isotropic_parameters();
  const LawParameter own[] = {
      {"A",
       "Yield stress at the reference rate and temperature.",
       Dimension::stress,
       {.low = 0.0},
       {},
       {"yield_stress"}},
      {"B", "Factor of the hardening.", Dimension::stress, not_negative, {}, {}},
      {"n", "Exponent of the hardening.", Dimension::none, {.low = 0.0}, {}, {}},
      {"C",
       "Factor of the logarithm of the rate; 0: no influence of the rate.",
       Dimension::none,
       not_negative,
       0.0,
       {}},
      {"m", "Exponent of the softening by heat.", Dimension::none, {.low = 0.0}, 1.0, {}},
      {"reference_rate",
       "Rate of plastic strain below which there is no influence of the rate.",
       Dimension::rate,
       {.low = 0.0},
       {},
       {"epsilon_0", "strain_rate"}},
      {"melting_temperature",
       "Temperature at which nothing of the yield stress is left.",
       Dimension::temperature,
       {.low = 0.0},
       {},
       {"T_melt"}},
      {"reference_temperature",
       "Temperature up to which the yield stress does not soften.",
       Dimension::temperature,
       {.low = 0.0},
       room,
       {"T_room", "T_ref"}},
      {"initial_temperature", "Temperature at the start.", Dimension::temperature, {.low = 0.0}, room, {"T_0"}},
      {"specific_heat", "Heat per mass and temperature.", Dimension::specific_heat, {.low = 0.0}, {}, {"c_p"}},
      {"taylor_quinney",
       "Share of the plastic work that heats, at once and where it is done; 0: no heating.",
       Dimension::none,
       {.low = 0.0, .high = 1.0, .is_closed_low = true, .is_closed_high = true},
       0.9,
       {"chi"}}};
  for (const LawParameter& parameter : own) parameters.push_back(parameter);
  return parameters;
}

}  // namespace

Law johnson_cook_row() {
  return {.name = "johnson_cook",
          .summary = "Johnson and Cook's plasticity with rate and adiabatic heating, for finite strains",
          .formula =
              "The kinematics and the flow of j2 with sigma_y = (A + B alpha^n)(1 + C ln(max(rate / reference_rate, "
              "1)))(1 - theta^m), rate = d alpha / dt, theta = (T - reference_temperature) / (melting_temperature - "
              "reference_temperature) between 0 and 1 (G. R. Johnson and W. H. Cook, Proc. 7th Int. Symp. Ballistics, "
              "1983). T rises by taylor_quinney / (rho specific_heat) times the plastic work, without conduction; a "
              "step takes the temperature of its beginning, and strain and rate of its end. All plastic work counts as "
              "dissipated.",
          .measure = Measure::green_lagrange,
          .parameters = johnson_cook_parameters(),
          .history = {"plastic_c_inverse_xx", "plastic_c_inverse_yy", "plastic_c_inverse_zz", "plastic_c_inverse_xy",
                      "plastic_c_inverse_yz", "plastic_c_inverse_zx", "equivalent_plastic_strain", "plastic_work",
                      "temperature_rise"},
          .at_rest = isotropic_at_rest,
          .prepare = prepare_johnson_cook,
          .check = check_johnson_cook,
          .heating_share = [](const Material& material) { return material.value("taylor_quinney"); }};
}

}  // namespace carom
