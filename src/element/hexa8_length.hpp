// Areas of faces and the length of HEXA8 over a number type.
#pragma once

#include "element/hexa8_kernel.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp. Corners are [component][node].
namespace carom {

template <class Real>
[[gnu::always_inline]] static inline Real dot(const Real a[3], const Real b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Area of the bilinear patch through four points, by 2 x 2 Gauss points.
template <class Real>
[[gnu::always_inline]] static inline Real bilinear_area(const Real x[3][4]) {
  // x = c + xi a + eta b + xi eta d, and dx/dxi x dx/deta = a x b + xi a x d + eta d x b
  Real a[3], b[3], d[3], middle[3], along_xi[3], along_eta[3];
  for (int i = 0; i < 3; ++i) {
    a[i] = 0.25 * (x[i][1] - x[i][0] + x[i][2] - x[i][3]);
    b[i] = 0.25 * (x[i][3] - x[i][0] + x[i][2] - x[i][1]);
    d[i] = 0.25 * (x[i][0] - x[i][1] + x[i][2] - x[i][3]);
  }
  hexa8::cross(a, b, middle);
  hexa8::cross(a, d, along_xi);
  hexa8::cross(d, b, along_eta);
  // d of a parallelogram is round-off, and what it would add of the second order in it.
  constexpr double round_off = 1e-10;
  const Real flat = 4.0 * square_root(dot(middle, middle));
  const Real excess = dot(d, d) - round_off * round_off * (dot(a, a) + dot(b, b));
  if (!any_above(excess, 0.0)) return flat;
  Real sum{};
  for (const double xi : {hexa8::gauss_abscissa, -hexa8::gauss_abscissa})
    for (const double eta : {hexa8::gauss_abscissa, -hexa8::gauss_abscissa}) {
      Real normal[3];
      for (int i = 0; i < 3; ++i) normal[i] = middle[i] + xi * along_xi[i] + eta * along_eta[i];
      sum += square_root(dot(normal, normal));
    }
  return excess > 0.0 ? sum : flat;
}

/// The volume of HEXA8 in closed form (Grandy, Efficient computation of volume of hexahedral cells, UCRL-ID-128886,
/// 1997).
template <class Real>
[[gnu::always_inline]] static inline Real hexa8_volume(const Real x[3][8]) {
  constexpr int rows[3][4][2] = {
      {{3, 1}, {7, 2}, {6, 3}, {2, 0}}, {{4, 3}, {5, 7}, {6, 4}, {7, 0}}, {{1, 4}, {2, 5}, {6, 1}, {5, 0}}};
  Real sum{};
  for (const auto& row : rows) {
    Real along[3], second[3], third[3], normal[3];
    for (int i = 0; i < 3; ++i) {
      along[i] = x[i][row[0][0]] - x[i][row[0][1]] + (x[i][row[1][0]] - x[i][row[1][1]]);
      second[i] = x[i][row[2][0]] - x[i][row[2][1]];
      third[i] = x[i][row[3][0]] - x[i][row[3][1]];
    }
    hexa8::cross(second, third, normal);
    sum += dot(along, normal);
  }
  return sum * (1.0 / 12.0);
}

/// Volume over the largest face: the edge of a cube, the thickness of a plate.
template <class Real>
[[gnu::always_inline]] static inline Real hexa8_length(const Real x[3][8]) {
  constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  Real largest{};
  for (const auto& face : faces) {
    Real corner[3][4];
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 4; ++a) corner[i][a] = x[i][face[a]];
    const Real area = bilinear_area(corner);
    largest = area > largest ? area : largest;
  }
  return hexa8_volume(x) / largest;
}

}  // namespace carom
