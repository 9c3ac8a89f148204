// Motion of an elastic bar with one free end, from the wave that leaves its other end.
#pragma once

#include <string_view>

#include "exact/piecewise_linear.hpp"

namespace carom {

/// Any consistent units.
struct ElasticBar {
  double length = 0.0;    ///< L
  double modulus = 0.0;   ///< stress per axial strain: E, or E (1 - nu) / ((1 + nu) (1 - 2 nu)) when blocked laterally
  double density = 0.0;   ///< rho
  double area = 0.0;      ///< A of the section
  double velocity = 0.0;  ///< of all points at t = 0

  double wave_speed() const;                                          ///< c = sqrt(modulus / rho)
  double round_trip() const { return 2.0 * length / wave_speed(); }   ///< T = 2 L / c
  double impedance() const { return density * wave_speed() * area; }  ///< Z = rho c A, force per velocity
  double mass() const { return density * area * length; }
  /// Throws std::invalid_argument that begins with whose when a number is not positive (the velocity: not finite).
  void check(std::string_view whose) const;
};

/// At the distance z from the contact face, with delay = z / c and f the wave of solve_face_contact,
///   v = a t + f(t - delay) + f(t + delay - T),  strain = (f(t + delay - T) - f(t - delay)) / c dz/dx,
/// x the axis along which velocities count positive. At a front the value is the one after it for the wave that moves
/// away from the face. Means and energies are integrated exactly, panel by panel between the fronts, where velocity and
/// stress are linear in z and the displacement is quadratic.
class BarMotion {
 public:
  /// acceleration: a, by a uniform field. wave: f for all times that will be asked for.
  BarMotion(const ElasticBar& bar, double acceleration, PiecewiseLinear wave);

  const ElasticBar& bar() const { return bar_; }

  double velocity(double z, double t) const;
  /// Zero at t = 0.
  double displacement(double z, double t) const;
  /// modulus x strain as if z grew along x; of the opposite sign for a bar that lies on the other side of its face.
  double stress(double z, double t) const;
  double mean_velocity(double t) const;      ///< of the centre of mass
  double mean_displacement(double t) const;  ///< of the centre of mass
  double kinetic_energy(double t) const;
  double strain_energy(double t) const;

 private:
  template <class Function>
  double integrate_along(double t, const Function& quantity) const;

  ElasticBar bar_;
  double wave_speed_, round_trip_, acceleration_;
  PiecewiseLinear wave_;
};

}  // namespace carom
