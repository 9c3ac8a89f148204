#include "march/step_control.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

long long StepControl::next() const {
  if (cut_ > 0) return cut_;
  const long long left = end_ - ticks_;
  if (longest_ < tick()) {  // no last step of a few ticks
    if (left <= longest_) return left;
    return left < 2 * longest_ ? (left + 1) / 2 : longest_;
  }
  const long long past = ticks_ % tick();
  if (past == 0) return tick();
  const long long to_grid = tick() - past;
  if (2 * to_grid >= tick() || to_grid == left) return to_grid;
  return (to_grid + tick()) / 2;
}

void StepControl::end_at(double end) {
  end_ = std::llround((end - begin_) / dt_ * static_cast<double>(whole));
}

void StepControl::accept() {
  ticks_ += next();
  cut_ = 0;
  ++successes_;
  const bool on_coarser_grid = ticks_ % (2 * tick()) == 0;
  if (level_ > 0 && successes_ >= 4 && on_coarser_grid) {
    --level_;
    successes_ = 0;
  }
}

bool StepControl::halve() {
  if (halving_ == Halving::forbidden || level_ == levels) return false;
  ++level_;
  if (cut_ > 0) cut_ = std::max(1LL, cut_ / 2);
  successes_ = 0;
  return true;
}

bool StepControl::cut(double fraction) {
  const long long now = next();
  if (now == 1) return false;
  cut_ = std::clamp(static_cast<long long>(fraction * static_cast<double>(now)), 1LL, now - 1);
  return true;
}

void StepControl::refine(double longest) {
  successes_ = 0;
  while (level_ < levels && dt_ * share(tick()) > longest) ++level_;
}

bool StepControl::limit(double longest) {
  const double eighths = -8.0 * std::log2(std::clamp(longest / dt_, 1e-300, 1.0));
  int wanted = std::max(0, static_cast<int>(std::ceil(eighths - 1e-9)));
  if (wanted < eighths_) wanted = std::max(wanted, eighths_ - 1);
  if (wanted > 8 * levels) return false;
  if (wanted != eighths_) successes_ = 0;
  eighths_ = wanted;
  longest_ = static_cast<long long>(static_cast<double>(whole) * std::exp2(-wanted / 8.0));
  return true;
}

}  // namespace carom
