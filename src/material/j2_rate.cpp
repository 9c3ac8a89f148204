#include "material/isotropic_parameters.hpp"
#include "material/law_list.hpp"
#include "material/plastic_prepare.hpp"
#include "material/rate_hardening.hpp"

namespace carom {

namespace {

std::shared_ptr<const void> prepare_j2_rate(const Material& material) {
  const RateHardening hardening(material);
  return prepare_plastic(material, hardening.elastic_limit(), hardening);
}

const char* const rate_text =
    " with sigma_y(alpha, d alpha / dt) = the polygon of hardening_tables over the equivalent plastic strain alpha, "
    "linear "
    "in the rate between two of rates and constant outside; strain and rate are those of the end of a step. All "
    "plastic "
    "work counts as dissipated.";

Law j2_rate_law(const char* kinematics) {
  return {
      .summary = "von Mises plasticity with hardening that depends on the rate",
      .formula = std::string(kinematics) + rate_text,
      .parameters = isotropic_parameters(),
      .curve_key = "hardening_tables",
      .curve_meaning =
          "Points [plastic strain, yield stress] of a polygon for each of rates, one after the other: each begins at "
          "plastic strain 0; its last stress holds beyond.",
      .rates_key = "rates",
      .rates_meaning = "Rates of plastic strain of the polygons, in increasing order.",
      .at_rest = isotropic_at_rest,
      .prepare = prepare_j2_rate,
      .check = check_rate_hardening};
}

}  // namespace

Law j2_rate_small_strain_row() {
  Law law = j2_rate_law("The radial return of j2_small_strain");
  law.name = "j2_rate_small_strain";
  law.summary += ", for small strains and rotations";
  law.measure = Measure::small_strain;
  law.when_turning = "\"j2_rate\"";
  law.history = {"plastic_strain_xx", "plastic_strain_yy", "plastic_strain_zz",         "plastic_strain_xy",
                 "plastic_strain_yz", "plastic_strain_zx", "equivalent_plastic_strain", "plastic_work"};
  return law;
}

Law j2_rate_row() {
  Law law = j2_rate_law("The kinematics and the flow of j2");
  law.name = "j2_rate";
  law.summary += ", for finite strains";
  law.measure = Measure::green_lagrange;
  law.history = {"plastic_c_inverse_xx", "plastic_c_inverse_yy", "plastic_c_inverse_zz",      "plastic_c_inverse_xy",
                 "plastic_c_inverse_yz", "plastic_c_inverse_zx", "equivalent_plastic_strain", "plastic_work"};
  return law;
}

}  // namespace carom
