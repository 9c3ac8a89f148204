// An elastic bar falls on a rigid floor and bounces: exact solution in one dimension.
#pragma once

#include <vector>

#include "exact/bar_motion.hpp"
#include "exact/face_contact.hpp"

namespace carom {

/// Any consistent units. The axis z points up: z = 0 is the lower face of the bar, z = L its free end.
struct BouncingBarData {
  ElasticBar bar;        ///< its velocity at t = 0, upwards positive
  double gravity = 0.0;  ///< g >= 0, downwards
  double gap = 0.0;      ///< from the lower face to the floor at t = 0; the bar is undeformed then
};

/// The bar by solve_face_contact and BarMotion, for 0 <= t <= until and any data: in free fall the wave repeats itself
/// with period T = 2 L / c, in contact f(t) = g t - f(t - T) and the force is
///   F = Z (g t - 2 f(t - T)),  Z = rho c A,
/// until it vanishes. Dropped at rest from gap = g (m T)^2 / 8, m >= 3 whole, so that it falls for m T / 2, the bar is
/// in contact for T and in flight for m T by turns, and the motion has the period 2 (m + 1) T; other data need not give
/// a periodic one. Everything is closed form, to rounding. To ask for t > until is a bug.
class BouncingBar {
 public:
  /// Throws std::invalid_argument naming the quantity when length, modulus, density, area or until is not positive, or
  /// gravity or gap negative.
  BouncingBar(const BouncingBarData& data, double until);

  /// From the place at t = 0; add the gap for the height over the place when standing undeformed on the floor.
  double displacement(double z, double t) const { return motion_.displacement(z, t); }
  double velocity(double z, double t) const { return motion_.velocity(z, t); }
  /// Tension positive.
  double stress(double z, double t) const { return motion_.stress(z, t); }
  /// Of the floor on the bar, >= 0; after a jump.
  double contact_force(double t) const { return contact_.force.value(t); }
  double mean_velocity(double t) const { return motion_.mean_velocity(t); }
  double kinetic_energy(double t) const { return motion_.kinetic_energy(t); }
  double strain_energy(double t) const { return motion_.strain_energy(t); }
  /// m g x height of the centre of mass over its place when standing undeformed on the floor.
  double potential_energy(double t) const;

  const std::vector<ContactPhase>& phases() const { return contact_.phases; }
  /// Times at which the bar leaves the floor.
  const std::vector<double>& release_times() const { return contact_.releases; }

 private:
  double gravity_, gap_;
  FaceContact contact_;
  BarMotion motion_;
};

}  // namespace carom
