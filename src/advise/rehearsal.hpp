// The first steps of a run, made beforehand to see what all of them will take.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Steps, and seconds on one core.
struct Pace {
  long long steps = 0;
  double seconds = 0.0;
};

/// How far a run came in a short while, on one core and without results.
struct Rehearsal {
  std::vector<Pace> stages;  ///< what was made of each stage that was reached
  double t = 0.0;            ///< to which it has come
  double seconds = 0.0;      ///< that it took, its start apart
  double late_dt = 0.0;      ///< mean of the later half of the steps in the last of the stages
  double late_seconds = 0.0;
  bool has_touched = false;  ///< in that half
  bool is_whole = false;     ///< it came to the end
  std::string failure{};     ///< why the run stopped there, "" where it did not
};

/// Makes steps until they have taken so many seconds; none where a single one is expected to take longer.
Rehearsal rehearse(const Simulation& simulation, double seconds);

/// What a whole stage takes, with what has been rehearsed of it. The rest of it goes on as the later half did, and
/// explicit steps that have not met their springs yet are cut as contact_cut says. A stage that was not reached takes
/// expected_steps and stage_seconds.
Pace foretell(const Simulation& simulation, std::size_t stage, const Rehearsal& rehearsal);

}  // namespace carom
