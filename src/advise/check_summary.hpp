// The text of `carom check`.
#pragma once

#include <string>
#include <vector>

#include "advise/rehearsal.hpp"
#include "build/simulation.hpp"

namespace carom {

/// Parts with mass, kinetic energy and momentum; contacts with gap and first touch; stages with steps and Courant
/// number; stable step; estimated cost, with what has been rehearsed.
std::string check_summary(const Simulation& simulation, const Rehearsal& seen = {});

/// All that is known of a case before it runs.
struct Examination {
  std::string summary;
  std::vector<std::string> notes, warnings;

  /// The lines of `carom check`.
  std::string text() const;
};

/// How long steps are made beforehand where nothing else is asked for, in seconds.
inline constexpr double usual_rehearsal = 1.0;

/// folder: where the results would go, "" for nowhere; rehearsal: for how many seconds steps are made beforehand, to
/// see what the run takes and whether it stops. Throws CaseError for probes and checks that a run would refuse.
Examination examine(const Simulation& simulation, const std::string& folder, double rehearsal = 0.0);

}  // namespace carom
