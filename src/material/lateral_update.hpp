// Laws under zero lateral stress over a number type: plane stress and bars, from the laws in three dimensions.
#pragma once

#include <limits>

#include "material/lateral.hpp"
#include "material/point_of_batch.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

template <int n>
static void fill_lateral(const LateralLaw& law, const double* value, double* voigt) {
  for (int c = 3 - law.free_directions; c < 3; ++c)
    for (int l = 0; l < n; ++l) voigt[c * n + l] = value[l];
}

template <int n>
static void fill_lateral(const LateralLaw& law, double value, double* voigt) {
  for (int c = 3 - law.free_directions; c < 3; ++c)
    for (int l = 0; l < n; ++l) voigt[c * n + l] = value;
}

/// What is known of the lateral strain of a lane: the stress is negative at low and not at high.
struct LateralSearch {
  double low = 0.0, high = 0.0, last_change = 0.0;
  bool is_found = false;
};

/// The next lateral strain by Newton's method, where that stays between low and high, else their middle; lateral
/// stresses rise with their strain. Found when the change is round-off of the strains (scale), or as small as that of a
/// step that has gone before: then it is round-off of the history.
static inline double next_lateral(LateralSearch& search, double x, double stress, double slope, double scale) {
  if (!(stress < 0.0 || stress >= 0.0)) {
    search.is_found = true;
    return stress;
  }
  (stress < 0.0 ? search.low : search.high) = x;
  const double newton = x - stress / slope, change = newton < x ? x - newton : newton - x;
  constexpr double round_off = 1e-15, small = 1e-12;
  search.is_found = !(change > round_off * scale) || (change < small && 2.0 * change >= search.last_change);
  search.last_change = change;
  const bool is_near = change < small || (newton > search.low && newton < search.high);
  return is_near ? newton : 0.5 * (search.low + search.high);
}

/// Solves for the lateral strain of one point, lane by lane, and puts it into `strain`. It begins with that of the
/// beginning of the step, the last history variable, and ends there when the step is over. A lane that is no number
/// stays so.
template <class Real>
static void complete_strain(const LateralLaw& law, double* strain, const double* history, double dt,
                            const double* mode_square, bool is_over = false) {
  constexpr int n = lanes<Real>;
  double x[n];
  if (law.lateral_strain != nullptr) {
    for (int l = 0; l < n; ++l) {
      double one[6];
      for (int c = 0; c < 6; ++c) one[c] = strain[c * n + l];
      x[l] = law.lateral_strain(law.parameters, one, law.free_directions);
    }
    fill_lateral<n>(law, x, strain);
    return;
  }
  // Strains below -1/2 turn the body inside out (Green-Lagrange) or crush it; beyond 1e3 nothing is left of it.
  LateralSearch search[n];
  double unit[6 * n] = {}, stress[6 * n], slope[6 * n];
  const double at_rest[n] = {};
  for (int l = 0; l < n; ++l) {
    search[l] = {law.least_strain, 1e3, 1e3};
    x[l] = history == nullptr ? 0.0 : history[law.history * n + l];
  }
  if (is_over && history != nullptr) {
    fill_lateral<n>(law, x, strain);
    return;
  }
  fill_lateral<n>(law, 1.0, unit);
  constexpr int most = 100;
  bool all_found = false;
  for (int i = 0; i < most && !all_found; ++i) {
    fill_lateral<n>(law, x, strain);
    PointBatch point{1, strain, stress, nullptr, dt, history};
    point.mode_square = mode_square;
    law.kernels.update(law.parameters, point);
    law.kernels.tangent(law.parameters, {1, strain, unit, slope, dt, history, mode_square, at_rest});
    all_found = true;
    for (int l = 0; l < n; ++l) {
      if (search[l].is_found) continue;
      double scale = 0.0;
      for (int c = 0; c < 6; ++c) {
        const double e = strain[c * n + l];
        scale = e > scale ? e : -e > scale ? -e : scale;
      }
      x[l] = next_lateral(search[l], x[l], stress[2 * n + l], slope[2 * n + l], scale);
      all_found = all_found && search[l].is_found;
    }
  }
  for (int l = 0; l < n; ++l)
    if (!search[l].is_found) x[l] = std::numeric_limits<double>::quiet_NaN();  // the step is refused
  fill_lateral<n>(law, x, strain);
}

/// parameters: const LateralLaw*. History: that of the law in three dimensions, then the lateral strain where it has to
/// be iterated for.
template <class Real>
static void lateral_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const LateralLaw*>(parameters);
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p) {
    const PointBatch point = point_of<n>(batch, p, law.total_history);
    complete_strain<Real>(law, point.strain, point.history, point.dt, point.mode_square, point.is_over);
    law.kernels.update(law.parameters, point);
    fill_lateral<n>(law, 0.0, point.stress);
    for (int l = 0; l < n; ++l) {
      if (point.new_history != nullptr && law.total_history > law.history)
        point.new_history[law.history * n + l] = point.strain[2 * n + l];
    }
  }
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
    const double* history = batch.history == nullptr ? nullptr : batch.history + law.total_history * n * p;
    const double* mode_square = at(batch.mode_square, p * n);
    complete_strain<Real>(law, strain, history, batch.dt, mode_square);
    fill_lateral<n>(law, 0.0, change);
    fill_lateral<n>(law, 1.0, unit);
    double* result = batch.stress_change + 6 * p * n;
    const double at_rest[n] = {};
    double along[n];
    double* of_both = at(batch.along, p * n);
    law.kernels.tangent(law.parameters, {1, strain, change, result, batch.dt, history, mode_square,
                                         at(batch.half_change, p * n), at(batch.share, p * n), of_both});
    law.kernels.tangent(law.parameters, {1, strain, unit, by_lateral, batch.dt, history, mode_square, at_rest,
                                         at(batch.share, p * n), of_both == nullptr ? nullptr : along});
    for (int l = 0; l < n; ++l) {
      const double ratio = result[2 * n + l] / by_lateral[2 * n + l];
      for (int c = 0; c < 6; ++c) result[c * n + l] -= ratio * by_lateral[c * n + l];
      if (of_both != nullptr) of_both[l] -= ratio * along[l];
    }
    fill_lateral<n>(law, 0.0, result);
  }
}

template <class Real>
static constexpr LawKernels lateral_kernels() {
  return {lateral_update<Real>, lateral_tangent<Real>};
}

}  // namespace carom
