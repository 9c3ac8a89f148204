#include "solid/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "element/kinematics.hpp"
#include "kernels/batch_gradients.hpp"
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

void follow_rotation(const BatchGradients& gradients, CellType type, int lanes, int count, Index first,
                     Rotation& largest) {
  double H[9 * most_lanes], square[most_lanes] = {}, skew[most_lanes] = {};
  gradients.means(H);
  for (int c = 0; c < 9; ++c)
    for (int l = 0; l < lanes; ++l) square[l] += H[c * lanes + l] * H[c * lanes + l];
  for (const auto& [c, d] : {std::pair{1, 3}, {2, 6}, {5, 7}})
    for (int l = 0; l < lanes; ++l) {
      const double twice = H[c * lanes + l] - H[d * lanes + l];
      skew[l] += 0.5 * twice * twice;
    }
  double sine = std::sin(0.5 * largest.angle);
  for (int l = 0; l < count; ++l) {
    const double room = 1.0 - std::sqrt(square[l]), least = std::sqrt(8.0) * room * sine;
    if (dimension(type) > 1 && room > 0.0 && skew[l] <= least * least) continue;
    double A[3][3], F[3][3];
    gradients.frame(l, A);
    for (int c = 0; c < 9; ++c) F[c / 3][c % 3] = A[c / 3][c % 3] + H[c * lanes + l];
    const double angle = dimension(type) > 1 ? rotation_angle(F)
                                             : angle_between({A[0][0], A[1][0], A[2][0]}, {F[0][0], F[1][0], F[2][0]});
    if (angle <= largest.angle) continue;
    largest = {angle, first + l};
    sine = std::sin(0.5 * angle);
  }
}

}  // namespace carom
