#include "exact/friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "exact/arguments.hpp"
#include "exact/solution.hpp"

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

namespace {

/// Of a rigid body, the same at every place.
template <class Block>
ExactMotion motion_of_block(const std::shared_ptr<const Block>& block) {
  ExactMotion motion;
  motion.at = [block](const ExactPlace&) {
    return ExactPoint{
        [block](double t) { return block->position(t); }, [block](double t) { return block->velocity(t); }, {}};
  };
  motion.energies = {{"friction", [block](double t) { return block->dissipated(t); }}};
  return motion;
}

ExactParameter block_mass() {
  return positive("mass", "Mass of the body.", Dimension::mass);
}
ExactParameter coulomb() {
  return not_negative("friction", "Coulomb's coefficient.", Dimension::none);
}

}  // namespace

ExactSolution sliding_block_row() {
  ExactSolution row{.name = "sliding_block", .summary = "a rigid block slides on a level or inclined plane"};
  row.parameters = {
      block_mass(),
      {.key = "speed", .meaning = "Of the block, along the axis.", .unit = Dimension::velocity, .initial = 0.0},
      gravity_parameter(),
      coulomb(),
      not_negative("angle", "Slope of the incline, in radians.", Dimension::none)};
  row.motion = [](const ExactValues& values, const ExactCase&) {
    return motion_of_block(std::make_shared<const SlidingBlock>(SlidingBlockData{.mass = values.at("mass"),
                                                                                 .mu = values.at("friction"),
                                                                                 .gravity = values.at("gravity"),
                                                                                 .angle = values.at("angle"),
                                                                                 .speed = values.at("speed")}));
  };
  return row;
}

ExactSolution friction_oscillator_row() {
  ExactSolution row{.name = "friction_oscillator", .summary = "a rigid block on a spring rubs on a plane"};
  row.parameters = {block_mass(),
                    positive("stiffness", "Of the spring.", Dimension::force_per_length),
                    gravity_parameter(),
                    coulomb(),
                    {.key = "initial_displacement",
                     .meaning = "Where the oscillator is released.",
                     .unit = Dimension::length,
                     .initial = 0.0}};
  row.motion = [](const ExactValues& values, const ExactCase&) {
    return motion_of_block(std::make_shared<const FrictionOscillator>(
        FrictionOscillatorData{.mass = values.at("mass"),
                               .stiffness = values.at("stiffness"),
                               .friction = values.at("friction") * values.at("mass") * values.at("gravity"),
                               .start = values.at("initial_displacement")}));
  };
  return row;
}

}  // namespace carom
