#include "element/quad4.hpp"

#include <cmath>
#include <cstddef>

#include "element/hexa8_length.hpp"

namespace carom::quad4 {
namespace {

constexpr std::array<std::array<double, 2>, 4> reference{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

}  // namespace

Vec3 area_normal(const std::array<Vec3, 4>& x, double xi, double eta) {
  Vec3 s{}, t{};
  for (std::size_t a = 0; a < 4; ++a) {
    const double dxi = 0.25 * reference[a][0] * (1.0 + eta * reference[a][1]);
    const double deta = 0.25 * reference[a][1] * (1.0 + xi * reference[a][0]);
    for (std::size_t i = 0; i < 3; ++i) {
      s[i] += dxi * x[a][i];
      t[i] += deta * x[a][i];
    }
  }
  return {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
}

std::array<FacePoint, 4> face_points(const std::array<Vec3, 4>& x) {
  const double g = 1.0 / std::sqrt(3.0);
  std::array<FacePoint, 4> points{};
  for (std::size_t p = 0; p < 4; ++p) {
    const double xi = g * reference[p][0], eta = g * reference[p][1];
    points[p] = {shape(xi, eta), area_normal(x, xi, eta)};
  }
  return points;
}

double area(const std::array<Vec3, 4>& x) {
  double corner[3][4];
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t i = 0; i < 3; ++i) corner[i][a] = x[a][i];
  return bilinear_area(corner);
}

}  // namespace carom::quad4
