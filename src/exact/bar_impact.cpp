#include "exact/bar_impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "exact/arguments.hpp"
#include "math/gauss_legendre.hpp"

namespace carom {

namespace {

/// Transients after a front decay like exp(-x), x in units of t_c: gone in double precision after this many.
constexpr double transient_length = 48.0;
/// Panels inside a transient, in units of t_c.
constexpr double panel_length = 4.0;

BarImpactData checked(const BarImpactData& data) {
  require_positive("bar impact", {{"length", data.length},
                                  {"modulus", data.modulus},
                                  {"density", data.density},
                                  {"area", data.area},
                                  {"speed", data.speed}});
  require_not_negative("bar impact", {{"gap", data.gap}});
  require_not_negative("bar impact", {{"wall mass", data.wall_mass}});
  if (data.stiffness > 0.0 && data.wall_mass > 0.0)
    throw std::invalid_argument(fmt::format(
        "bar impact: a wall of stiffness {:g} and mass {:g}, expected one of the two", data.stiffness, data.wall_mass));
  if (!(data.stiffness >= 0.0))
    throw std::invalid_argument(
        fmt::format("bar impact: stiffness is {:g}, expected zero (rigid wall) or a positive number", data.stiffness));
  return data;
}

/// t_c; m / Z of a free wall; 0 for the rigid wall.
double contact_time_of(const BarImpactData& data, double impedance) {
  if (data.wall_mass > 0.0) return data.wall_mass / (impedance * data.area);
  return data.stiffness == 0.0 || std::isinf(data.stiffness) ? 0.0 : impedance / data.stiffness;
}

WallTraction traction_of(const BarImpactData& data, double round_trip, double contact_time) {
  if (data.wall_mass > 0.0) return WallTraction::free_mass(round_trip, contact_time);
  return {round_trip, contact_time};
}

}  // namespace

BarImpact::BarImpact(const BarImpactData& data)
    : data_(checked(data)),
      wave_speed_(std::sqrt(data.modulus / data.density)),
      impedance_(data.density * wave_speed_),
      touch_time_(data.gap / data.speed),
      round_trip_(2.0 * data.length / wave_speed_),
      contact_time_(contact_time_of(data, impedance_)),
      traction_(traction_of(data, round_trip_, contact_time_)) {
  refuse_second_contact();
}

/// f(s)
double BarImpact::wave(double s) const {
  const double since_touch = s - touch_time_;
  double sum = -0.5;
  const double first = std::max(0.0, std::floor((since_touch - traction_.duration()) / round_trip_));
  for (double k = first; k * round_trip_ <= since_touch; ++k) sum += traction_.value(since_touch - k * round_trip_);
  return data_.speed * sum;
}

/// Integral of f from 0 to s
double BarImpact::wave_integral(double s) const {
  const double since_touch = s - touch_time_;
  const double complete = std::max(0.0, std::floor((since_touch - traction_.duration()) / round_trip_));
  double sum = -0.5 * s + complete * traction_.integral(traction_.duration());
  for (double k = complete; k * round_trip_ <= since_touch; ++k)
    sum += traction_.integral(since_touch - k * round_trip_);
  return data_.speed * sum;
}

double BarImpact::displacement(double z, double t) const {
  const double delay = z / wave_speed_;
  return wave_integral(t - delay) + wave_integral(t + delay - round_trip_) - 0.5 * data_.speed * round_trip_;
}

double BarImpact::velocity(double z, double t) const {
  const double delay = z / wave_speed_;
  return wave(t - delay) + wave(t + delay - round_trip_);
}

double BarImpact::stress(double z, double t) const {
  const double delay = z / wave_speed_;
  return impedance_ * (wave(t + delay - round_trip_) - wave(t - delay));
}

double BarImpact::contact_force(double t) const {
  return data_.area * impedance_ * data_.speed * traction_.value(t - touch_time_);
}

double BarImpact::contact_energy(double t) const {
  if (contact_time_ == 0.0 || data_.wall_mass > 0.0) return 0.0;
  const double force = contact_force(t);
  return 0.5 * force * force / (data_.stiffness * data_.area);
}

double BarImpact::wall_velocity(double t) const {
  if (data_.wall_mass == 0.0) return 0.0;
  return -data_.speed / contact_time_ * traction_.integral(t - touch_time_);
}

double BarImpact::rebound_speed() const {
  return data_.speed * (2.0 * traction_.integral(traction_.duration()) / round_trip_ - 1.0);
}

/// After the release the face moves away by rebound_speed T in every period T, so one period shows all.
/// A free wall moves away faster than the face at all times: -speed (1 - e(T)) against -speed (1 - 2 e(s)) with
/// e(s) = exp(-s Z / m) >= e(T).
void BarImpact::refuse_second_contact() const {
  if (data_.wall_mass > 0.0) return;
  constexpr int samples = 512;
  const double rounding = 1e-12 * (data_.gap + data_.speed * (round_trip_ + traction_.duration()));
  for (int i = 0; i <= samples; ++i)
    if (displacement(0.0, release_time() + round_trip_ * i / samples) < -data_.gap - rounding)
      throw std::invalid_argument(
          "bar impact: with this wall stiffness the face touches the wall again after its release, which this solution "
          "does not cover");
}

/// Positions z/c in [0, L/c], increasing, between which both waves are smooth at time t.
std::vector<double> BarImpact::fronts(double t) const {
  const double half = 0.5 * round_trip_;
  std::vector<double> places{0.0, half};
  const auto add = [&](double s) {
    places.push_back(std::clamp(t - s, 0.0, half));
    places.push_back(std::clamp(s - t + round_trip_, 0.0, half));
  };
  const double transient = std::min(round_trip_, transient_length * contact_time_);
  for (const double begin : {touch_time_, release_time()}) {
    // The last two periods before t: a transient that begins in the first may reach into the second.
    const double first = std::max(0.0, std::floor((t - begin) / round_trip_) - 1.0);
    for (double k = first; begin + k * round_trip_ <= t; ++k) {
      const double front = begin + k * round_trip_;
      add(front);
      for (double x = panel_length * contact_time_; x > 0.0 && x <= transient; x += panel_length * contact_time_)
        add(front + x);
    }
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// Integral of density(f(t - z/c), f(t + z/c - T)) over the bar.
template <class Function>
double BarImpact::integrate_along(double t, const Function& density) const {
  const std::vector<double> places = fronts(t);
  const std::vector<QuadraturePoint> rule = gauss_legendre(16);
  double sum = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double half_width = 0.5 * (places[i] - places[i - 1]);
    if (half_width == 0.0) continue;
    const double centre = 0.5 * (places[i] + places[i - 1]);
    for (const QuadraturePoint& point : rule) {
      const double delay = centre + half_width * point.x;
      sum += half_width * point.weight * density(wave(t - delay), wave(t + delay - round_trip_));
    }
  }
  return wave_speed_ * sum;
}

double BarImpact::kinetic_energy(double t) const {
  return 0.5 * data_.density * data_.area *
         integrate_along(t, [](double away, double towards) { return (away + towards) * (away + towards); });
}

double BarImpact::strain_energy(double t) const {
  return 0.5 * data_.density * data_.area *
         integrate_along(t, [](double away, double towards) { return (towards - away) * (towards - away); });
}

}  // namespace carom
