#include "linalg/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "parallel/threads.hpp"

namespace carom {

namespace {

void add_multiple(std::span<double> y, double factor, std::span<const double> x) {
  parallel_each(y.size(), [&](std::size_t i) { y[i] += factor * x[i]; });
}

}  // namespace

bool gmres(const LinearOperator& A, const Preconditioner& precondition, std::span<const double> b, std::span<double> x,
           double relative, int most) {
  const std::size_t n = b.size();
  const double start = std::sqrt(dot(b, b)), enough = relative * start;
  std::fill(x.begin(), x.end(), 0.0);
  if (start == 0.0) return true;
  std::vector<std::vector<double>> basis(1, {b.begin(), b.end()}), column;  // of the Krylov space, and of R
  for (double& entry : basis[0]) entry /= start;
  std::vector<double> cosine, sine, g{start}, z(n);
  double residual = start;
  for (int k = 0; k < most && residual > enough; ++k) {
    z = basis.back();
    precondition(z);
    std::vector<double> w(n), h;
    A(z, w);
    for (const std::vector<double>& v : basis) {
      h.push_back(dot(v, w));
      add_multiple(w, -h.back(), v);
    }
    const double length = std::sqrt(dot(w, w));
    for (std::size_t j = 0; j < cosine.size(); ++j) {
      const double turned = cosine[j] * h[j] + sine[j] * h[j + 1];
      h[j + 1] = cosine[j] * h[j + 1] - sine[j] * h[j];
      h[j] = turned;
    }
    const double diagonal = std::hypot(h.back(), length);
    if (!(diagonal > 0.0) || !std::isfinite(diagonal)) return false;
    cosine.push_back(h.back() / diagonal);
    sine.push_back(length / diagonal);
    h.back() = diagonal;
    g.push_back(-sine.back() * g.back());
    g[g.size() - 2] *= cosine.back();
    column.push_back(std::move(h));
    residual = std::abs(g.back());
    if (k >= most / 2 && residual > 0.1 * start) return false;  // not a digit: this is another system
    if (length > 0.0) {
      for (double& entry : w) entry /= length;
    }
    basis.push_back(std::move(w));
  }
  if (residual > enough) return false;
  std::fill(z.begin(), z.end(), 0.0);
  for (std::size_t k = column.size(); k-- > 0;) {
    const double y = g[k] / column[k][k];
    for (std::size_t j = 0; j < k; ++j) g[j] -= y * column[k][j];
    add_multiple(z, y, basis[k]);
  }
  precondition(z);
  std::copy(z.begin(), z.end(), x.begin());
  // Rounding: a nearly singular preconditioner makes z far larger than x, and the recurrence does not see what is lost.
  std::vector<double> Ax(n);
  A(x, Ax);
  for (std::size_t i = 0; i < n; ++i) Ax[i] -= b[i];
  constexpr double margin = 10.0;
  return std::sqrt(dot(Ax, Ax)) <= margin * enough;
}

}  // namespace carom
