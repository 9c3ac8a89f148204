// An elastic bar flies against a wall: exact solution in one dimension.
#pragma once

#include <vector>

#include "exact/wall_traction.hpp"

namespace carom {

/// Any consistent units. The axis z runs along the bar and away from the wall: z = 0 is the face that hits, z = L the
/// free end. All material points start at displacement 0 and velocity -speed.
struct BarImpactData {
  double length = 0.0;     ///< L
  double modulus = 0.0;    ///< stress per axial strain: E, or E (1 - nu) / ((1 + nu) (1 - 2 nu)) when blocked laterally
  double density = 0.0;    ///< rho
  double area = 0.0;       ///< of the section
  double speed = 0.0;      ///< v0 > 0, towards the wall
  double gap = 0.0;        ///< from the face to the wall at t = 0
  double stiffness = 0.0;  ///< eps_N: traction = eps_N x penetration; 0 or infinity: rigid wall
  double wall_mass = 0.0;  ///< of a rigid wall that is free and at rest before the impact; 0: it is held
};

/// Solution by characteristics for any t >= 0: flight, contact, release and the waves that keep running in the bar
/// after it. With T = 2 L / c, the wave away from the wall is f(s) = -v0/2 + v0 sum over k >= 0 of q(s - tau0 - k T), q
/// from WallTraction, and the wave towards it f(s - T) by reflection at the free end:
///   v(z, t) = f(t - z/c) + f(t + z/c - T),  stress = rho c (f(t + z/c - T) - f(t - z/c)).
/// Displacement, velocity, stress and force are closed forms; kinetic and strain energy are integrated along the bar
/// by 16-point Gauss rules on panels between the fronts (relative error below 1e-12). At a jump (rigid wall) the value
/// is the one after it.
class BarImpact {
 public:
  /// Throws std::invalid_argument naming the quantity when length, modulus, density, area or speed is not positive,
  /// gap or stiffness is negative, the wall is too soft (see WallTraction), or the face would touch the wall again;
  /// nor may a wall have both a stiffness and a mass.
  explicit BarImpact(const BarImpactData& data);

  double displacement(double z, double t) const;
  double velocity(double z, double t) const;
  /// Axial stress, tension positive.
  double stress(double z, double t) const;
  /// Resultant of the wall on the bar, >= 0.
  double contact_force(double t) const;
  double kinetic_energy(double t) const;
  double strain_energy(double t) const;
  /// Energy stored in the penalty wall; 0 for the rigid one.
  double contact_energy(double t) const;
  /// Velocity of the wall along z: -speed (1 - exp(-s Z / wall_mass)), Z = rho c A, s the time since the touch, until
  /// the release; 0 for a wall that is held.
  double wall_velocity(double t) const;

  /// c = sqrt(modulus / rho)
  double wave_speed() const { return wave_speed_; }
  double touch_time() const { return touch_time_; }
  double release_time() const { return touch_time_ + traction_.duration(); }
  /// Velocity of the centre of mass after the release.
  double rebound_speed() const;

 private:
  double wave(double s) const;
  double wave_integral(double s) const;
  void refuse_second_contact() const;
  std::vector<double> fronts(double t) const;
  template <class Function>
  double integrate_along(double t, const Function& density) const;

  BarImpactData data_;
  double wave_speed_, impedance_, touch_time_, round_trip_;
  double contact_time_;  ///< of the transients behind the fronts: t_c, or wall_mass / Z; 0: there are none
  WallTraction traction_;
};

}  // namespace carom
