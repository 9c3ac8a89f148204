#include "report/place_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom {

std::string place_text(const Vec3& x, double reach, const std::string& unit) {
  constexpr double rounding = 1e-9;
  Vec3 shown = x;
  for (double& c : shown) c = std::abs(c) > rounding * reach ? c : 0.0;
  return fmt::format("({:.4g}, {:.4g}, {:.4g}){}{}", shown[0], shown[1], shown[2], unit.empty() ? "" : " ", unit);
}

}  // namespace carom
