#include "exact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "exact/arguments.hpp"

namespace carom {

FrictionOscillator::FrictionOscillator(const FrictionOscillatorData& data) : data_(data) {
  require_positive("friction oscillator",
                   {{"mass", data.mass}, {"stiffness", data.stiffness}, {"friction", data.friction}});
  if (!std::isfinite(data.start)) throw std::invalid_argument("friction oscillator: start is not finite");
  half_period_ = std::numbers::pi * std::sqrt(data.mass / data.stiffness);
  const double reach = data.friction / data.stiffness, most = std::abs(data.start);
  double sign = data.start < 0.0 ? -1.0 : 1.0;
  // |x_n| = |x_0| - 2 n R / k
  for (double n = 0.0; most - 2.0 * n * reach > reach + 1e-12 * most; ++n) {
    sign = -sign;
    turns_.push_back(sign * (most - 2.0 * (n + 1.0) * reach));
  }
}

FrictionOscillator::Swing FrictionOscillator::swing(double t) const {
  const double n = std::floor(t / half_period_);
  const double from = n == 0.0 ? data_.start : turns_[static_cast<std::size_t>(n) - 1];
  return {from, std::copysign(data_.friction / data_.stiffness, from), std::numbers::pi * (t / half_period_ - n)};
}

double FrictionOscillator::position(double t) const {
  if (t >= sticking_time()) return sticking_position();
  const Swing now = swing(t);
  return now.centre + (now.from - now.centre) * std::cos(now.angle);
}

double FrictionOscillator::velocity(double t) const {
  if (t >= sticking_time()) return 0.0;
  const Swing now = swing(t);
  return -(now.from - now.centre) * std::sin(now.angle) * std::numbers::pi / half_period_;
}

double FrictionOscillator::friction_force(double t) const {
  if (t >= sticking_time()) return data_.stiffness * sticking_position();
  return data_.stiffness * swing(t).centre;
}

double FrictionOscillator::dissipated(double t) const {
  double path = 0.0, from = data_.start;
  for (std::size_t n = 0; n < turns_.size() && t > half_period_ * static_cast<double>(n); ++n) {
    const bool complete = t >= half_period_ * static_cast<double>(n + 1);
    path += std::abs((complete ? turns_[n] : position(t)) - from);
    from = turns_[n];
  }
  return data_.friction * path;
}

SlidingBlock::SlidingBlock(const SlidingBlockData& data) : data_(data) {
  require_positive("sliding block", {{"mass", data.mass}, {"gravity", data.gravity}});
  require_not_negative("sliding block", {{"mu", data.mu}, {"angle", data.angle}});
  if (data.angle >= 0.5 * std::numbers::pi) throw std::invalid_argument("sliding block: angle is not below pi / 2");
  if (!std::isfinite(data.speed)) throw std::invalid_argument("sliding block: speed is not finite");
  const double pull = data.gravity * std::sin(data.angle), drag = data.mu * data.gravity * std::cos(data.angle);
  acceleration_after_ = std::max(0.0, pull - drag);
  acceleration_ = data.speed < 0.0 ? pull + drag : pull - drag;
  if (data.speed == 0.0)
    stop_time_ = 0.0;
  else
    stop_time_ =
        data.speed * acceleration_ < 0.0 ? -data.speed / acceleration_ : std::numeric_limits<double>::infinity();
}

double SlidingBlock::position(double t) const {
  const double sliding = std::min(t, stop_time_), after = t - sliding;
  return sliding * (data_.speed + 0.5 * acceleration_ * sliding) + 0.5 * acceleration_after_ * after * after;
}

double SlidingBlock::velocity(double t) const {
  return t < stop_time_ ? data_.speed + acceleration_ * t : acceleration_after_ * (t - stop_time_);
}

double SlidingBlock::friction_force(double t) const {
  const double limit = data_.mu * data_.mass * data_.gravity * std::cos(data_.angle);
  if (t < stop_time_) return data_.speed < 0.0 ? limit : -limit;
  return holds() ? -data_.mass * data_.gravity * std::sin(data_.angle) : -limit;
}

double SlidingBlock::dissipated(double t) const {
  const double turn = position(std::min(t, stop_time_));
  const double path = std::abs(turn) + std::abs(position(t) - turn);
  return data_.mu * data_.mass * data_.gravity * std::cos(data_.angle) * path;
}

double SlidingBlock::stop_position() const {
  return std::isinf(stop_time_) ? stop_time_ : position(stop_time_);
}

}  // namespace carom
