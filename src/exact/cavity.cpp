#include "exact/cavity.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "exact/arguments.hpp"

namespace carom {

SphericalCavity::SphericalCavity(const SphericalCavityData& data) : data_(data) {
  require_positive("spherical cavity", {{"radius", data.radius}, {"modulus", data.modulus}, {"density", data.density}});
  if (!(data.nu > -1.0 && data.nu < 0.5)) throw std::invalid_argument("spherical cavity: nu is outside (-1, 0.5)");
  if (!std::isfinite(data.pressure)) throw std::invalid_argument("spherical cavity: pressure is not finite");
  G_ = 0.5 * data.modulus / (1.0 + data.nu);
  lambda_ = 2.0 * G_ * data.nu / (1.0 - 2.0 * data.nu);
  c_ = std::sqrt((lambda_ + 2.0 * G_) / data.density);
  alpha_ = 2.0 * G_ / (data.density * data.radius * c_);
  omega_ = std::sqrt(4.0 * G_ / (data.density * data.radius * data.radius) - alpha_ * alpha_);
}

SphericalCavity::Potential SphericalCavity::potential(double r, double t) const {
  const double tau = t - (r - data_.radius) / c_;
  if (tau < 0.0) return {};
  const double a = data_.radius, force = data_.pressure * a / data_.density;
  const double decay = std::exp(-alpha_ * tau), sine = std::sin(omega_ * tau) / omega_, cosine = std::cos(omega_ * tau);
  return {.f = -0.25 * data_.pressure * a * a * a / G_ * (1.0 - decay * (cosine + alpha_ * sine)),
          .d1 = -force * decay * sine,
          .d2 = -force * decay * (cosine - alpha_ * sine)};
}

double SphericalCavity::displacement(double r, double t) const {
  const Potential p = potential(r, t);
  return -p.f / (r * r) - p.d1 / (r * c_);
}

double SphericalCavity::velocity(double r, double t) const {
  const Potential p = potential(r, t);
  return -p.d1 / (r * r) - p.d2 / (r * c_);
}

double SphericalCavity::radial_stress(double r, double t) const {
  const Potential p = potential(r, t);
  return 4.0 * G_ * (p.f / (r * r * r) + p.d1 / (r * r * c_)) + data_.density * p.d2 / r;
}

double SphericalCavity::hoop_stress(double r, double t) const {
  const Potential p = potential(r, t);
  return -2.0 * G_ * (p.f / (r * r * r) + p.d1 / (r * r * c_)) + lambda_ * p.d2 / (r * c_ * c_);
}

double SphericalCavity::static_displacement(double r) const {
  const double a = data_.radius;
  return 0.25 * data_.pressure * a * a * a / (G_ * r * r);
}

double SphericalCavity::time_of_peak() const {
  // tan(omega tau) = omega / (alpha - c / a), in (0, pi)
  const double a = data_.radius;
  return std::atan2(omega_, alpha_ - c_ / a) / omega_;
}

}  // namespace carom
