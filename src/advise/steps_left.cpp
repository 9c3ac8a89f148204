#include "advise/steps_left.hpp"

#include <algorithm>

#include "advise/stage_time.hpp"

namespace carom {

StepsLeft::StepsLeft(const Simulation& simulation, double end) : simulation_(simulation), end_(end) {}

double StepsLeft::after(const StepView& view) {
  constexpr std::size_t most = 20;
  if (&view.stage != stage_) {
    stage_ = &view.stage;
    later_ = 0.0;
    seen_.assign(1, {view.step - 1, view.state.t - view.dt});
    const auto& stages = simulation_.stages();
    const auto now = std::ranges::find_if(stages, [&](const auto& stage) { return stage.get() == stage_; });
    for (auto next = now + 1; next < stages.end(); ++next)
      later_ += static_cast<double>(expected_steps(**next, simulation_));
  }
  seen_.push_back({view.step, view.state.t});
  if (seen_.size() > most) seen_.pop_front();
  const double made = static_cast<double>(view.step - seen_.front().step), way = view.state.t - seen_.front().t,
               end = later_ > 0.0 ? stage_->end() : end_;
  return later_ + (way > 0.0 ? std::max(0.0, end - view.state.t) * made / way : 0.0);
}

}  // namespace carom
