#include "run/fold_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom {

void FoldWatch::see(const StepView& view) {
  const long long step = view.step;
  if (step == 0 || !warnings_.empty()) return;
  if (is_explicit(view.stage.settings().kind) && step < next_ && !view.ends_stage && !view.is_last()) return;
  const FlattestCorner corner = flattest_corner(simulation_, view.state.q);
  rate_ = std::max(0.0, share_ - corner.share) / static_cast<double>(std::max(1LL, step - looked_));
  share_ = corner.share;
  looked_ = step;
  constexpr double seldom = 200.0;  // steps: looking costs about 2.5 of HEXA8's cheapest
  next_ = step + static_cast<long long>(rate_ > 0.0 ? std::clamp(0.5 * share_ / rate_, 1.0, seldom) : seldom);
  if (corner.is_folded())
    warnings_.push_back(fmt::format("at t = {:.6g}, step {}, {}", view.state.t, step,
                                    describe_fold(simulation_, corner, view.state.q)));
}

}  // namespace carom
