// Is the case plausible in its unit system? Orders of magnitude only.
#pragma once

#include <string>
#include <vector>

#include "casefile/case.hpp"

namespace carom {

/// One line per doubtful value, beginning with file:line: density, Young's modulus, wave speed, speeds, gravity, and
/// the unit system in which the values would make sense; also scheme parameters that are only conditionally stable.
std::vector<std::string> plausibility_warnings(const Case& given);

}  // namespace carom
