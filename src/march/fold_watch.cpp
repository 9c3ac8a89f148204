#include "march/fold_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/types.hpp"

namespace carom {

FoldWatch::FoldWatch(const Simulation& simulation) : simulation_(simulation) {
  for (const Part& part : simulation.model().parts)
    has_small_strain_ = has_small_strain_ || (part.section != Section::bar && !part.cells.empty() &&
                                              part.material.law->measure == Measure::small_strain);
}

std::optional<VerdictItem> FoldWatch::item() const {
  if (!has_small_strain_) return std::nullopt;
  constexpr double limit = 0.5;
  return VerdictItem{
      "small strain", lost_, limit, lost_ <= limit,
      "the most of its volume that a corner of a cell of small strain has lost (1: it is flat), whose stresses "
      "mean little then: a law of finite strain?"};
}

void FoldWatch::see(const StepView& view) {
  const long long step = view.step;
  const bool has_folded = !warnings_.empty();
  if (step == 0 || (has_folded && (!has_small_strain_ || lost_ >= 1.0))) return;
  if (is_explicit(view.stage.settings().kind) && step < next_ && !view.ends_stage && !view.is_last()) return;
  const FlattestCorner corner = flattest_corner(simulation_, view.state.q, view.state.alive());
  lost_ = std::max(lost_, 1.0 - corner.small_strain);
  const double share = has_folded ? corner.small_strain : corner.share;
  rate_ = std::max(0.0, share_ - share) / static_cast<double>(std::max(1LL, step - looked_));
  share_ = share;
  looked_ = step;
  constexpr double seldom = 200.0;  // steps: looking costs about 2.5 of HEXA8's cheapest
  next_ = step + static_cast<long long>(rate_ > 0.0 ? std::clamp(0.5 * share_ / rate_, 1.0, seldom) : seldom);
  if (!corner.is_folded() || has_folded) return;
  view.shared.complete_displacements(simulation_.solid().cells().nodes_of(at(corner.cell)));
  warnings_.push_back(
      fmt::format("at t = {:.6g}, step {}, {}", view.state.t, step, describe_fold(simulation_, corner, view.state.q)));
}

}  // namespace carom
