#include "advise/rehearsal.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <new>
#include <utility>

#include "advise/stage_time.hpp"
#include "march/march.hpp"
#include "march/watches.hpp"
#include "parallel/threads.hpp"
#include "record/recorder.hpp"

namespace carom {

namespace {

/// A step as it was made, with all that is needed to say how the last ones went.
struct SeenStep {
  double seconds = 0.0;  ///< since the start
  double t = 0.0;        ///< of its end
  bool touches = false;
};

bool touches(const ContactResponse& rows) {
  return std::ranges::any_of(rows.force, [](const Vec3& f) { return f[0] != 0.0; });
}

std::size_t number_of(const Stage& stage, const Simulation& s) {
  std::size_t n = 0;
  while (s.stages()[n].get() != &stage) ++n;
  return n;
}

/// Leads the march until the time is over. seen: of the present stage, from its begin on.
void make_steps(March& march, const Simulation& s, double seconds, Rehearsal& out, std::vector<SeenStep>& seen) {
  using Clock = std::chrono::steady_clock;
  march.start();
  const Clock::time_point begin = Clock::now();
  seen = {{0.0, march.state().t, touches(march.state().forces.rows)}};
  while (out.seconds < seconds && !march.at_end() && !march.has_failed()) {
    march.step();
    const State& state = march.state();
    const double before = std::exchange(out.seconds, std::chrono::duration<double>(Clock::now() - begin).count());
    const std::size_t stage = number_of(march.view().stage, s);
    if (stage + 1 != out.stages.size()) seen.erase(seen.begin(), seen.end() - 1);
    out.stages.resize(stage + 1);
    ++out.stages.back().steps;
    out.stages.back().seconds += out.seconds - before;
    seen.push_back({out.seconds, state.t, touches(state.forces.rows)});
  }
}

/// True where a step of the stage is expected to take less than a share of the time: implicit steps may iterate much
/// longer than expected, and none is left halfway.
bool is_short(const Stage& stage, const Simulation& s, double seconds) {
  const double share = is_explicit(stage.settings().kind) ? 1.0 : 0.1;
  return stage_seconds(stage, s) < share * seconds * static_cast<double>(expected_steps(stage, s));
}

}  // namespace

Rehearsal rehearse(const Simulation& s, double seconds) {
  Rehearsal out;
  if (!std::ranges::all_of(s.stages(), [&](const auto& stage) { return is_short(*stage, s, seconds); })) return out;
  const ThreadScope one(1);
  March march(s);
  Recorder recorder(s, "");  // of no folder: curves and figures are made, files are not
  Watches watches(s, march);
  march.add(recorder);
  watches.look_at(march);
  std::vector<SeenStep> seen;
  try {
    make_steps(march, s, seconds, out, seen);
    out.failure = march.message();
  } catch (const std::bad_alloc&) {
    out.failure = "memory ran out";
  } catch (const std::exception& error) {  // of the run, or of a factorisation that fails
    out.failure = error.what();
  }
  if (!march.is_started() || seen.size() < 2) return out;
  out.t = march.state().t;
  out.is_whole = march.at_end();
  const std::size_t last = seen.size() - 1, middle = last / 2;
  const double steps = static_cast<double>(last - middle);
  out.late_dt = (seen[last].t - seen[middle].t) / steps;
  out.late_seconds = (seen[last].seconds - seen[middle].seconds) / steps;
  out.has_touched = std::any_of(seen.begin() + static_cast<std::ptrdiff_t>(middle), seen.end(),
                                [](const SeenStep& step) { return step.touches; });
  return out;
}

Pace foretell(const Simulation& s, std::size_t number, const Rehearsal& seen) {
  const Stage& stage = *s.stages()[number];
  if (number >= seen.stages.size()) return {expected_steps(stage, s), stage_seconds(stage, s)};
  const Pace& made = seen.stages[number];
  if (number + 1 < seen.stages.size() || !seen.failure.empty() || !(seen.late_dt > 0.0)) return made;
  const double left = std::max(0.0, stage.end() - seen.t) / seen.late_dt,
               steps = left * (seen.has_touched ? 1.0 : contact_cut(stage, s));
  return {made.steps + std::llround(steps), made.seconds + steps * seen.late_seconds};
}

}  // namespace carom
