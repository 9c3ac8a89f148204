// How many steps a run has still to make.
#pragma once

#include <deque>

#include "build/simulation.hpp"
#include "march/observer.hpp"

namespace carom {

/// From the length of the last steps, and of stages to come from expected_steps.
class StepsLeft {
 public:
  /// end: of the run.
  StepsLeft(const Simulation& simulation, double end);
  /// After this step. Each step is asked for once, in their order.
  double after(const StepView& view);

 private:
  struct Seen {
    long long step = 0;
    double t = 0.0;
  };
  const Simulation& simulation_;
  double end_;
  const Stage* stage_ = nullptr;  ///< the present one
  double later_ = 0.0;            ///< steps of those that follow
  std::deque<Seen> seen_;         ///< the last steps of the present stage
};

}  // namespace carom
