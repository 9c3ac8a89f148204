#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "material/isotropic_parameters.hpp"
#include "material/law_list.hpp"
#include "material/plastic_prepare.hpp"

namespace carom {

namespace {

/// The yield stress at the end of a step, and its slope over the change of alpha.
struct YieldPoint {
  double stress = 0.0, slope = 0.0;
};

struct JohnsonCook {
  double A = 0.0, B = 0.0, n = 0.0, C = 0.0, m = 0.0, reference_rate = 0.0;
  double reference_temperature = 0.0, melting_temperature = 0.0, initial_temperature = 0.0;
  double heating = 0.0;  ///< temperature per plastic work, taylor_quinney / (rho specific_heat)

  double strain_factor(double alpha) const { return A + B * std::pow(alpha, n); }

  /// 1 - theta^m
  double softening(double plastic_work) const {
    const double range = melting_temperature - reference_temperature;
    const double T = (initial_temperature + heating * plastic_work - reference_temperature) / range;
    return 1.0 - std::pow(std::clamp(T, 0.0, 1.0), m);
  }

  /// After a change x > 0 of alpha in the time dt (0: at rest), without what softens.
  YieldPoint at(double alpha, double x, double dt) const {
    const double strain = strain_factor(alpha + x), strain_slope = B * n * std::pow(alpha + x, n - 1.0);
    if (!(dt > 0.0) || x <= reference_rate * dt) return {strain, strain_slope};
    const double rate = 1.0 + C * std::log(x / (reference_rate * dt));
    return {strain * rate, strain_slope * rate + strain * C / x};
  }
};

/// The root x in (0, trial / 3 G] of trial - 3 G x = yield stress at x and the temperature of the beginning of the
/// step, by Newton's method where it stays between what is known to be on both sides, else by halving.
bool flow_johnson_cook(const PlasticLaw& law, double trial, double dt, double* variables, PlasticFlow& flow) {
  const auto& jc = *static_cast<const JohnsonCook*>(law.parameters);
  const double alpha = variables[0], three_G = 3.0 * law.lame.G, softening = jc.softening(variables[1]);
  if (!(trial > softening * jc.strain_factor(alpha))) return false;
  double low = 0.0, high = trial / three_G, x = 0.5 * high;
  constexpr int most = 200;
  for (int i = 0; i < most; ++i) {
    const YieldPoint y = jc.at(alpha, x, dt);
    const double excess = trial - three_G * x - softening * y.stress;
    (excess > 0.0 ? low : high) = x;
    const double change = excess / (three_G + softening * y.slope), newton = x + change;
    const bool is_found = std::abs(change) <= 1e-15 * x || std::abs(excess) <= 4e-16 * trial;  // the excess' round-off
    x = is_found || (newton > low && newton < high) ? newton : 0.5 * (low + high);
    if (is_found) break;
  }
  flow.stress = std::max(trial - three_G * x, 0.0);  // of molten metal not a round-off below
  flow.slope = softening * jc.at(alpha, x, dt).slope;
  variables[0] = alpha + x;
  variables[1] += flow.stress * x;
  variables[2] = jc.heating * variables[1];
  return true;
}

double yield_stress_johnson_cook(const PlasticLaw& law, const double* variables) {
  const auto& jc = *static_cast<const JohnsonCook*>(law.parameters);
  return jc.softening(variables[1]) * jc.strain_factor(variables[0]);
}

double work_johnson_cook(const PlasticLaw&, const double* variables) {
  return variables[1];
}

std::shared_ptr<const void> prepare_johnson_cook(const Material& material) {
  const auto value = [&material](const char* key) { return material.value(key); };
  JohnsonCook jc{value("A"), value("B"), value("n"), value("C"), value("m"), value("reference_rate")};
  jc.reference_temperature = value("reference_temperature");
  jc.melting_temperature = value("melting_temperature");
  jc.initial_temperature = value("initial_temperature");
  jc.heating = value("taylor_quinney") / (material.rho * value("specific_heat"));
  PlasticLaw law;
  law.variables = 3;
  law.flow = flow_johnson_cook;
  law.yield_stress = yield_stress_johnson_cook;
  law.plastic_work = work_johnson_cook;
  return prepare_plastic(material, law, jc);
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
              "dissipated. No damage.",
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
