// Amounts of bytes and of time in words.
#pragma once

#include <string>

namespace carom {

/// "about 3 GB", "about 20 s", "about 2 h": one significant figure, in the unit that suits.
std::string about_bytes(double bytes);
std::string about_seconds(double seconds);

}  // namespace carom
