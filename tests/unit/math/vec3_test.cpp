#include "math/vec3.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::math_vec3_test {
namespace {

TEST(Vec3, AlgebraOnKnownVectors) {
  constexpr Vec3 a{1, 2, 3}, b{-4, 5, 6};
  static_assert(dot(a, b) == 24);
  static_assert(cross(a, b) == Vec3{-3, -18, 13});
  static_assert(add(a, b) == Vec3{-3, 7, 9});
  static_assert(subtract(a, b) == Vec3{5, -3, -3});
  static_assert(scaled(a, -2) == Vec3{-2, -4, -6});
  EXPECT_EQ(norm(Vec3{2, 3, 6}), 7.0);
  EXPECT_DOUBLE_EQ(norm(Vec3{3e200, 4e200, 0}), 5e200);
  EXPECT_EQ(normalized(Vec3{0, -3, 4}), (Vec3{0, -0.6, 0.8}));
  EXPECT_TRUE(std::isnan(normalized(Vec3{0, 0, 0})[0]));
}

}  // namespace
}  // namespace carom::math_vec3_test
