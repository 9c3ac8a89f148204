// What a run shows while it goes on.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace carom {

/// automatic: live on a terminal, else lines. live: one line rewritten in place, at most 10 times per second.
/// lines: a plain line every 5 percent of the steps. quiet: nothing at all.
enum class ProgressMode : std::uint8_t { automatic, live, lines, quiet };

/// One finished step.
struct ProgressUpdate {
  double t = 0.0;
  std::int64_t step = 0;
  double dt = 0.0;
  int iterations = 0;         ///< of the step's solver; 0 for explicit schemes
  double energy_error = 0.0;  ///< imbalance relative to the initial and supplied energy
  double steps_left = 0.0;    ///< about so many are still to be made
  double kinetic = 0.0;       ///< energy
  double force = 0.0;         ///< that presses in all contacts together
};

/// Shows how far a run has come: steps made, of those and what is left. Costs a clock reading per update when nothing
/// is due.
class Progress {
 public:
  Progress(std::FILE* stream, ProgressMode mode);

  void update(const ProgressUpdate& now);
  /// Clears the live line and writes `message` on a line of its own (nothing when it is empty or the mode is quiet).
  void finish(std::string_view message);

 private:
  using Clock = std::chrono::steady_clock;

  void show_live(const ProgressUpdate& now);
  void show_line(const ProgressUpdate& now);
  void clear_live();
  void follow(const ProgressUpdate& now);
  double seconds_left(const ProgressUpdate& now) const;

  std::FILE* stream_;
  ProgressMode mode_;
  /// When a step was done.
  struct Mark {
    Clock::time_point time;
    std::int64_t step;
  };
  std::deque<Mark> marks_;  ///< of the last seconds
  Clock::time_point last_shown_;
  double next_line_ = 0.05;  ///< fraction of the steps at which the next plain line is due
  bool live_shown_ = false;  ///< a live line stands on the terminal
};

/// A span of the clock, e.g. "50 s", "12 min 05 s", "3 h 24 min".
std::string duration_text(double seconds);

/// "43 % of the time, about 50 s left", as far as end (0: not known) and the rest are known.
std::string progress_share(double t, double t_end, std::optional<double> seconds_left);

/// The text of one progress line, at most `width` columns: bar, percentage of the steps, t, time left (where it is
/// finite), step, dt, iterations, kinetic energy, force of contact (where there is one), energy error. What does not
/// fit is left out from the right, the bar shrinks first.
std::string progress_line(const ProgressUpdate& now, double seconds_left, int width);

}  // namespace carom
