// Times of the steps: the usual step, halved where a step fails and doubled again later.
#pragma once

#include <limits>

namespace carom {

/// Counts time in 2^-16 parts of the usual step, so that whole steps fall on exact multiples of it.
class StepControl {
 public:
  /// From `begin` on, `steps` usual steps of length dt reach the end; halving_allowed is false where the case fixes the
  /// step.
  enum class Halving : bool { forbidden, allowed };
  StepControl(double begin, double dt, long long steps, Halving halving)
      : begin_(begin), dt_(dt), end_(steps << levels), halving_(halving) {}

  bool at_end() const { return ticks_ >= end_; }
  double dt() const { return dt_ * static_cast<double>(tick()) / static_cast<double>(1LL << levels); }
  double t_end_of_step() const { return time(ticks_ + tick()); }

  void accept();
  /// Halves the step; false when it may not be halved any more.
  bool halve();
  bool may_halve() const { return halving_ == Halving::allowed; }
  /// The steps from here on are at most this long, whether they may be halved for other reasons or not; false when the
  /// smallest is longer.
  bool limit(double longest);

 private:
  static constexpr int levels = 16;
  long long tick() const { return 1LL << (levels - level_); }
  double time(long long ticks) const {
    return begin_ + static_cast<double>(ticks) / static_cast<double>(1LL << levels) * dt_;
  }

  double begin_, dt_;
  long long ticks_ = 0, end_;
  Halving halving_;
  double longest_ = std::numeric_limits<double>::infinity();
  int level_ = 0;      ///< the step is dt / 2^level
  int successes_ = 0;  ///< steps since the last change of the step
};

}  // namespace carom
