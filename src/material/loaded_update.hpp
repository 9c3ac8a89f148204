// Laws from libraries as batch kernels: what stands between PointBatch and material/carom_law.h.
#pragma once

#include <memory>

#include "material/carom_law.h"
#include "material/linear_elastic_update.hpp"
#include "material/point_batch.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// What the kernels of a loaded law take.
struct LoadedParameters {
  const carom_law* law = nullptr;
  std::shared_ptr<const double[]> values;
  double rho = 0.0;
  LameParameters at_rest;  ///< for laws without tangent
};

/// A body at rest.
alignas(64) inline constexpr double all_zero[CAROM_LAW_MOST_HISTORY * 8] = {};

/// parameters: const LoadedParameters*. Points at rest, which have no history, are asked for one by one.
template <class Real>
static void loaded_update(const void* parameters, const PointBatch& batch) {
  const auto& own = *static_cast<const LoadedParameters*>(parameters);
  constexpr int n = lanes<Real>;
  const int H = own.law->history_count, count = batch.points * n;
  leave_modes_elastic(batch, count);  // of laws that know nothing of them
  if (H == 0) fill_all(batch.dissipation, count, 0.0);
  carom_law_points points{.points = batch.points,
                          .lanes = n,
                          .parameters = own.values.get(),
                          .rho = own.rho,
                          .dt = batch.dt,
                          .strain = batch.strain,
                          .history = batch.history,
                          .is_over = batch.is_over ? 1 : 0,
                          .stress = batch.stress,
                          .energy = batch.energy,
                          .dissipation = batch.dissipation,
                          .new_history = batch.new_history,
                          .wave_modulus = batch.wave_modulus,
                          .yield_stress = batch.yield_stress,
                          .mode_square = batch.mode_square,
                          .share = batch.share};
  if (H == 0 || batch.history != nullptr) return own.law->update(&points);
  points.points = 1;
  points.history = all_zero;
  const auto go_on = [](auto*& place, int by) {
    if (place != nullptr) place += by;
  };
  for (int p = 0; p < batch.points; ++p) {
    own.law->update(&points);
    points.strain += 6 * n;
    points.stress += 6 * n;
    go_on(points.new_history, H * n);
    for (double** place :
         {&points.energy, &points.dissipation, &points.wave_modulus, &points.yield_stress, &points.share})
      go_on(*place, n);
    go_on(points.mode_square, n);
  }
}

template <class Real>
static void loaded_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& own = *static_cast<const LoadedParameters*>(parameters);
  constexpr int n = lanes<Real>;
  const int count = batch.points * n;
  leave_modes_elastic(batch, count);
  if (own.law->tangent == nullptr) return linear_elastic_tangent<Real>(&own.at_rest, batch);
  carom_law_changes changes{.points = batch.points,
                            .lanes = n,
                            .parameters = own.values.get(),
                            .rho = own.rho,
                            .dt = batch.dt,
                            .strain = batch.strain,
                            .history = batch.history,
                            .strain_change = batch.strain_change,
                            .stress_change = batch.stress_change,
                            .mode_square = batch.mode_square,
                            .half_change = batch.half_change,
                            .share = batch.share,
                            .along = batch.along};
  if (own.law->history_count == 0 || batch.history != nullptr) return own.law->tangent(&changes);
  changes.points = 1;
  changes.history = all_zero;
  for (int p = 0; p < batch.points; ++p) {
    own.law->tangent(&changes);
    changes.strain += 6 * n;
    changes.strain_change += 6 * n;
    changes.stress_change += 6 * n;
    for (const double** place : {&changes.mode_square, &changes.half_change})
      if (*place != nullptr) *place += n;
    for (double** place : {&changes.share, &changes.along})
      if (*place != nullptr) *place += n;
  }
}

template <class Real>
static constexpr LawKernels loaded_kernels() {
  return {loaded_update<Real>, loaded_tangent<Real>};
}

}  // namespace carom
