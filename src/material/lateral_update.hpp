// Laws under zero lateral stress over a number type: plane stress and bars, from the laws in three dimensions.
#pragma once

#include "material/lateral.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// The strain of one point, lane by lane, with its lateral components solved for.
template <int n>
static void complete_strain(const LateralLaw& law, double* strain) {
  for (int l = 0; l < n; ++l) {
    double one[6];
    for (int c = 0; c < 6; ++c) one[c] = strain[c * n + l];
    const double lateral = law.lateral_strain(law.parameters, one, law.free_directions);
    for (int c = 3 - law.free_directions; c < 3; ++c) strain[c * n + l] = lateral;
  }
}

template <int n>
static void fill_lateral(const LateralLaw& law, double value, double* voigt) {
  for (int c = 3 - law.free_directions; c < 3; ++c)
    for (int l = 0; l < n; ++l) voigt[c * n + l] = value;
}

/// parameters: const LateralLaw*.
template <class Real>
static void lateral_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const LateralLaw*>(parameters);
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) complete_strain<n>(law, batch.strain + 6 * p * n);
  law.kernels.update(law.parameters, batch);
  for (int p = 0; p < batch.points; ++p) fill_lateral<n>(law, 0.0, batch.stress + 6 * p * n);
}

/// dS = D dE + D l (change of the lateral strain), l the unit lateral strain, so that the lateral stress stays zero.
template <class Real>
static void lateral_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const LateralLaw*>(parameters);
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) {
    double strain[6 * n], change[6 * n], unit[6 * n] = {}, by_lateral[6 * n];
    for (int c = 0; c < 6 * n; ++c) {
      strain[c] = batch.strain[6 * p * n + c];
      change[c] = batch.strain_change[6 * p * n + c];
    }
    complete_strain<n>(law, strain);
    fill_lateral<n>(law, 0.0, change);
    fill_lateral<n>(law, 1.0, unit);
    double* result = batch.stress_change + 6 * p * n;
    law.kernels.tangent(law.parameters, {1, strain, change, result, batch.dt});
    law.kernels.tangent(law.parameters, {1, strain, unit, by_lateral, batch.dt});
    for (int l = 0; l < n; ++l) {
      const double ratio = result[2 * n + l] / by_lateral[2 * n + l];
      for (int c = 0; c < 6; ++c) result[c * n + l] -= ratio * by_lateral[c * n + l];
    }
    fill_lateral<n>(law, 0.0, result);
  }
}

template <class Real>
static constexpr LawKernels lateral_kernels() {
  return {lateral_update<Real>, lateral_tangent<Real>};
}

}  // namespace carom
