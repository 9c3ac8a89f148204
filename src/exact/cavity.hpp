// A spherical cavity in an infinite elastic solid is put under pressure: exact solution.
#pragma once

namespace carom {

/// Any consistent units.
struct SphericalCavityData {
  double radius = 0.0;    ///< a
  double modulus = 0.0;   ///< E
  double nu = 0.0;        ///< (-1, 0.5)
  double density = 0.0;   ///< rho
  double pressure = 0.0;  ///< p, from t = 0 on; positive pushes outwards
};

/// Radial motion for r >= a by the potential f(tau) / r, tau = t - (r - a) / c, c the speed of pressure waves, G the
/// shear modulus: u = -f / r^2 - f' / (r c), and the pressure on the wall asks for
///   f'' + 2 alpha f' + omega_0^2 f = -p a / rho,  alpha = 2 G / (rho a c),  omega_0^2 = 4 G / (rho a^2),
///   f = -p a^3 / (4 G) (1 - exp(-alpha tau) (cos(omega tau) + alpha / omega sin(omega tau))),
/// with omega^2 = omega_0^2 - alpha^2 > 0 (Achenbach, Wave Propagation in Elastic Solids, 1973, section 4.4; Blake,
/// J. Acoust. Soc. Am. 24, 1952). All zero ahead of the front, tau < 0; at the front the value is the one after it.
class SphericalCavity {
 public:
  /// Throws std::invalid_argument when radius, modulus or density is not positive, nu out of range, or pressure not
  /// finite.
  explicit SphericalCavity(const SphericalCavityData& data);

  double displacement(double r, double t) const;
  double velocity(double r, double t) const;
  /// Tension positive.
  double radial_stress(double r, double t) const;
  double hoop_stress(double r, double t) const;
  /// p a^3 / (4 G r^2), for t to infinity.
  double static_displacement(double r) const;
  /// Time of the largest displacement of the wall: the first root of f' / a + f'' / c = 0.
  double time_of_peak() const;
  /// c = sqrt((lambda + 2 G) / rho)
  double wave_speed() const { return c_; }

 private:
  /// f and its derivatives by tau.
  struct Potential {
    double f = 0.0, d1 = 0.0, d2 = 0.0;
  };
  Potential potential(double r, double t) const;

  SphericalCavityData data_;
  double G_ = 0.0, lambda_ = 0.0, c_ = 0.0, alpha_ = 0.0, omega_ = 0.0;
};

}  // namespace carom
