// Why steps have been cut or kept short, for the log.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// Reasons, in the order of the log.
enum class ShortStep : std::uint8_t {
  carries_too_far,  ///< contact would close by more than a part of a cell (MotionLimit)
  ends_at_touch,    ///< time.event_tolerance
  misplaces,        ///< contact that closes or opens within the step misplaces energy (EnergyGuard)
  makes_energy,     ///< no change of contact explains it, or all steps together gain
  stiffens,         ///< the stable step has fallen
  fails,            ///< no equilibrium, a cell inside out, an energy that is no number
  count
};

/// The first and the shortest step of each reason, and how often it acted.
class StepNotes {
 public:
  struct Step {
    long long number = 0;
    double t = 0.0;   ///< of its beginning
    double dt = 0.0;  ///< what was left of it
  };
  /// place: where it was, "" unknown.
  void add(ShortStep reason, const Step& step, std::string place);
  /// One line for each reason that has acted; usual: the step of the stage; energy_remedy: what helps against steps
  /// that make energy.
  std::vector<std::string> lines(double usual, const std::string& energy_remedy) const;

 private:
  struct Entry {
    long long count = 0;
    Step first, shortest;
    std::string place;
  };
  template <class A>
  friend void fields(A& archive, Step& x) {
    archive("number", x.number);
    archive("t", x.t);
    archive("dt", x.dt);
  }
  template <class A>
  friend void fields(A& archive, Entry& x) {
    archive("count", x.count);
    archive("first", x.first);
    archive("shortest", x.shortest);
    archive("place", x.place);
  }
  template <class A>
  friend void fields(A& archive, StepNotes& x) {
    archive.each("entries", x.entries_);
  }

  std::vector<Entry> entries_ = std::vector<Entry>(static_cast<std::size_t>(ShortStep::count));
};

}  // namespace carom
