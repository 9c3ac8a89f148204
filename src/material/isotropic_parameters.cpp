#include "material/isotropic_parameters.hpp"

namespace carom {

std::vector<LawParameter> isotropic_parameters() {
  return {
      {"E", "Young's modulus.", Dimension::stress, {.low = 0.0}, {}, {"young", "youngs_modulus", "modulus"}},
      {"nu",
       "Poisson's ratio.",
       Dimension::none,
       {-1.0, 0.5},
       {},
       {"poisson", "poissons_ratio"},
       {},
       "Poisson's ratio of a material lies between 0 and 0.5. At 0.5 a body cannot change its volume at all, and its bulk modulus is infinite: take 0.499 with "
       "formulation = \"mean_dilatation\"."}};
}

IsotropicElastic isotropic_at_rest(const Material& material) {
  return {material.value("E"), material.value("nu"), material.rho};
}

std::shared_ptr<const void> prepare_lame(const Material& material) {
  return std::make_shared<const LameParameters>(material.at_rest().lame());
}

}  // namespace carom
