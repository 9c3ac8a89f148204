#include "exact/spinning_bar.hpp"

#include <cmath>
#include <stdexcept>

#include "exact/arguments.hpp"

namespace carom {

SpinningBar::SpinningBar(const SpinningBarData& data) : data_(data), c_(std::sqrt(data.modulus / data.density)) {
  require_positive("spinning bar",
                   {{"half length", data.half_length}, {"modulus", data.modulus}, {"density", data.density}});
  if (!std::isfinite(data.spin)) throw std::invalid_argument("spinning bar: spin is not finite");
}

SpinningBar::Shape SpinningBar::shape(double x) const {
  const double L = data_.half_length, scale = data_.spin * data_.spin / (c_ * c_);
  double y = std::remainder(x, 4.0 * L), fold = 1.0;
  if (std::abs(y) > L) {
    y = std::copysign(2.0 * L, y) - y;
    fold = -1.0;
  }
  return {scale * y * (0.5 * L * L - y * y / 6.0), fold * scale * 0.5 * (L * L - y * y)};
}

double SpinningBar::displacement(double x, double t) const {
  return shape(x).U - 0.5 * (shape(x - c_ * t).U + shape(x + c_ * t).U);
}

double SpinningBar::velocity(double x, double t) const {
  return 0.5 * c_ * (shape(x - c_ * t).slope - shape(x + c_ * t).slope);
}

double SpinningBar::stress(double x, double t) const {
  return data_.modulus * (shape(x).slope - 0.5 * (shape(x - c_ * t).slope + shape(x + c_ * t).slope));
}

}  // namespace carom
