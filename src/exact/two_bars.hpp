// Two elastic bars in line collide: exact solution in one dimension.
#pragma once

#include <array>
#include <vector>

#include "exact/bar_motion.hpp"
#include "exact/face_contact.hpp"

namespace carom {

/// Any consistent units. Velocities count from the left bar towards the right one.
struct TwoBarsData {
  ElasticBar left, right;
  double gap = 0.0;  ///< between the contact faces at t = 0
};

/// The bars by solve_face_contact and BarMotion, for 0 <= t <= until; any lengths and impedances, any number of
/// contacts, grazing phases included (convention: see solve_face_contact). bar is 0 for the left, 1 for the right one;
/// z is the distance from the contact face of that bar, 0 <= z <= L. Everything is closed form, to rounding. To ask for
/// t > until is a bug.
class TwoBars {
 public:
  /// Throws std::invalid_argument naming the quantity when a length, modulus, density or area is not positive, a
  /// velocity not finite, the gap negative, or until not positive.
  TwoBars(const TwoBarsData& data, double until);

  /// Compressive, >= 0; after a jump.
  double force(double t) const { return contact_.force.value(t); }
  double velocity(int bar, double z, double t) const { return motion(bar).velocity(z, t); }
  double displacement(int bar, double z, double t) const { return motion(bar).displacement(z, t); }
  /// Tension positive.
  double stress(int bar, double z, double t) const { return (bar == 0 ? -1.0 : 1.0) * motion(bar).stress(z, t); }
  /// Of the centre of mass.
  double mean_velocity(int bar, double t) const { return motion(bar).mean_velocity(t); }
  double kinetic_energy(int bar, double t) const { return motion(bar).kinetic_energy(t); }
  double strain_energy(int bar, double t) const { return motion(bar).strain_energy(t); }
  /// Zero exactly or to rounding in contact.
  double gap(double t) const;

  const std::vector<ContactPhase>& phases() const { return contact_.phases; }
  /// Times at which a gap opens.
  const std::vector<double>& release_times() const { return contact_.releases; }
  /// True if the bars, left to ring, never touch after until: mean_velocity(bar, until) is then final.
  bool apart_for_good() const;

 private:
  const BarMotion& motion(int bar) const { return bars_[static_cast<std::size_t>(bar)]; }

  double gap_, until_;
  FaceContact contact_;
  std::array<BarMotion, 2> bars_;
};

}  // namespace carom
