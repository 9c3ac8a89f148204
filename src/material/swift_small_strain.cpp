#include "material/isotropic_parameters.hpp"
#include "material/law_list.hpp"
#include "material/plastic_prepare.hpp"
#include "material/swift_small_strain_update.hpp"

namespace carom {

namespace {

std::shared_ptr<const void> prepare_swift(const Material& material) {
  const Swift swift{material.value("yield_stress"), material.value("pre_strain"), material.value("exponent")};
  return prepare_plastic(material, swift.yield, swift);
}

std::vector<LawParameter> swift_parameters() {
  std::vector<LawParameter> parameters = isotropic_parameters();
  const LawParameter own[] = {
      {"yield_stress",
       "First yield stress in tension.",
       Dimension::stress,
       {.low = 0.0},
       {},
       {"yield", "sigma_y", "sigma_0"}},
      {"pre_strain", "Plastic strain that Swift's curve has behind it at rest.", Dimension::none, {.low = 0.0}, {}, {}},
      {"exponent",
       "Exponent of Swift's hardening; 0: none.",
       Dimension::none,
       {.low = 0.0, .high = 1.0, .is_closed_low = true, .is_closed_high = true},
       {},
       {"n"}}};
  for (const LawParameter& parameter : own) parameters.push_back(parameter);
  return parameters;
}

}  // namespace

Law swift_small_strain_row() {
  return {.name = "swift_small_strain",
          .summary = "von Mises plasticity with Swift's hardening, for small strains and rotations",
          .formula =
              "The radial return of j2_small_strain with sigma_y(alpha) = yield_stress (1 + alpha / "
              "pre_strain)^exponent (H. W. Swift, J. Mech. Phys. Solids 1, 1952). All plastic work counts as "
              "dissipated: the integral of sigma_y over the equivalent plastic strain alpha. largest_plastic_rate is "
              "the largest d alpha / dt of all steps so far; the stress does not depend on it.",
          .measure = Measure::small_strain,
          .when_turning = "\"j2\"",
          .parameters = swift_parameters(),
          .history = {"plastic_strain_xx", "plastic_strain_yy", "plastic_strain_zz", "plastic_strain_xy",
                      "plastic_strain_yz", "plastic_strain_zx", "equivalent_plastic_strain", "largest_plastic_rate"},
          .at_rest = isotropic_at_rest,
          .prepare = prepare_swift};
}

}  // namespace carom
