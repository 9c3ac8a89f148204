#include "material/isotropic_parameters.hpp"
#include "material/lateral.hpp"
#include "material/law_list.hpp"

namespace carom {

Law neo_hookean_row() {
  return {.name = "neo_hookean",
          .summary = "the compressible neo-Hookean law, for finite rotations and strains",
          .formula =
              "W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2, S = G (1 - C^-1) + lambda ln J C^-1, C = F^T F, "
              "J = det F (Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., "
              "eqs. 6.27 and 6.28).",
          .measure = Measure::green_lagrange,
          .parameters = isotropic_parameters(),
          .at_rest = isotropic_at_rest,
          .prepare = prepare_lame,
          .lateral_strain = lateral_strain_neo_hookean};
}

}  // namespace carom
