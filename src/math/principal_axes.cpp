#include "math/principal_axes.hpp"

#include <cmath>
#include <limits>

namespace carom {

PrincipalAxes principal_axes(const Vec3& diagonal, const Vec3& off) {
  double A[3][3] = {{diagonal[0], off[0], off[2]}, {off[0], diagonal[1], off[1]}, {off[2], off[1], diagonal[2]}};
  PrincipalAxes out{{}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  constexpr int most_sweeps = 50;  // some six suffice
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    const double rest = std::hypot(A[0][1], A[1][2], A[0][2]);
    const double size = std::hypot(A[0][0], A[1][1], A[2][2]);
    if (rest <= std::numeric_limits<double>::epsilon() * size) break;
    for (std::size_t p = 0; p < 3; ++p) {
      const std::size_t q = (p + 1) % 3, r = (p + 2) % 3;
      if (A[p][q] == 0.0) continue;
      const double tau = (A[q][q] - A[p][p]) / (2.0 * A[p][q]);
      const double t = (tau >= 0.0 ? 1.0 : -1.0) / (std::abs(tau) + std::hypot(1.0, tau));
      const double c = 1.0 / std::hypot(1.0, t), s = t * c;
      A[p][p] -= t * A[p][q];
      A[q][q] += t * A[p][q];
      A[p][q] = A[q][p] = 0.0;
      const double rp = A[r][p], rq = A[r][q];
      A[r][p] = A[p][r] = c * rp - s * rq;
      A[r][q] = A[q][r] = s * rp + c * rq;
      const Vec3 e = out.axes[p], f = out.axes[q];
      for (std::size_t k = 0; k < 3; ++k) {
        out.axes[p][k] = c * e[k] - s * f[k];
        out.axes[q][k] = s * e[k] + c * f[k];
      }
    }
  }
  out.values = {A[0][0], A[1][1], A[2][2]};
  return out;
}

}  // namespace carom
