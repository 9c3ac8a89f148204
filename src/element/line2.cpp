#include "element/line2.hpp"

#include "math/vec3.hpp"

namespace carom::line2 {

double length(const std::array<Vec3, 2>& x) {
  return norm(subtract(x[1], x[0]));
}

Vec3 axis(const std::array<Vec3, 2>& x) {
  return normalized(subtract(x[1], x[0]));
}

}  // namespace carom::line2
