#include "solid/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "element/kinematics.hpp"
#include "math/vec3.hpp"

namespace carom {

double rotation_angle(const double F[3][3]) {
  double R[3][3];
  std::copy_n(&F[0][0], 9, &R[0][0]);
  constexpr int most = 50;
  for (int iteration = 0; iteration < most; ++iteration) {
    const double det = determinant(R);
    if (!(det > 0.0) || !std::isfinite(det)) return std::numbers::pi;
    const Vec3 row[3] = {{R[0][0], R[0][1], R[0][2]}, {R[1][0], R[1][1], R[1][2]}, {R[2][0], R[2][1], R[2][2]}};
    const Vec3 cofactor[3] = {cross(row[1], row[2]), cross(row[2], row[0]), cross(row[0], row[1])};  // det R^-T
    double change = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const double next = 0.5 * (row[i][j] + cofactor[i][j] / det);
        change = std::max(change, std::abs(next - row[i][j]));
        R[i][j] = next;
      }
    if (change < 1e-9) break;  // it converges quadratically: the next change is round-off
  }
  const Vec3 axis{R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]};  // 2 sin(angle) x unit axis
  return std::atan2(norm(axis), R[0][0] + R[1][1] + R[2][2] - 1.0);
}

double angle_between(const Vec3& a, const Vec3& b) {
  const double size = norm(a) * norm(b);
  if (!(size > 0.0) || !std::isfinite(size)) return std::numbers::pi;
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

}  // namespace carom
