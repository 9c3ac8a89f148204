// Is the case plausible in its unit system? Orders of magnitude only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casefile/case.hpp"

namespace carom {

/// What shows that a unit is wrong.
struct UnitSign {
  Location where;
  std::string what;  ///< was found
  std::string cure;
  std::optional<UnitSystem> fits{};  ///< in which it would make sense
};

/// Doubtful values, each line beginning with file:line: density, Young's modulus, wave speed, speeds, gravity, and the
/// unit system in which the values would make sense, one line for all that it explains; also scheme parameters that are
/// only conditionally stable. further: signs found elsewhere, which are laid to the first cause, if there is one.
std::vector<std::string> plausibility_warnings(const Case& given, std::vector<UnitSign> further = {});

}  // namespace carom
