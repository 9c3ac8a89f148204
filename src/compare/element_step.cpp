#include "compare/element_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "build/build_mesh.hpp"
#include "build/build_model.hpp"
#include "solid/smallest_cell.hpp"

namespace carom::compare {

double element_step(const Case& given) {
  const Model model = build_model(given, std::make_shared<const Mesh>(build_mesh(given)));
  double fastest = 0.0;
  for (const Part& part : model.parts)
    fastest = std::max(fastest, std::sqrt(part.material.at_rest().p_wave_modulus() / part.material.rho));
  const Solid solid(model);
  return smallest_cell(solid) / fastest;
}

}  // namespace carom::compare
