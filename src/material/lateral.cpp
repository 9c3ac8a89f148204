#include "material/lateral.hpp"

#include <algorithm>
#include <cmath>

#include "material/linear_elastic_update.hpp"
#include "material/neo_hookean_update.hpp"

namespace carom {
namespace {

using LateralStrain = double (*)(const LameParameters&, const double[6], int);

/// The strain of one point with its lateral components solved for; they are at 3 - count, ..., 2.
template <int count, LateralStrain lateral_strain>
void complete(const void* parameters, double strain[6]) {
  const double lateral = lateral_strain(*static_cast<const LameParameters*>(parameters), strain, count);
  std::fill(strain + 3 - count, strain + 3, lateral);
}

template <int count, LateralStrain lateral_strain, BatchUpdate update>
void lateral_update(const void* parameters, const PointBatch& batch) {
  for (int p = 0; p < batch.points; ++p) complete<count, lateral_strain>(parameters, batch.strain + 6 * p);
  update(parameters, batch);
  for (int p = 0; p < batch.points; ++p) std::fill(batch.stress + 6 * p + 3 - count, batch.stress + 6 * p + 3, 0.0);
}

/// dS = D dE + D l (change of the lateral strain), l the unit lateral strain, so that the lateral stress stays zero.
template <int count, LateralStrain lateral_strain, BatchTangent tangent>
void lateral_tangent(const void* parameters, const TangentBatch& batch) {
  for (int p = 0; p < batch.points; ++p) {
    double strain[6], change[6], unit[6] = {}, by_lateral[6];
    std::copy_n(batch.strain + 6 * p, 6, strain);
    complete<count, lateral_strain>(parameters, strain);
    std::copy_n(batch.strain_change + 6 * p, 6, change);
    std::fill(change + 3 - count, change + 3, 0.0);
    std::fill(unit + 3 - count, unit + 3, 1.0);
    double* result = batch.stress_change + 6 * p;
    tangent(parameters, {1, strain, change, result});
    tangent(parameters, {1, strain, unit, by_lateral});
    const double ratio = result[2] / by_lateral[2];
    for (int c = 0; c < 6; ++c) result[c] -= ratio * by_lateral[c];
    std::fill(result + 3 - count, result + 3, 0.0);
  }
}

template <int count>
LawKernels linear() {
  return {lateral_update<count, lateral_strain_linear, linear_elastic_update<double>>,
          lateral_tangent<count, lateral_strain_linear, linear_elastic_tangent<double>>};
}

template <int count>
LawKernels neo_hookean() {
  return {lateral_update<count, lateral_strain_neo_hookean, neo_hookean_update<double>>,
          lateral_tangent<count, lateral_strain_neo_hookean, neo_hookean_tangent<double>>};
}

}  // namespace

double lateral_strain_linear(const LameParameters& lame, const double strain[6], int count) {
  const double trace = count == 1 ? strain[0] + strain[1] : strain[0];
  return -lame.lambda * trace / (2.0 * lame.G + count * lame.lambda);
}

double lateral_strain_neo_hookean(const LameParameters& lame, const double strain[6], int count) {
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

LawKernels plane_stress_linear() {
  return linear<1>();
}
LawKernels plane_stress_neo_hookean() {
  return neo_hookean<1>();
}
LawKernels bar_linear() {
  return linear<2>();
}
LawKernels bar_neo_hookean() {
  return neo_hookean<2>();
}

}  // namespace carom
