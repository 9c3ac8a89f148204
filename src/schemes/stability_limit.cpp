#include "schemes/stability_limit.hpp"

#include <cmath>
#include <limits>

namespace carom {

namespace {

double hulbert_chung_limit(double r) {
  return std::sqrt(12.0 * (1.0 + r) * (2.0 - r) / (10.0 + r * (r - 5.0)));
}

/// Displacement and h times velocity after a step of Noh and Bathe's scheme with h = 1 and a = -w^2 u.
struct Oscillator {
  double u, v;
};
Oscillator noh_bathe_step(double p, double w, const Oscillator& start) {
  const double q1 = (1.0 - 2.0 * p) / (2.0 * p * (1.0 - p)), q2 = 0.5 - p * q1, q0 = 0.5 - q1 - q2, k = 1.0 - p;
  const double a0 = -w * w * start.u, up = start.u + p * start.v + 0.5 * p * p * a0;
  const double ap = -w * w * up, vp = start.v + 0.5 * p * (a0 + ap);
  const double u1 = up + k * vp + 0.5 * k * k * ap, a1 = -w * w * u1;
  return {u1, vp + k * (q0 * a0 + (0.5 + q1) * ap + q2 * a1)};
}

/// Both eigenvalues of a real 2 x 2 matrix lie in the unit circle when |det| <= 1 and |trace| <= 1 + det.
bool noh_bathe_is_stable(double p, double w) {
  const Oscillator first = noh_bathe_step(p, w, {1.0, 0.0}), second = noh_bathe_step(p, w, {0.0, 1.0});
  const double trace = first.u + second.v, det = first.u * second.v - first.v * second.u;
  constexpr double round_off = 1e-12;
  return std::abs(det) <= 1.0 + round_off && std::abs(trace) <= 1.0 + det + round_off;
}

double noh_bathe_limit(double p) {
  double stable = 0.0, step = 1e-2;
  while (noh_bathe_is_stable(p, stable + step)) stable += step;
  for (; step > 1e-10; step *= 0.5) {
    if (noh_bathe_is_stable(p, stable + step)) stable += step;
  }
  return stable;
}

}  // namespace

double stability_limit(const SchemeSettings& settings) {
  if (!is_explicit(settings.kind)) return std::numeric_limits<double>::infinity();
  switch (settings.kind) {
    case SchemeKind::hulbert_chung:
      return hulbert_chung_limit(settings.rho_inf);
    case SchemeKind::noh_bathe:
      return noh_bathe_limit(settings.p);
    case SchemeKind::tchamwa_wielgosz:
      return 2.0 / std::sqrt(2.0 * settings.phi - 1.0);
    default:
      return 2.0;
  }
}

}  // namespace carom
