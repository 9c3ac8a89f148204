// The steps that a run has made.
#pragma once

#include <algorithm>

namespace carom {

/// How many, and how long.
class StepCount {
 public:
  /// One more, with so many iterations.
  void add(double dt, int iterations) {
    ++steps_;
    dt_ = dt;
    iterations_ = iterations;
    smallest_ = steps_ == 1 ? dt : std::min(smallest_, dt);
    largest_ = std::max(largest_, dt);
  }

  long long steps() const { return steps_; }
  /// Of the last step; 0 before the first.
  double dt() const { return dt_; }
  int iterations() const { return iterations_; }
  double smallest() const { return smallest_; }
  double largest() const { return largest_; }

 private:
  template <class A>
  friend void fields(A& archive, StepCount& x) {
    archive("step", x.steps_);
    archive("dt", x.dt_);
    archive("iterations", x.iterations_);
    archive("dt_smallest", x.smallest_);
    archive("dt_largest", x.largest_);
  }

  long long steps_ = 0;
  double dt_ = 0.0;
  int iterations_ = 0;
  double smallest_ = 0.0, largest_ = 0.0;
};

}  // namespace carom
