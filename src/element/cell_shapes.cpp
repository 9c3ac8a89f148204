#include "element/cell_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "element/hexa8.hpp"
#include "element/line2.hpp"
#include "element/quad4.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

template <std::size_t n>
void add_products(const std::array<double, n>& N, double weight, NodeProducts<n>& M) {
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) M[a][b] += weight * N[a] * N[b];
}

HexaShape::Point hexa_point(const HexaShape::Nodes& x, const Vec3& xi, double weight) {
  const auto gradient = hexa8::physical_gradient(x, xi);
  HexaShape::Point point;
  point.weight = weight * gradient.det_J;
  point.det_J = gradient.det_J;
  point.gradient = gradient.dN_dX;
  return point;
}

PlaneShape::Point plane_point(const PlaneShape::Nodes& x, double xi, double eta, double weight) {
  const auto gradient = quad4::plane_gradient(x, xi, eta);
  PlaneShape::Point point;
  point.weight = weight * gradient.det_J;
  point.det_J = gradient.det_J;
  point.gradient = gradient.dN_dX;
  return point;
}

double radius(const std::array<Vec3, 4>& x, const std::array<double, 4>& N) {
  return N[0] * x[0][0] + N[1] * x[1][0] + N[2] * x[2][0] + N[3] * x[3][0];
}

AxisymmetricShape::Point axisymmetric_point(const AxisymmetricShape::Nodes& x, double xi, double eta, double weight) {
  auto point = plane_point(x, xi, eta, weight);
  const auto N = quad4::shape(xi, eta);
  const double r = radius(x, N);
  point.weight *= 2.0 * std::numbers::pi * r;
  for (std::size_t a = 0; a < 4; ++a) point.hoop[a] = N[a] / r;
  return point;
}

Vec3 gauss_2(std::size_t p) {
  const double g = hexa8::gauss_abscissa;
  return {p % 2 == 0 ? -g : g, p / 2 % 2 == 0 ? -g : g, 0.0};
}

/// integral of N_a N_b measure(N) by 3 x 3 Gauss points: exact for plane cells and with the factor x.
template <class Measure>
NodeProducts<4> quad_products(const std::array<Vec3, 4>& x, const Measure& measure) {
  NodeProducts<4> M{};
  const double g = std::sqrt(0.6);
  const double abscissa[3] = {-g, 0.0, g}, weight[3] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto N = quad4::shape(abscissa[i], abscissa[j]);
      const double det_J = quad4::plane_gradient(x, abscissa[i], abscissa[j]).det_J;
      add_products(N, weight[i] * weight[j] * det_J * measure(N), M);
    }
  return M;
}

double plane_length(const std::array<Vec3, 4>& x) {
  double longest = 0.0;
  for (std::size_t a = 0; a < 4; ++a) longest = std::max(longest, norm(subtract(x[(a + 1) % 4], x[a])));
  return quad4::area(x) / longest;
}

}  // namespace

HexaShape::Point HexaShape::point(const Nodes& x, std::size_t p, double) {
  return hexa_point(x, hexa8::gauss_2()[p].xi, hexa8::gauss_2()[p].weight);
}
HexaShape::Point HexaShape::centre(const Nodes& x, double) {
  return hexa_point(x, {}, 8.0);
}
NodeProducts<8> HexaShape::node_products(const Nodes& x, double, double density) {
  NodeProducts<8> M{};
  for (const hexa8::QuadraturePoint& point : hexa8::gauss_3())
    add_products(hexa8::shape(point.xi), density * point.weight * hexa8::physical_gradient(x, point.xi).det_J, M);
  return M;
}
double HexaShape::length(const Nodes& x) {
  return hexa8::length(x);
}

PlaneShape::Point PlaneShape::point(const Nodes& x, std::size_t p, double thickness) {
  const Vec3 xi = gauss_2(p);
  return plane_point(x, xi[0], xi[1], thickness);
}
PlaneShape::Point PlaneShape::centre(const Nodes& x, double thickness) {
  return plane_point(x, 0.0, 0.0, 4.0 * thickness);
}
NodeProducts<4> PlaneShape::node_products(const Nodes& x, double thickness, double density) {
  return quad_products(x, [&](const std::array<double, 4>&) { return density * thickness; });
}
double PlaneShape::length(const Nodes& x) {
  return plane_length(x);
}

AxisymmetricShape::Point AxisymmetricShape::point(const Nodes& x, std::size_t p, double) {
  const Vec3 xi = gauss_2(p);
  return axisymmetric_point(x, xi[0], xi[1], 1.0);
}
AxisymmetricShape::Point AxisymmetricShape::centre(const Nodes& x, double) {
  return axisymmetric_point(x, 0.0, 0.0, 4.0);
}
NodeProducts<4> AxisymmetricShape::node_products(const Nodes& x, double, double density) {
  return quad_products(x,
                       [&](const std::array<double, 4>& N) { return density * 2.0 * std::numbers::pi * radius(x, N); });
}
double AxisymmetricShape::length(const Nodes& x) {
  return plane_length(x);
}

BarShape::Point BarShape::point(const Nodes& x, std::size_t, double thickness) {
  const double L = line2::length(x);
  const Vec3 t = line2::axis(x);
  Point point;
  point.weight = thickness * L;
  point.det_J = 0.5 * L;
  point.gradient = {{{-1.0 / L, 0.0, 0.0}, {1.0 / L, 0.0, 0.0}}};
  for (std::size_t i = 0; i < 3; ++i) {
    point.frame[i][0] = t[i];
    point.frame[i][1] = point.frame[i][2] = 0.0;
  }
  return point;
}
BarShape::Point BarShape::centre(const Nodes& x, double thickness) {
  return point(x, 0, thickness);
}
NodeProducts<2> BarShape::node_products(const Nodes& x, double thickness, double density) {
  const double sixth = density * thickness * line2::length(x) / 6.0;
  return {{{2.0 * sixth, sixth}, {sixth, 2.0 * sixth}}};
}
double BarShape::length(const Nodes& x) {
  return line2::length(x);
}

double cell_length(std::span<const Vec3> x) {
  const auto of = [x]<class Shape>(Shape) {
    typename Shape::Nodes nodes;
    std::copy_n(x.begin(), Shape::nodes, nodes.begin());
    return Shape::length(nodes);
  };
  return x.size() == 8 ? of(HexaShape{}) : x.size() == 4 ? of(PlaneShape{}) : of(BarShape{});
}

}  // namespace carom
