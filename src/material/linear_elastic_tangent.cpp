#include "material/linear_elastic_tangent.hpp"

#include <cstddef>

namespace carom {

VoigtMatrix tangent(const LinearElastic& material) {
  VoigtMatrix D{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) D[i][j] = material.lame_lambda();
    D[i][i] += 2.0 * material.shear_modulus();
    D[3 + i][3 + i] = material.shear_modulus();
  }
  return D;
}

}  // namespace carom
