// Looks now and then whether bodies overlap, for the verdict.
#pragma once

#include <string>

#include "contact/body_overlap.hpp"
#include "output/summary.hpp"
#include "run/simulation.hpp"
#include "state/state.hpp"

namespace carom {

/// About fifty looks over the run, and one at its end. Contact is judged by what it has not prevented, whether it was
/// defined or not.
class OverlapWatch {
 public:
  explicit OverlapWatch(const Simulation& simulation, const State& start);

  /// After every step. `last` looks in any case.
  enum class Moment : std::uint8_t { during, last };
  void look(const State& state, Moment moment);
  /// "overlap": the deepest so far in cells, and where, when and between whom.
  VerdictItem item() const;

 private:
  std::string names() const;

  const Simulation& simulation_;
  BodyOverlap overlap_;
  double next_, every_;
  Overlap worst_;
  double time_ = 0.0;  ///< of the worst
};

}  // namespace carom
