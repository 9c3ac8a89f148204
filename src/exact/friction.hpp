// Rigid bodies with Coulomb friction: an oscillator, and a block that slides on a level or inclined plane.
#pragma once

#include <vector>

namespace carom {

/// Any consistent units.
struct FrictionOscillatorData {
  double mass = 0.0;       ///< m
  double stiffness = 0.0;  ///< k, force per length
  double friction = 0.0;   ///< largest friction force R = mu N > 0, sticking and sliding
  double start = 0.0;      ///< x_0, released at rest; the spring is free of force at 0
};

/// Between turning points the mass swings about s_n R / k with the frequency of the free oscillator,
///   x = s_n R / k + (x_n - s_n R / k) cos(omega t - n pi),  s_n = sign(x_n),  x_(n+1) = 2 s_n R / k - x_n,
/// and it sticks for ever at the first x_n with k |x_n| <= R, to 1e-12 (Den Hartog, Mechanical Vibrations, 4th ed.,
/// section 8.1).
class FrictionOscillator {
 public:
  /// Throws std::invalid_argument when mass, stiffness or friction is not positive, or start is not finite.
  explicit FrictionOscillator(const FrictionOscillatorData& data);

  double position(double t) const;
  double velocity(double t) const;
  /// On the mass; while it sticks the force that holds the spring.
  double friction_force(double t) const;
  /// Heat from 0 to t, >= 0.
  double dissipated(double t) const;

  /// x_1, x_2, ...; the last one is where the mass sticks. Empty when it never moves.
  const std::vector<double>& turning_points() const { return turns_; }
  /// pi / omega, from one turning point to the next.
  double half_period() const { return half_period_; }
  double sticking_time() const { return half_period_ * static_cast<double>(turns_.size()); }
  double sticking_position() const { return turns_.empty() ? data_.start : turns_.back(); }

 private:
  struct Swing {
    double from = 0.0, centre = 0.0, angle = 0.0;
  };
  Swing swing(double t) const;

  FrictionOscillatorData data_;
  double half_period_;
  std::vector<double> turns_;
};

/// Any consistent units. Down the slope is positive.
struct SlidingBlockData {
  double mass = 0.0;
  double mu = 0.0;       ///< >= 0, sticking and sliding
  double gravity = 0.0;  ///< g
  double angle = 0.0;    ///< alpha of the plane in radians, [0, pi / 2); 0 is level
  double speed = 0.0;    ///< at t = 0, of either sign
};

/// A block that slides has the acceleration g (sin(alpha) - sign(v) mu cos(alpha)); one at rest stays there if
/// tan(alpha) <= mu, else it slides down with the acceleration g (sin(alpha) - mu cos(alpha)) (Coulomb's law).
class SlidingBlock {
 public:
  /// Throws std::invalid_argument when mass or gravity is not positive, mu is negative, or angle is out of range.
  explicit SlidingBlock(const SlidingBlockData& data);

  /// Distance from the start, down the slope.
  double position(double t) const;
  double velocity(double t) const;
  /// On the block, along the slope; what holds it while it rests.
  double friction_force(double t) const;
  /// Heat from 0 to t, >= 0.
  double dissipated(double t) const;

  /// First time at which the velocity is zero: 0 for a block that starts at rest, infinity if it never comes to that.
  double stop_time() const { return stop_time_; }
  /// Position at stop_time(); infinity if there is none.
  double stop_position() const;
  /// True if a block at rest stays there: tan(alpha) <= mu.
  bool holds() const { return acceleration_after_ == 0.0; }

 private:
  SlidingBlockData data_;
  double acceleration_, stop_time_, acceleration_after_;
};

}  // namespace carom
