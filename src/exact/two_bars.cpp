#include "exact/two_bars.hpp"

#include <algorithm>

#include "exact/arguments.hpp"

namespace carom {

namespace {

BarFace face_of(const ElasticBar& bar) {
  return {.impedance = bar.impedance(), .round_trip = bar.round_trip(), .velocity = bar.velocity};
}

FaceContact solve(const TwoBarsData& data, double until) {
  data.left.check("left bar");
  data.right.check("right bar");
  require_not_negative("two bars", {{"gap", data.gap}});
  require_positive("two bars", {{"until", until}});
  return solve_face_contact(face_of(data.left), face_of(data.right), data.gap, until);
}

/// How far the face of a bar in free flight leads its mean motion from time t on, and lags behind it.
struct Ringing {
  double ahead = 0.0, behind = 0.0;
};

Ringing ringing_after(double t, const BarMotion& motion, const PiecewiseLinear& wave) {
  const double mean = motion.mean_velocity(t), period = motion.bar().round_trip();
  std::vector<double> times = wave.breaks(t - period, t);
  times.push_back(t);
  Ringing ringing;
  for (const double s : times) {
    // The face moves at 2 f(t' - T); straight lines between fronts have their extremes at fronts.
    const double lead = 2.0 * (wave.integral(s) - wave.integral(t - period)) - mean * (s - t + period);
    ringing.ahead = std::max(ringing.ahead, lead);
    ringing.behind = std::max(ringing.behind, -lead);
  }
  return ringing;
}

}  // namespace

TwoBars::TwoBars(const TwoBarsData& data, double until)
    : gap_(data.gap),
      until_(until),
      contact_(solve(data, until)),
      bars_{BarMotion(data.left, 0.0, contact_.waves[0]), BarMotion(data.right, 0.0, contact_.waves[1])} {}

double TwoBars::gap(double t) const {
  return gap_ + displacement(1, 0.0, t) - displacement(0, 0.0, t);
}

bool TwoBars::apart_for_good() const {
  if (!contact_.phases.empty() && contact_.phases.back().end >= until_) return false;
  const Ringing left = ringing_after(until_, bars_[0], contact_.waves[0]);
  const Ringing right = ringing_after(until_, bars_[1], contact_.waves[1]);
  return mean_velocity(1, until_) >= mean_velocity(0, until_) && gap(until_) > left.ahead + right.behind;
}

}  // namespace carom
