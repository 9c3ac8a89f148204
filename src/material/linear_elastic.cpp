#include "material/isotropic_parameters.hpp"
#include "material/lateral.hpp"
#include "material/law_list.hpp"

namespace carom {

Law linear_elastic_row() {
  return {.name = "linear_elastic",
          .summary = "Hooke's law, for small strains and rotations",
          .formula = "sigma = lambda tr(eps) 1 + 2 G eps, lambda = E nu / ((1 + nu)(1 - 2 nu)), G = E / (2 (1 + nu)).",
          .measure = Measure::small_strain,
          .when_turning = "\"st_venant_kirchhoff\" (moderate strain) or \"neo_hookean\" (large strain)",
          .parameters = isotropic_parameters(),
          .is_linear = true,
          .at_rest = isotropic_at_rest,
          .prepare = prepare_lame,
          .lateral_strain = lateral_strain_linear};
}

Law st_venant_kirchhoff_row() {
  return {.name = "st_venant_kirchhoff",
          .summary = "St. Venant and Kirchhoff's law, for finite rotations and moderate strains",
          .formula =
              "S = lambda tr(E) 1 + 2 G E of the Green-Lagrange strain E = (F^T F - 1) / 2 (Belytschko, Liu, "
              "Moran and Elkhodary, Nonlinear Finite Elements for Continua and Structures, 2nd ed., eq. "
              "5.4.51).",
          .measure = Measure::green_lagrange,
          .parameters = isotropic_parameters(),
          .is_linear = true,
          .at_rest = isotropic_at_rest,
          .prepare = prepare_lame,
          .lateral_strain = lateral_strain_linear};
}

}  // namespace carom
