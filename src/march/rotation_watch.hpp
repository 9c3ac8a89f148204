// The rotation of small-strain parts, which small strain takes for strain.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"
#include "march/observer.hpp"
#include "solid/rotation.hpp"

namespace carom {

/// Looks every step of an implicit stage. Looking costs about as much as an explicit step: those are looked at every
/// ten steps, and every step while the largest angle, at twice the rate at which it has grown, might reach a limit
/// before the next look.
class RotationWatch : public Observer {
 public:
  explicit RotationWatch(const Simulation& simulation);

  /// Throws RunError when a cell has turned by more than guards.rotation_stop.
  void see(const StepView& view) override;
  /// One, once a cell has turned by more than guards.rotation_warning, with the stress that its rotation alone makes.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  template <class A>
  friend void fields(A& archive, RotationWatch& x) {
    archive("angle", x.angle_);
    archive("growth", x.growth_);
    archive("looked", x.looked_);
    archive("next", x.next_);
    archive("warnings", x.warnings_);
  }

  const Part& turned_part(const Rotation& rotation) const;
  std::string describe(const Rotation& rotation) const;

  const Simulation& simulation_;
  double angle_ = 0.0, growth_ = 0.0;  ///< degrees at the last look, and per step before it
  long long looked_ = 0, next_ = 1;    ///< steps
  std::vector<std::string> warnings_;
};

/// Stress of a cell of small strain that only turns, by an angle in radian: its strain is cos(angle) - 1 along the two
/// directions across the axis of rotation, so that sigma = E (1 - cos) / ((1 + nu)(1 - 2 nu)); plane stress
/// E (1 - cos) / (1 - nu), bars E (1 - cos).
double stress_of_rotation(const IsotropicElastic& material, Section section, double angle);

}  // namespace carom
