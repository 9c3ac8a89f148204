// Times of the steps: the usual step, shortened where a step fails, contact closes or the stable step shrinks, and
// lengthened again later.
#pragma once

namespace carom {

/// Counts time in 2^-16 parts of the usual step, so that whole steps fall on exact multiples of it. Failed steps and
/// contact events halve the step; after four steps it is doubled again, where the time is a multiple of the doubled
/// step. A step that has been cut elsewhere is followed by one that leads back to a multiple of the present step.
/// limit() shortens by 8 % at a time instead, 2^(-1/8), and leaves the multiples.
class StepControl {
 public:
  /// From `begin` on, `steps` usual steps of length dt reach the end; halving_allowed is false where the case fixes the
  /// step.
  enum class Halving : bool { forbidden, allowed };
  StepControl(double begin, double dt, long long steps, Halving halving)
      : begin_(begin), dt_(dt), end_(steps << levels), halving_(halving) {}

  bool at_end() const { return ticks_ >= end_; }
  double dt() const { return dt_ * share(next()); }
  double t_end_of_step() const { return begin_ + share(ticks_ + next()) * dt_; }

  /// Moves the end to this time, to the nearest part.
  void end_at(double end);
  void accept();
  /// Halves the step; false when it may not be halved any more.
  bool halve();
  /// Shortens the next step alone to this fraction of it, in (0, 1); false when it is the shortest already.
  bool cut(double fraction);
  /// The next steps are at most this long, by halving; they grow again.
  void refine(double longest);
  /// The steps from here on are at most this long, whether they may be halved for other reasons or not; false when the
  /// smallest is longer. A greater length than last time lengthens the steps by 2^(1/8).
  bool limit(double longest);

 private:
  template <class A>
  friend void fields(A& archive, StepControl& x) {
    archive("ticks", x.ticks_);
    archive("end", x.end_);
    archive("eighths", x.eighths_);
    archive("longest", x.longest_);
    archive("cut", x.cut_);
    archive("level", x.level_);
    archive("successes", x.successes_);
  }

  static constexpr int levels = 16;
  static constexpr long long whole = 1LL << levels;
  static double share(long long ticks) { return static_cast<double>(ticks) / static_cast<double>(whole); }
  long long tick() const { return whole >> level_; }
  long long next() const;

  double begin_, dt_;
  long long ticks_ = 0, end_;
  Halving halving_;
  int eighths_ = 0;            ///< limit(): the step is at most dt 2^(-eighths / 8)
  long long longest_ = whole;  ///< the same in ticks
  long long cut_ = 0;          ///< length of the next step where it has been cut, 0 otherwise
  int level_ = 0;              ///< the step is dt / 2^level
  int successes_ = 0;          ///< steps since the last change of the step
};

}  // namespace carom
