#include "exact/bar_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/arguments.hpp"
#include "math/gauss_legendre.hpp"

namespace carom {

double ElasticBar::wave_speed() const {
  return std::sqrt(modulus / density);
}

void ElasticBar::check(std::string_view whose) const {
  require_positive(whose, {{"length", length}, {"modulus", modulus}, {"density", density}, {"area", area}});
  if (!std::isfinite(velocity)) throw std::invalid_argument(fmt::format("{}: velocity is {:g}", whose, velocity));
}

BarMotion::BarMotion(const ElasticBar& bar, double acceleration, PiecewiseLinear wave)
    : bar_(bar),
      wave_speed_(bar.wave_speed()),
      round_trip_(bar.round_trip()),
      acceleration_(acceleration),
      wave_(std::move(wave)) {}

double BarMotion::velocity(double z, double t) const {
  const double delay = z / wave_speed_;
  return acceleration_ * t + wave_.value(t - delay) + wave_.value(t + delay - round_trip_);
}

double BarMotion::displacement(double z, double t) const {
  const double delay = z / wave_speed_;
  return 0.5 * acceleration_ * t * t + wave_.integral(t - delay) - wave_.integral(-delay) +
         wave_.integral(t + delay - round_trip_) - wave_.integral(delay - round_trip_);
}

double BarMotion::stress(double z, double t) const {
  const double delay = z / wave_speed_;
  return bar_.density * wave_speed_ * (wave_.value(t + delay - round_trip_) - wave_.value(t - delay));
}

double BarMotion::mean_velocity(double t) const {
  return acceleration_ * t + 2.0 / round_trip_ * (wave_.integral(t) - wave_.integral(t - round_trip_));
}

template <class Function>
double BarMotion::integrate_along(double t, const Function& quantity) const {
  const double half = 0.5 * round_trip_;
  std::vector<double> delays{0.0, half};
  for (const double s : wave_.breaks(t - half, t)) delays.push_back(t - s);
  for (const double s : wave_.breaks(t - round_trip_, t - half)) delays.push_back(s + round_trip_ - t);
  std::sort(delays.begin(), delays.end());
  static const std::vector<QuadraturePoint> rule = gauss_legendre(2);
  double sum = 0.0;
  for (std::size_t i = 1; i < delays.size(); ++i) {
    const double half_width = 0.5 * (delays[i] - delays[i - 1]), centre = 0.5 * (delays[i] + delays[i - 1]);
    for (const QuadraturePoint& point : rule)
      sum += half_width * point.weight * quantity(wave_speed_ * (centre + half_width * point.x));
  }
  return wave_speed_ * sum;
}

double BarMotion::mean_displacement(double t) const {
  return integrate_along(t, [&](double z) { return displacement(z, t); }) / bar_.length;
}

double BarMotion::kinetic_energy(double t) const {
  const auto squared = [&](double z) { return velocity(z, t) * velocity(z, t); };
  return 0.5 * bar_.density * bar_.area * integrate_along(t, squared);
}

double BarMotion::strain_energy(double t) const {
  const auto squared = [&](double z) { return stress(z, t) * stress(z, t); };
  return 0.5 * bar_.area / bar_.modulus * integrate_along(t, squared);
}

}  // namespace carom
