#include "exact/bouncing_bar.hpp"

#include "base/types.hpp"
#include "exact/arguments.hpp"

namespace carom {

namespace {

FaceContact solve(const BouncingBarData& data, double until) {
  data.bar.check("bouncing bar");
  require_not_negative("bouncing bar", {{"gravity", data.gravity}, {"gap", data.gap}});
  require_positive("bouncing bar", {{"until", until}});
  const BarFace floor{.impedance = infinity, .round_trip = infinity};
  const BarFace face{.impedance = data.bar.impedance(),
                     .round_trip = data.bar.round_trip(),
                     .velocity = data.bar.velocity,
                     .acceleration = -data.gravity};
  return solve_face_contact(floor, face, data.gap, until);
}

}  // namespace

BouncingBar::BouncingBar(const BouncingBarData& data, double until)
    : gravity_(data.gravity),
      gap_(data.gap),
      contact_(solve(data, until)),
      motion_(data.bar, -data.gravity, contact_.waves[1]) {}

double BouncingBar::potential_energy(double t) const {
  return motion_.bar().mass() * gravity_ * (gap_ + motion_.mean_displacement(t));
}

}  // namespace carom
