#include "math/nearest_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/vec3.hpp"

namespace carom::math_nearest_rotation {
namespace {

Vec3 product(const Columns3& A, const Vec3& v) {
  return add(add(scaled(A[0], v[0]), scaled(A[1], v[1])), scaled(A[2], v[2]));
}

/// Rodrigues' formula for a turn by |w| about w.
Columns3 turn(const Vec3& w) {
  const double angle = norm(w);
  const Vec3 n = scaled(w, 1.0 / angle);
  Columns3 R{};
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 e{};
    e[c] = 1.0;
    R[c] = add(add(scaled(e, std::cos(angle)), scaled(cross(n, e), std::sin(angle))),
               scaled(n, dot(n, e) * (1.0 - std::cos(angle))));
  }
  return R;
}

// The polar decomposition is unique: of R U with U = Q diag(s) Q^T, s > 0, the rotation is R, whatever the stretch. To
// the rounding of the products, some units in the last place times the ratio of the stretches.
TEST(NearestRotation, IsTheRotationOfAProductWithAStretch) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-3.0, 3.0);
  for (int i = 0; i < 200; ++i) {
    const Columns3 R = turn({number(random), number(random), number(random)});
    const Columns3 Q = turn({number(random), number(random), number(random)});
    const Vec3 s{std::exp(number(random)), std::exp(number(random)), std::exp(number(random))};
    Columns3 F{};
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 stretched{};
      for (std::size_t k = 0; k < 3; ++k) stretched = add(stretched, scaled(Q[k], s[k] * Q[k][c]));
      F[c] = product(R, stretched);
    }
    const Columns3 found = nearest_rotation(F);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(norm(subtract(found[c], R[c])), 1e-12) << i;
  }
}

}  // namespace
}  // namespace carom::math_nearest_rotation
