#include "exact/two_bars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "exact/arguments.hpp"
#include "exact/solution.hpp"

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

ExactSolution two_bars_row() {
  ExactSolution row{.name = "two_bars",
                    .summary = "two elastic bars in line collide, the first part being that on the negative side",
                    .parameters = bar_parameters()};
  row.parameters.push_back(
      {.key = "speed", .meaning = "Of the first bar, along the axis.", .unit = Dimension::velocity});
  row.parameters.push_back(gap_parameter());
  row.bodies = {{"second",
                 "the bar on the positive side of the axis.",
                 {positive("length", "Length.", Dimension::length),
                  positive("area", "Section.", Dimension::area),
                  positive("modulus", "Stress per axial strain.", Dimension::stress),
                  positive("density", "Density.", Dimension::density),
                  {.key = "speed",
                   .meaning = "Velocity along the axis at the start.",
                   .unit = Dimension::velocity,
                   .initial = 0.0}}}};
  row.motion = [](const ExactValues& values, const ExactCase& given) {
    if (given.parts != 2) throw std::invalid_argument(fmt::format("{} parts", given.parts));
    const TwoBarsData data{bar_of(values), bar_of(values, "second"), values.at("gap")};
    const auto bars = std::make_shared<const TwoBars>(data, given.until);
    ExactMotion motion;
    motion.at = [bars, data, face = given.lowest + data.left.length](const ExactPlace& place) {
      const int bar = place.part;
      const double length = bar == 0 ? data.left.length : data.right.length;
      const double z = std::clamp(bar == 0 ? face - place.x : place.x - face - data.gap, 0.0, length);
      return ExactPoint{[bars, bar, z](double t) { return bars->displacement(bar, z, t); },
                        [bars, bar, z](double t) { return bars->velocity(bar, z, t); },
                        [bars, bar, z](double t) { return bars->stress(bar, z, t); }};
    };
    const double sign = given.pressed_part == 0 ? -1.0 : 1.0;
    motion.force = [bars, sign](double t) { return sign * bars->force(t); };
    motion.energies = {
        {"kinetic", [bars](double t) { return bars->kinetic_energy(0, t) + bars->kinetic_energy(1, t); }},
        {"strain", [bars](double t) { return bars->strain_energy(0, t) + bars->strain_energy(1, t); }}};
    return motion;
  };
  return row;
}

}  // namespace carom
