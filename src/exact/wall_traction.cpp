#include "exact/wall_traction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace carom {

namespace {

struct Term {
  double h = 0.0;         ///< h_k(x)
  double integral = 0.0;  ///< of h_k from 0 to x
};

/// h_k and its integral H_k: H_0 = x - h_0, H_k = h_(k-1) - h_k - H_(k-1).
Term term(int k, double x) {
  if (x <= 0.0) return {};
  const double decay = std::exp(-x);
  double laguerre_old = 0.0, laguerre = 1.0;
  Term current{-std::expm1(-x), x + std::expm1(-x)};
  for (int j = 1; j <= k; ++j) {
    const double next = ((2 * j - 1 - 2.0 * x) * laguerre - (j - 1) * laguerre_old) / j;
    laguerre_old = laguerre;
    laguerre = next;
    const double h = decay * (laguerre_old - laguerre) - current.h;
    current = {h, current.h - h - current.integral};
  }
  return current;
}

/// q(x) and its integral before the release, times in units of t_c.
Term series(double x, double X) {
  Term sum;
  for (int k = 0; k * X < x; ++k) {
    const Term enters = term(k, x - k * X), leaves = term(k, x - (k + 1) * X);
    sum.h += enters.h - leaves.h;
    sum.integral += enters.integral - leaves.integral;
  }
  return sum;
}

}  // namespace

WallTraction::WallTraction(double round_trip, double contact_time)
    : round_trip_(round_trip), contact_time_(contact_time), duration_(round_trip) {
  if (contact_time == 0.0) return;
  if (!(round_trip >= 0.01 * contact_time))
    throw std::invalid_argument(
        fmt::format("bar impact: the wall is too soft: its stiffness times L / modulus is {:.3g}, at least 0.005 is "
                    "needed",
                    0.5 * round_trip / contact_time));
  duration_ = contact_time * find_release();
}

WallTraction WallTraction::free_mass(double round_trip, double decay_time) {
  WallTraction traction(round_trip, 0.0);
  traction.decay_time_ = decay_time;
  return traction;
}

double WallTraction::find_release() const {
  const double X = round_trip_ / contact_time_;
  // q rises up to X; the steps are short against both the delay and the decay.
  const double step = std::min(X, 1.0) / 16.0;
  double inside = X;
  while (series(inside + step, X).h > 0.0) inside += step;
  double outside = inside + step;
  while (true) {
    const double middle = 0.5 * (inside + outside);
    if (middle <= inside || middle >= outside) return middle;
    (series(middle, X).h > 0.0 ? inside : outside) = middle;
  }
}

double WallTraction::value(double s) const {
  if (s < 0.0 || s >= duration_) return 0.0;
  if (decay_time_ > 0.0) return std::exp(-s / decay_time_);
  return contact_time_ == 0.0 ? 1.0 : series(s / contact_time_, round_trip_ / contact_time_).h;
}

double WallTraction::integral(double s) const {
  const double until = std::clamp(s, 0.0, duration_);
  if (decay_time_ > 0.0) return -decay_time_ * std::expm1(-until / decay_time_);
  if (contact_time_ == 0.0) return until;
  return contact_time_ * series(until / contact_time_, round_trip_ / contact_time_).integral;
}

}  // namespace carom
