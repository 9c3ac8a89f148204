#include "math/nearest_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"

namespace carom {

Columns3 nearest_rotation(Columns3 F) {
  constexpr int most = 60;  // a stretch s becomes (s + 1 / s) / 2: halved until it is near 1, then squared
  constexpr double round_off = 4e-16;
  for (int i = 0; i < most; ++i) {
    // R^-T has the columns cross(R_2, R_3) / det and so on.
    const double det = dot(F[0], cross(F[1], F[2]));
    Columns3 next{};
    double change = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 dual = scaled(cross(F[(c + 1) % 3], F[(c + 2) % 3]), 1.0 / det);
      next[c] = scaled(add(F[c], dual), 0.5);
      change = std::max(change, norm(subtract(next[c], F[c])));
    }
    F = next;
    if (change <= round_off) break;
  }
  return F;
}

}  // namespace carom
