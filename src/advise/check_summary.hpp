// The text of `carom check`.
#pragma once

#include <string>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Parts with mass, kinetic energy and momentum; contacts with gap and first touch; stages with steps and Courant
/// number; stable step; estimated cost.
std::string check_summary(const Simulation& simulation);

/// All that is known of a case before it runs.
struct Examination {
  std::string summary;
  std::vector<std::string> notes, warnings;

  /// The lines of `carom check`.
  std::string text() const;
};

/// folder: where the results would go, "" for nowhere. Throws CaseError for probes and checks that a run would refuse.
Examination examine(const Simulation& simulation, const std::string& folder);

}  // namespace carom
