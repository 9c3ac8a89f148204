// What this build is.
#pragma once

#include <string>

namespace carom {

/// Version of carom, e.g. "0.1.0".
std::string version();
/// Compiler and its version, e.g. "GCC 12.2.0".
std::string compiler();

}  // namespace carom
