#include "material/hardening.hpp"
#include "material/isotropic_parameters.hpp"
#include "material/law_list.hpp"
#include "material/plastic_prepare.hpp"

namespace carom {

namespace {

std::shared_ptr<const void> prepare_j2(const Material& material) {
  const Hardening hardening(material);
  return prepare_plastic(material, hardening.elastic_limit(), hardening);
}

const char* const hardening_text =
    " sigma_y(alpha) = yield_stress + hardening_modulus alpha + (saturation_stress - yield_stress)(1 - "
    "exp(-saturation_rate alpha)) (linear hardening, and E. Voce, J. Inst. Metals 74, 1948), or the polygon of "
    "hardening_table. All plastic work counts as dissipated: the integral of sigma_y over the equivalent plastic "
    "strain "
    "alpha.";

Law j2_law() {
  std::vector<LawParameter> parameters = isotropic_parameters();
  for (const LawParameter& parameter : hardening_parameters()) parameters.push_back(parameter);
  return {.parameters = std::move(parameters),
          .curve_key = "hardening_table",
          .curve_meaning =
              "Points [plastic strain, yield stress] of a polygon, the first at plastic strain 0; the last "
              "stress holds beyond.",
          .at_rest = isotropic_at_rest,
          .prepare = prepare_j2,
          .check = check_hardening};
}

}  // namespace

Law j2_small_strain_row() {
  Law law = j2_law();
  law.name = "j2_small_strain";
  law.summary = "von Mises plasticity with isotropic hardening, for small strains and rotations";
  law.formula = std::string(
                    "sigma = K tr(eps) 1 + 2 G dev(eps - eps_p), sqrt(3/2) |dev sigma| <= sigma_y(alpha), the "
                    "associated flow by radial return (Simo and Hughes, Computational Inelasticity, boxes 3.1 "
                    "and 3.2).") +
                hardening_text;
  law.measure = Measure::small_strain;
  law.when_turning = "\"j2\"";
  law.history = {"plastic_strain_xx", "plastic_strain_yy", "plastic_strain_zz",        "plastic_strain_xy",
                 "plastic_strain_yz", "plastic_strain_zx", "equivalent_plastic_strain"};
  return law;
}

Law j2_row() {
  Law law = j2_law();
  law.name = "j2";
  law.summary = "von Mises plasticity with isotropic hardening, for finite strains";
  law.formula = std::string(
                    "F = F_e F_p, tau = K tr(eps) 1 + 2 G dev(eps) of the logarithmic elastic strain eps = "
                    "ln(F_e F_e^T) / 2, sqrt(3/2) |dev tau| <= sigma_y(alpha), the associated flow by the "
                    "exponential map and radial return (J. C. Simo, Comput. Methods Appl. Mech. Eng. 99, 1992; "
                    "de Souza Neto, Peric and Owen, Computational Methods for Plasticity, box 14.3); tau is "
                    "force per reference area, J times the Cauchy stress.") +
                hardening_text;
  law.measure = Measure::green_lagrange;
  law.history = {"plastic_c_inverse_xx", "plastic_c_inverse_yy", "plastic_c_inverse_zz",     "plastic_c_inverse_xy",
                 "plastic_c_inverse_yz", "plastic_c_inverse_zx", "equivalent_plastic_strain"};
  return law;
}

}  // namespace carom
