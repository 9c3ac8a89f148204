#include "rows/coulomb_block.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "math/vec3.hpp"

namespace carom {

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double no_compliance = 1e-14;  ///< a pivot below this part of its diagonal entry is round-off

/// r with W r + q = 0 by L D L^T; a component whose pivot vanishes gets r = 0.
Vec3 stick_force(const FrameBlock& W, const Vec3& q) {
  FrameBlock A = W;
  Vec3 r{-q[0], -q[1], -q[2]};
  std::array<bool, 3> used{};
  for (std::size_t k = 0; k < 3; ++k) {
    used[k] = A[4 * k] > no_compliance * W[4 * k];
    if (!used[k]) continue;
    for (std::size_t i = k + 1; i < 3; ++i) {
      const double factor = A[3 * i + k] / A[4 * k];
      for (std::size_t j = k + 1; j < 3; ++j) A[3 * i + j] -= factor * A[3 * k + j];
      r[i] -= factor * r[k];
    }
  }
  for (std::size_t k = 3; k-- > 0;) {
    if (!used[k]) {
      r[k] = 0.0;
      continue;
    }
    for (std::size_t j = k + 1; j < 3; ++j) r[k] -= A[3 * k + j] * r[j];
    r[k] /= A[4 * k];
  }
  return r;
}

/// True when the row really sticks under r: components without compliance cannot be stopped.
bool sticks(const FrameBlock& W, const Vec3& q, const Vec3& r, double mu) {
  if (!(r[0] >= 0.0) || !(std::hypot(r[1], r[2]) <= mu * r[0] * (1.0 + 4.0 * eps))) return false;
  for (std::size_t i = 1; i < 3; ++i) {
    const double w = W[3 * i] * r[0] + W[3 * i + 1] * r[1] + W[3 * i + 2] * r[2] + q[i];
    if (std::abs(w) > 1e-12 * std::max(std::abs(q[i]), std::abs(q[0]))) return false;
  }
  return true;
}

/// Slip as a function of the direction d = (cos theta, sin theta) of the tangential force mu r_n d, r_n being such that
/// w_n = 0: D r_n = -q_n, D w_T = v(d) = v_0 + V d, with D(d) = W_nn + mu W_nT . d. Wanted: v x d = 0, v . d <= 0, D >
/// 0.
class Slip {
 public:
  Slip(const FrameBlock& W, const Vec3& q, double mu) : W_(W), q_(q), mu_(mu) {
    for (std::size_t a = 0; a < 2; ++a) {
      v_0_[a] = W[0] * q[a + 1] - q[0] * W[3 * (a + 1)];
      for (std::size_t b = 0; b < 2; ++b) V_[2 * a + b] = mu * (q[a + 1] * W[b + 1] - q[0] * W[3 * (a + 1) + b + 1]);
    }
    scale_ = std::hypot(v_0_[0], v_0_[1]) + std::hypot(V_[0], V_[1]) + std::hypot(V_[2], V_[3]);
  }

  std::optional<Vec3> force() const {
    const double start = std::atan2(-v_0_[1], -v_0_[0]);
    for (const int intervals : {64, 4096}) {
      if (const auto r = force_at(newton(start, start - 1.0, start + 1.0))) return r;
      const double h = 2.0 * std::numbers::pi / intervals;
      double previous = start;
      for (int k = 1; k <= intervals; ++k) {
        const double next = start + h * k;
        if ((cross_product(previous) <= 0.0) != (cross_product(next) <= 0.0)) {
          if (const auto r = force_at(newton(0.5 * (previous + next), previous, next))) return r;
        }
        previous = next;
      }
    }
    return std::nullopt;
  }

 private:
  std::array<double, 2> v(double c, double s) const {
    return {v_0_[0] + V_[0] * c + V_[1] * s, v_0_[1] + V_[2] * c + V_[3] * s};
  }

  double cross_product(double theta) const {
    const double c = std::cos(theta), s = std::sin(theta);
    const auto [v_1, v_2] = v(c, s);
    return v_1 * s - v_2 * c;
  }

  double derivative(double theta) const {
    const double c = std::cos(theta), s = std::sin(theta);
    const auto [v_1, v_2] = v(c, s);
    return (V_[1] * c - V_[0] * s) * s + v_1 * c - (V_[3] * c - V_[2] * s) * c + v_2 * s;
  }

  /// Newton from theta, by bisection where it leaves a bracket (where the ends do not bracket a root it may find none).
  double newton(double theta, double lower, double upper) const {
    const bool rising = cross_product(lower) <= 0.0;
    for (int i = 0; i < 60; ++i) {
      const double value = cross_product(theta);
      if (value == 0.0) return theta;
      ((value < 0.0) == rising ? lower : upper) = theta;
      double next = theta - value / derivative(theta);
      if (!(next >= lower && next <= upper)) next = 0.5 * (lower + upper);
      if (std::abs(next - theta) <= eps * (1.0 + std::abs(theta))) return next;
      theta = next;
    }
    return theta;
  }

  std::optional<Vec3> force_at(double theta) const {
    const double c = std::cos(theta), s = std::sin(theta);
    const auto [v_1, v_2] = v(c, s);
    const double D = W_[0] + mu_ * (W_[1] * c + W_[2] * s);
    if (!(std::abs(v_1 * s - v_2 * c) <= 64.0 * eps * scale_)) return std::nullopt;
    if (!(D > 0.0) || v_1 * c + v_2 * s > 64.0 * eps * scale_) return std::nullopt;
    const double r_n = -q_[0] / D;
    return Vec3{r_n, mu_ * r_n * c, mu_ * r_n * s};
  }

  const FrameBlock& W_;
  const Vec3& q_;
  double mu_;
  std::array<double, 2> v_0_{};
  std::array<double, 4> V_{};
  double scale_ = 0.0;
};

/// |r_T| <= mu r_n by shortening r_T.
Vec3 shortened(const Vec3& r, double mu) {
  const double r_n = std::max(0.0, r[0]), length = std::hypot(r[1], r[2]);
  const double keep = length > mu * r_n ? mu * r_n / length : 1.0;
  return {r_n, keep * r[1], keep * r[2]};
}

}  // namespace

Vec3 solve_bond(const FrameBlock& W, const Vec3& q) {
  return stick_force(W, q);
}

Vec3 solve_coulomb(const FrameBlock& W, const Vec3& q, double mu) {
  assert(W[0] > 0.0);
  if (q[0] >= 0.0) return {};
  if (mu == 0.0) return {-q[0] / W[0], 0.0, 0.0};
  const Vec3 stick = stick_force(W, q);
  if (sticks(W, q, stick, mu)) return shortened(stick, mu);
  if (const auto slip = Slip(W, q, mu).force()) return *slip;
  return shortened(stick, mu);
}

}  // namespace carom
