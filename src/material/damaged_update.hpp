// Johnson and Cook's damage over a number type, beside any law that yields.
#pragma once

#include "material/damaged_law.hpp"
#include "material/point_of_batch.hpp"
#include "material/symmetric.hpp"
#include "math/elementary.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// Mean over von Mises stress of a point, at most 1e6 either way, and 0 without stress. Both are invariants of tau and
/// need no F: those of S C = F^-1 tau F, C = 1 + 2 E. J changes nothing in their ratio.
template <class Real>
[[gnu::always_inline]] static inline Real triaxiality(const double* strain, const double* stress, bool is_finite) {
  constexpr int n = lanes<Real>;
  constexpr double steepest = 1e-6, least = 1e-300;
  const Real zero{};
  Real A[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) A[i][j] = load<Real>(stress + voigt_place[i][j] * n);
  if (is_finite) {
    Real S[3][3], twice_E[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        S[i][j] = A[i][j];
        twice_E[i][j] = (i == j ? 2.0 : 1.0) * load<Real>(strain + voigt_place[i][j] * n);
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) A[i][j] += S[i][k] * twice_E[k][j];
  }
  const Real mean = (A[0][0] + A[1][1] + A[2][2]) * (1.0 / 3.0);
  for (int i = 0; i < 3; ++i) A[i][i] -= mean;
  Real square = zero;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square += A[i][j] * A[j][i];
  const Real equivalent = square_root(Real(1.5 * (square > 0.0 ? square : zero)));
  const Real floor = steepest * (mean > 0.0 ? mean : -mean) + least;
  return mean / (equivalent > floor ? equivalent : floor);
}

/// [D1 + D2 exp(D3 eta)] [1 + D4 ln(max(rate / reference_rate, 1))] [1 + D5 theta] (JohnsonCookDamage), the rate that
/// of an increment of the plastic strain over dt, theta between 0 and 1 that of the beginning of the step.
template <class Real>
[[gnu::always_inline]] static inline Real strain_at_fracture(const DamagedLaw& law, const PointBatch& point,
                                                             const Real& increment) {
  const Real zero{}, one = zero + 1.0;
  const JohnsonCookDamage& d = law.values;
  const Real eta = triaxiality<Real>(point.strain, point.stress, law.is_finite);
  Real fracture = d.D1 + d.D2 * exponential(Real(d.D3 * eta));
  const double slow = law.reference_rate * point.dt;
  if (d.D4 != 0.0 && slow > 0.0) {
    const Real ratio = increment * (1.0 / slow);
    fracture = fracture * (1.0 + d.D4 * natural_logarithm(Real(ratio > 1.0 ? ratio : one)));
  }
  if (d.D5 != 0.0) {
    const double* rise = at(point.history, law.temperature_rise.value_or(0) * lanes<Real>);
    const Real theta = law.theta + law.theta_by_rise * (rise == nullptr ? zero : load<Real>(rise));
    fracture = fracture * (1.0 + d.D5 * (theta > 0.0 ? (theta < 1.0 ? theta : one) : zero));
  }
  return fracture;
}

/// Writes the damage at the end of the step behind the variables of the law, which are there already. It grows by 1 at
/// most, and by 1 where a point flows that can bear no plastic strain at all.
template <class Real>
static void store_damage(const DamagedLaw& law, const PointBatch& point) {
  constexpr int n = lanes<Real>;
  const Real zero{}, one = zero + 1.0;
  const int own = law.history * n, strain = law.plastic_strain * n;
  Real increment = load<Real>(point.new_history + strain), damage = zero;
  if (point.history != nullptr) {
    increment -= load<Real>(point.history + strain);
    damage = load<Real>(point.history + own);
  }
  if (any_above(increment, 0.0)) {
    const Real fracture = strain_at_fracture(law, point, increment);
    const Real growth = fracture > increment ? increment / fracture : one;
    damage += increment > 0.0 ? growth : zero;
  }
  store(point.new_history + own, damage);
}

/// parameters: const DamagedLaw*. History: that of the law, then the damage.
template <class Real>
static void damaged_update(const void* parameters, const PointBatch& batch) {
  const auto& law = *static_cast<const DamagedLaw*>(parameters);
  for (int p = 0; p < batch.points; ++p) {
    const PointBatch point = point_of<lanes<Real>>(batch, p, law.history + 1);
    law.kernels.update(law.parameters, point);
    if (point.new_history != nullptr) store_damage<Real>(law, point);
  }
}

/// That of the law.
template <class Real>
static void damaged_tangent(const void* parameters, const TangentBatch& batch) {
  const auto& law = *static_cast<const DamagedLaw*>(parameters);
  constexpr int n = lanes<Real>;
  for (int p = 0; p < batch.points; ++p)
    law.kernels.tangent(law.parameters,
                        {1, batch.strain + 6 * p * n, batch.strain_change + 6 * p * n, batch.stress_change + 6 * p * n,
                         batch.dt, at(batch.history, (law.history + 1) * n * p), at(batch.mode_square, p * n),
                         at(batch.half_change, p * n), at(batch.share, p * n), at(batch.along, p * n)});
}

template <class Real>
static constexpr LawKernels damaged_kernels() {
  return {damaged_update<Real>, damaged_tangent<Real>};
}

}  // namespace carom
