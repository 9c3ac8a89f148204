#include "base/amounts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace carom {

namespace {

/// To a digit, and to two where the first is 1, for which one digit may be a third off.
std::string rounded(double value, const char* unit) {
  const double magnitude = std::pow(10.0, std::floor(std::log10(value)));
  const double last = value < 1.95 * magnitude ? 0.1 * magnitude : magnitude;
  return fmt::format("about {:g} {}", std::round(value / last) * last, unit);
}

struct Unit {
  double size;
  const char* name;
};

template <std::size_t n>
std::string in_units(double value, const std::array<Unit, n>& units) {
  if (!std::isfinite(value)) return "unknown";
  const auto fits = std::find_if(units.begin(), units.end(), [&](const Unit& u) { return value >= u.size; });
  if (fits == units.end()) return fmt::format("less than 1 {}", units.back().name);
  return rounded(value / fits->size, fits->name);
}

}  // namespace

std::string about_bytes(double bytes) {
  return in_units(bytes, std::array<Unit, 4>{{{1e12, "TB"}, {1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}}});
}

std::string about_seconds(double seconds) {
  return in_units(seconds, std::array<Unit, 4>{{{86400.0, "d"}, {3600.0, "h"}, {60.0, "min"}, {1.0, "s"}}});
}

}  // namespace carom
