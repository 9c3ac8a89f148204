#include "exact/hertz.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "exact/arguments.hpp"
#include "exact/solution.hpp"

namespace carom {

namespace {

constexpr double pi = std::numbers::pi;

/// Coefficients of (sin x / x)^(-1/5) in powers of x^2, by the recurrence for a power of a series (Henrici, Applied and
/// Computational Complex Analysis, vol. 1, section 1.6). They fall like pi^(-2 k), so that 32 suffice up to pi / 2.
std::array<double, 32> series_of_power() {
  std::array<double, 32> sine{1.0}, power{1.0};
  for (std::size_t k = 1; k < sine.size(); ++k) {
    const double n = static_cast<double>(k);
    sine[k] = -sine[k - 1] / (2.0 * n * (2.0 * n + 1.0));
    double sum = 0.0;
    for (std::size_t j = 1; j <= k; ++j) sum += (0.8 * static_cast<double>(j) - n) * sine[j] * power[k - j];
    power[k] = sum / n;
  }
  return power;
}

/// 4/5 integral of sin^(-1/5) from 0 to psi^(5/4), 0 <= psi^(5/4) <= pi / 2; smooth in psi.
double scaled_time(double psi) {
  static const std::array<double, 32> coefficients = series_of_power();
  const double theta = std::pow(psi, 1.25);
  double sum = 0.0, power = psi;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    sum += coefficients[k] * power * 0.8 / (2.0 * static_cast<double>(k) + 0.8);
    power *= theta * theta;
  }
  return sum;
}

const double full_psi = std::pow(0.5 * pi, 0.8);

}  // namespace

double hertz_modulus(double modulus_1, double nu_1, double modulus_2, double nu_2) {
  double compliance = 0.0;
  for (const auto& [modulus, nu] : {std::pair(modulus_1, nu_1), std::pair(modulus_2, nu_2)}) {
    if (!(modulus > 0.0)) throw std::invalid_argument("Hertz: a modulus is not positive");
    if (!(nu > -1.0 && nu <= 0.5)) throw std::invalid_argument("Hertz: Poisson's ratio is outside (-1, 0.5]");
    compliance += (1.0 - nu * nu) / modulus;
  }
  if (compliance == 0.0) throw std::invalid_argument("Hertz: both bodies are rigid");
  return 1.0 / compliance;
}

double hertz_combination(double a, double b) {
  if (!(a > 0.0 && b > 0.0)) throw std::invalid_argument("Hertz: a radius or mass is not positive");
  if (std::isinf(a) && std::isinf(b)) throw std::invalid_argument("Hertz: both radii or masses are infinite");
  return 1.0 / (1.0 / a + 1.0 / b);
}

HertzSphere::HertzSphere(double radius, double modulus) : radius_(radius), modulus_(modulus) {
  require_positive("Hertz contact", {{"radius", radius}, {"modulus", modulus}});
}

double HertzSphere::force(double approach) const {
  return 4.0 / 3.0 * modulus_ * std::sqrt(radius_ * approach) * approach;
}

double HertzSphere::approach(double force) const {
  const double a = contact_radius(force);
  return a * a / radius_;
}

double HertzSphere::contact_radius(double force) const {
  return std::cbrt(0.75 * force * radius_ / modulus_);
}

double HertzSphere::peak_pressure(double force) const {
  return std::cbrt(6.0 * force * modulus_ * modulus_ / (radius_ * radius_)) / pi;
}

double HertzSphere::pressure(double force, double r) const {
  const double ratio = r / contact_radius(force);
  return ratio < 1.0 ? peak_pressure(force) * std::sqrt(1.0 - ratio * ratio) : 0.0;
}

double HertzSphere::energy(double approach) const {
  return 0.4 * force(approach) * approach;
}

HertzCylinder::HertzCylinder(double radius, double modulus) : radius_(radius), modulus_(modulus) {
  require_positive("Hertz contact", {{"radius", radius}, {"modulus", modulus}});
}

double HertzCylinder::half_width(double force) const {
  return std::sqrt(4.0 * force * radius_ / (pi * modulus_));
}

double HertzCylinder::peak_pressure(double force) const {
  return std::sqrt(force * modulus_ / (pi * radius_));
}

double HertzCylinder::pressure(double force, double x) const {
  const double ratio = std::abs(x) / half_width(force);
  return ratio < 1.0 ? peak_pressure(force) * std::sqrt(1.0 - ratio * ratio) : 0.0;
}

HertzImpact::HertzImpact(double mass, double radius, double modulus, double speed)
    : sphere_(radius, modulus),
      speed_(speed),
      peak_approach_(std::pow(15.0 * mass * speed * speed / (16.0 * std::sqrt(radius) * modulus), 0.4)) {
  require_positive("Hertz impact", {{"mass", mass}, {"speed", speed}});
}

double HertzImpact::contact_time() const {
  return 2.0 * scaled_time(full_psi) * peak_approach_ / speed_;
}

/// theta, for 0 <= t <= contact_time; the second half mirrors the first.
double HertzImpact::phase(double t) const {
  const double half = 0.5 * contact_time();
  if (t > half) return pi - phase(2.0 * half - t);
  // scaled_time is increasing and convex: Newton's method from the upper end comes down to the root.
  const double target = t * speed_ / peak_approach_;
  double psi = full_psi;
  for (int i = 0; i < 50; ++i) {
    const double theta = std::pow(psi, 1.25);
    const double slope = theta > 0.0 ? std::pow(theta / std::sin(theta), 0.2) : 1.0;
    const double correction = (scaled_time(psi) - target) / slope;
    psi = std::max(0.0, psi - correction);
    if (std::abs(correction) <= 4.0 * std::numeric_limits<double>::epsilon()) break;
  }
  return std::pow(psi, 1.25);
}

double HertzImpact::approach(double t) const {
  if (t <= 0.0 || t >= contact_time()) return 0.0;
  return peak_approach_ * std::pow(std::sin(phase(t)), 0.8);
}

double HertzImpact::speed(double t) const {
  if (t <= 0.0) return speed_;
  return t >= contact_time() ? -speed_ : speed_ * std::cos(phase(t));
}

ExactSolution sphere_on_rigid_wall_row() {
  ExactSolution row{.name = "sphere_on_rigid_wall", .summary = "an elastic sphere against a rigid wall, by Hertz"};
  row.parameters = {positive("modulus", "Young's modulus.", Dimension::stress),
                    {.key = "poisson",
                     .meaning = "Poisson's ratio of the sphere.",
                     .range = {.low = -1.0, .high = 0.5},
                     .initial = 0.0},
                    positive("mass", "Mass of the body.", Dimension::mass),
                    positive("radius", "Radius of the sphere.", Dimension::length),
                    {.key = "speed", .meaning = "Speed towards the wall.", .unit = Dimension::velocity},
                    gap_parameter()};
  row.motion = [](const ExactValues& values, const ExactCase&) {
    const double poisson = values.at("poisson"), modulus = values.at("modulus") / (1.0 - poisson * poisson);
    const double speed = values.at("speed"), touch = values.at("gap") / speed;
    const auto impact = std::make_shared<const HertzImpact>(values.at("mass"), values.at("radius"), modulus, speed);
    ExactMotion motion;
    motion.force = [impact, touch](double t) { return t < touch ? 0.0 : impact->force(t - touch); };
    return motion;
  };
  return row;
}

}  // namespace carom
