// An elastic bar spins about its middle, set going from its rest shape: exact solution to leading order.
#pragma once

namespace carom {

/// Any consistent units.
struct SpinningBarData {
  double half_length = 0.0;  ///< L
  double modulus = 0.0;      ///< E
  double density = 0.0;      ///< rho
  double spin = 0.0;         ///< w at t = 0, rad per time
};

/// Stretch of a thin bar that starts to spin without deformation, at the distance x from its middle:
///   u_tt = c^2 u_xx + w^2 x,  u(0) = 0,  u_x(L) = 0,  u = u_t = 0 at t = 0,
///   u = U(x) - (U(x - c t) + U(x + c t)) / 2,  U = w^2 / c^2 (L^2 x / 2 - x^3 / 6)
/// with U continued odd about 0 and even about L (d'Alembert; period 4 L / c). The tip reaches twice its static
/// place, 2/3 w^2 L^3 / c^2, at 2 L / c. Left out are terms smaller by (w L / c)^2: the pull that grows with u, the
/// change of w by conservation of angular momentum, finite strain. With the first alone, at a held w L / c = 0.05, the
/// tip reaches 0.66733 w^2 L^3 / c^2 at 2 L / c.
class SpinningBar {
 public:
  /// Throws std::invalid_argument when half_length, modulus or density is not positive, or spin not finite.
  explicit SpinningBar(const SpinningBarData& data);

  /// Along the bar, outwards; 0 <= x <= L.
  double displacement(double x, double t) const;
  double velocity(double x, double t) const;
  /// Axial, tension positive.
  double stress(double x, double t) const;
  double wave_speed() const { return c_; }

 private:
  /// U and its derivative, continued to any x.
  struct Shape {
    double U = 0.0, slope = 0.0;
  };
  Shape shape(double x) const;

  SpinningBarData data_;
  double c_;
};

}  // namespace carom
