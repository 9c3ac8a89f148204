// Shape functions, quadrature and faces of HEXA8 and QUAD4.
#include "element/hexa8.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "element/quad4.hpp"

namespace carom::element_hexa8_test {
namespace {

constexpr double round_off = 1e-14;  // a few operations on numbers near 1

std::array<Vec3, 8> distorted_cell(unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> move(-0.2, 0.2);
  std::array<Vec3, 8> x = hexa8::node_position;
  for (Vec3& node : x)
    for (double& component : node) component += move(generator);
  return x;
}

TEST(Hexa8, ShapeFunctionsAreOneAtTheirNode) {
  for (std::size_t a = 0; a < 8; ++a) {
    const auto N = hexa8::shape(hexa8::node_position[a]);
    for (std::size_t b = 0; b < 8; ++b) EXPECT_EQ(N[b], a == b ? 1.0 : 0.0);
  }
}

TEST(Hexa8, GradientsAreTheDerivatives) {
  const Vec3 xi{0.3, -0.5, 0.7};
  const double h = 0.25;  // N is linear in each parent coordinate: the difference is exact for any h
  const auto gradient = hexa8::shape_gradient(xi);
  for (std::size_t k = 0; k < 3; ++k) {
    Vec3 plus = xi, minus = xi;
    plus[k] += h;
    minus[k] -= h;
    const auto up = hexa8::shape(plus), down = hexa8::shape(minus);
    for (std::size_t a = 0; a < 8; ++a) EXPECT_NEAR(gradient[a][k], (up[a] - down[a]) / (2 * h), round_off);
  }
}

// A linear field has its gradient at every point of a distorted cell (isoparametric completeness).
TEST(Hexa8, PhysicalGradientOfALinearField) {
  const auto x = distorted_cell(4);
  const Vec3 slope{1.5, -2.0, 0.5};
  for (const auto& point : hexa8::gauss_3()) {
    const auto g = hexa8::physical_gradient(x, point.xi);
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0.0;
      for (std::size_t a = 0; a < 8; ++a)
        sum += g.dN_dX[a][j] * (slope[0] * x[a][0] + slope[1] * x[a][1] + slope[2] * x[a][2]);
      EXPECT_NEAR(sum, slope[j], 100 * round_off);
    }
  }
}

/// integral over [-1, 1] of x^n
double moment(int n) {
  return n % 2 == 1 ? 0.0 : 2.0 / (n + 1);
}

template <std::size_t n>
void expect_exact_to_degree(const std::array<hexa8::QuadraturePoint, n>& rule, int degree) {
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j)
      for (int k = 0; k <= degree; ++k) {
        double sum = 0.0;
        for (const auto& p : rule) sum += p.weight * std::pow(p.xi[0], i) * std::pow(p.xi[1], j) * std::pow(p.xi[2], k);
        EXPECT_NEAR(sum, moment(i) * moment(j) * moment(k), 10 * round_off) << i << j << k;
      }
}

TEST(Hexa8, GaussRulesAreExactToTheirDegree) {
  expect_exact_to_degree(hexa8::gauss_2(), 3);
  expect_exact_to_degree(hexa8::gauss_3(), 5);
}

// Divergence theorem: the volume is a third of the integral of x . n over the six faces, whose node order must
// therefore give outward normals.
TEST(Hexa8, FacesEncloseTheVolume) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto x = distorted_cell(seed);
    double flux = 0.0;
    for (const auto& face : hexa8::faces) {
      std::array<Vec3, 4> corner{};
      for (std::size_t a = 0; a < 4; ++a) corner[a] = x[static_cast<std::size_t>(face[a])];
      for (const auto& point : quad4::face_points(corner))
        for (std::size_t a = 0; a < 4; ++a)
          for (std::size_t i = 0; i < 3; ++i) flux += point.N[a] * corner[a][i] * point.normal_dA[i] / 3.0;
    }
    EXPECT_NEAR(hexa8::volume(x).volume, flux, 100 * round_off);
    EXPECT_NEAR(hexa8::exact_volume(x), flux, 100 * round_off);
    EXPECT_GT(hexa8::volume(x).smallest_det_J, 0.0);
  }
}

TEST(Hexa8, AreaOfAWarpedFaceIsThatOfItsGaussPoints) {
  const auto x = distorted_cell(4U);
  for (const auto& face : hexa8::faces) {
    std::array<Vec3, 4> corner{};
    for (std::size_t a = 0; a < 4; ++a) corner[a] = x[static_cast<std::size_t>(face[a])];
    double area = 0.0;
    for (const auto& point : quad4::face_points(corner))
      area += std::hypot(point.normal_dA[0], point.normal_dA[1], point.normal_dA[2]);
    EXPECT_NEAR(quad4::area(corner), area, 10 * round_off);
  }
}

TEST(Hexa8, LengthIsTheThicknessOfAPlate) {
  std::array<Vec3, 8> x = hexa8::node_position;
  for (Vec3& node : x) node = {1.5 * node[0], 2.0 * node[1], 0.05 * node[2]};  // 3 x 4 x 0.1
  EXPECT_NEAR(hexa8::length(x), 0.1, round_off);
  EXPECT_NEAR(hexa8::volume(x).volume, 1.2, round_off);
}

TEST(Hexa8, ATurnedCellHasANegativeDeterminant) {
  auto x = hexa8::node_position;
  for (std::size_t a = 0; a < 4; ++a) std::swap(x[a], x[a + 4]);
  EXPECT_NEAR(hexa8::volume(x).volume, -8.0, round_off);
  EXPECT_NEAR(hexa8::volume(x).smallest_det_J, -1.0, round_off);
}

}  // namespace
}  // namespace carom::element_hexa8_test
