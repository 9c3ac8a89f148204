#include "material/lateral.hpp"

#include <cmath>
#include <utility>

#include "material/damaged_law.hpp"
#include "material/law_kernels.hpp"

namespace carom {

double lateral_strain_linear(const void* parameters, const double strain[6], int count) {
  const auto& lame = *static_cast<const LameParameters*>(parameters);
  const double trace = count == 1 ? strain[0] + strain[1] : strain[0];
  return -lame.lambda * trace / (2.0 * lame.G + count * lame.lambda);
}

double lateral_strain_neo_hookean(const void* parameters, const double strain[6], int count) {
  const auto& lame = *static_cast<const LameParameters*>(parameters);
  double change = 2.0 * strain[0];  // D - 1
  if (count == 1) change += 2.0 * strain[1] + 4.0 * strain[0] * strain[1] - strain[3] * strain[3];
  const double log_D = std::log1p(change);
  double y = 0.0;
  constexpr int most = 100;
  for (int i = 0; i < most; ++i) {
    const double residual = lame.G * std::expm1(y) + 0.5 * lame.lambda * (log_D + count * y);
    const double step = residual / (lame.G * std::exp(y) + 0.5 * count * lame.lambda);
    y -= step;
    if (!(std::abs(step) > 1e-15 * std::abs(y))) break;
  }
  return 0.5 * std::expm1(y);
}

PreparedLaw prepare(const Material& material, int free_directions, const LawTable& table) {
  const Law& law = *material.law;
  const LawKernels& kernels = law.loaded != nullptr ? table.loaded : table.laws[index_of(law)];
  PreparedLaw prepared{kernels, law.prepare(material), static_cast<int>(law.history.size())};
  if (material.damage) prepared = with_damage(material, prepared, table.damaged);
  if (free_directions == 0) return prepared;
  LateralLaw lateral{prepared.kernels, prepared.parameters.get(), prepared.parameters, law.lateral_strain,
                     free_directions};
  lateral.history = prepared.history;
  lateral.total_history = prepared.history + (law.lateral_strain == nullptr ? 1 : 0);
  lateral.least_strain = law.measure == Measure::small_strain ? -1e3 : -0.5;
  prepared.history = lateral.total_history;
  prepared.kernels = table.lateral;
  prepared.parameters = std::make_shared<const LateralLaw>(std::move(lateral));
  return prepared;
}

}  // namespace carom
