#include "element/hexa8.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "element/hexa8_length.hpp"
#include "math/vec3.hpp"

namespace carom::hexa8 {
namespace {

template <std::size_t n>
std::array<QuadraturePoint, n * n * n> product_rule(const std::array<double, n>& xi, const std::array<double, n>& w) {
  std::array<QuadraturePoint, n * n * n> rule{};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i < n; ++i) rule[i + n * (j + n * k)] = {{xi[i], xi[j], xi[k]}, w[i] * w[j] * w[k]};
  return rule;
}

}  // namespace

const std::array<QuadraturePoint, 8>& gauss_2() {
  static const double g = 1.0 / std::sqrt(3.0);
  static const auto rule = product_rule<2>({-g, g}, {1.0, 1.0});
  return rule;
}

const std::array<QuadraturePoint, 27>& gauss_3() {
  static const double g = std::sqrt(0.6);
  static const auto rule = product_rule<3>({-g, 0.0, g}, {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0});
  return rule;
}

std::array<double, 8> shape(const Vec3& xi) {
  std::array<double, 8> N{};
  for (std::size_t a = 0; a < 8; ++a) {
    const Vec3& p = node_position[a];
    N[a] = 0.125 * (1.0 + xi[0] * p[0]) * (1.0 + xi[1] * p[1]) * (1.0 + xi[2] * p[2]);
  }
  return N;
}

std::array<Vec3, 8> shape_gradient(const Vec3& xi) {
  std::array<Vec3, 8> dN{};
  for (std::size_t a = 0; a < 8; ++a) {
    const Vec3& p = node_position[a];
    const double x = 1.0 + xi[0] * p[0], y = 1.0 + xi[1] * p[1], z = 1.0 + xi[2] * p[2];
    dN[a] = {0.125 * p[0] * y * z, 0.125 * x * p[1] * z, 0.125 * x * y * p[2]};
  }
  return dN;
}

PhysicalGradient physical_gradient(const std::array<Vec3, 8>& x, const Vec3& xi) {
  const auto dN = shape_gradient(xi);
  std::array<Vec3, 3> g{};  // g[k][i] = dX_i / dxi_k
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) g[k][i] += dN[a][k] * x[a][i];
  const std::array<Vec3, 3> cofactor{carom::cross(g[1], g[2]), carom::cross(g[2], g[0]), carom::cross(g[0], g[1])};
  PhysicalGradient result;
  result.det_J = dot(g[0], cofactor[0]);
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t j = 0; j < 3; ++j)
      result.dN_dX[a][j] =
          (dN[a][0] * cofactor[0][j] + dN[a][1] * cofactor[1][j] + dN[a][2] * cofactor[2][j]) / result.det_J;
  return result;
}

Volume volume(const std::array<Vec3, 8>& x) {
  Volume result{0.0, std::numeric_limits<double>::infinity()};
  for (const QuadraturePoint& point : gauss_2()) {
    const double det_J = physical_gradient(x, point.xi).det_J;
    result.volume += point.weight * det_J;
    result.smallest_det_J = std::min(result.smallest_det_J, det_J);
  }
  return result;
}

namespace {

template <std::size_t nodes>
void by_component(const std::array<Vec3, nodes>& x, double (&out)[3][nodes]) {
  for (std::size_t a = 0; a < nodes; ++a)
    for (std::size_t i = 0; i < 3; ++i) out[i][a] = x[a][i];
}

}  // namespace

double exact_volume(const std::array<Vec3, 8>& x) {
  double corner[3][8];
  by_component(x, corner);
  return hexa8_volume(corner);
}

double length(const std::array<Vec3, 8>& x) {
  double corner[3][8];
  by_component(x, corner);
  return hexa8_length(corner);
}

}  // namespace carom::hexa8
