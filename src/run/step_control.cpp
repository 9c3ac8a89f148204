#include "run/step_control.hpp"

namespace carom {

void StepControl::accept() {
  ticks_ += tick();
  ++successes_;
  const bool on_coarser_grid = ticks_ % (2 * tick()) == 0;
  if (level_ > 0 && successes_ >= 4 && on_coarser_grid && 2.0 * dt() <= longest_) {
    --level_;
    successes_ = 0;
  }
}

bool StepControl::halve() {
  if (halving_ == Halving::forbidden || level_ == levels) return false;
  ++level_;
  successes_ = 0;
  return true;
}

bool StepControl::limit(double longest) {
  longest_ = longest;
  while (dt() > longest_ * (1.0 + 1e-12)) {
    if (level_ == levels) return false;
    ++level_;
    successes_ = 0;
  }
  return true;
}

}  // namespace carom
