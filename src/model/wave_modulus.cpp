#include "model/wave_modulus.hpp"

namespace carom {

double wave_modulus(const Part& part) {
  const IsotropicElastic m = part.material.at_rest();
  if (part.section == Section::bar) return m.E;
  if (part.section == Section::plane_stress) return m.E / (1.0 - m.nu * m.nu);
  return m.p_wave_modulus();
}

}  // namespace carom
