// Traction of a wall on a flying elastic bar that hits it.
#pragma once

namespace carom {

/// q(s) = p / (rho c v0), p the compressive traction on the bar's face, s >= 0 the time since first touch.
///
/// Rigid wall: q = 1 on [0, T), T = 2 L / c the round trip of a wave. Penalty wall, p = eps_N x penetration: with
/// t_c = rho c / eps_N, x = s / t_c and X = T / t_c, the characteristics give the delay equation
///   dq/dx = 1 - q(x) - 2 (q(x - X) + q(x - 2 X) + ...),
/// whose Laplace transform expands in powers of exp(-X sigma) to
///   q(x) = sum over k of h_k(x - k X) - h_k(x - (k + 1) X),  h_0 = 1 - exp(-x),
///   h_k = l_(k-1) - l_k - h_(k-1),  l_k = exp(-x) L_k(2 x), L_k the Laguerre polynomials, all zero for x < 0.
/// It holds until q vanishes (release); from there on q = 0. For X > 1.7 the release lies in the second phase, where
/// q = exp(-y) (2 - exp(-X) + 2 y) - 1, y = x - X.
///
/// Free rigid mass m at rest: its velocity follows m dv/dt = Z (v0 - v), Z = rho c A, so that q = exp(-s Z / m) on
/// [0, T); the wave that returns then would pull, and the bar leaves.
class WallTraction {
 public:
  /// round_trip: T > 0. contact_time: t_c >= 0; 0 is the rigid wall. Throws std::invalid_argument when T < 0.01 t_c
  /// (the bar then bounces as a rigid mass and the series needs too many terms).
  WallTraction(double round_trip, double contact_time);
  /// A free mass; decay_time: m / Z > 0.
  static WallTraction free_mass(double round_trip, double decay_time);

  /// q(s); 0 outside [0, duration).
  double value(double s) const;
  /// Integral of q from 0 to s; constant after the release.
  double integral(double s) const;
  /// Time from first touch to release.
  double duration() const { return duration_; }

 private:
  double find_release() const;

  double round_trip_, contact_time_, duration_;
  double decay_time_ = 0.0;  ///< of the free mass; 0: none
};

}  // namespace carom
