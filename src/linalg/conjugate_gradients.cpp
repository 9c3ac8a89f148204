#include "linalg/conjugate_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "parallel/threads.hpp"

namespace carom {

namespace {

/// r . D^-1 r
double preconditioned_square(std::span<const double> r, std::span<const double> inverse_diagonal) {
  return parallel_sum(r.size(), [&](std::size_t i) { return r[i] * inverse_diagonal[i] * r[i]; });
}

std::size_t largest(std::span<const double> v) {
  const auto is_less = [](double a, double b) { return !(std::abs(b) <= std::abs(a)); };
  return static_cast<std::size_t>(std::max_element(v.begin(), v.end(), is_less) - v.begin());
}

/// p = D^-1 r + beta p
void update_direction(std::span<const double> r, std::span<const double> inverse_diagonal, double beta,
                      std::span<double> p) {
  parallel_for(r.size(), vector_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) p[i] = inverse_diagonal[i] * r[i] + beta * p[i];
  });
}

}  // namespace

CgResult ConjugateGradients::solve(const LinearOperator& A, std::span<const double> inverse_diagonal,
                                   std::span<const double> b, std::span<double> x, double relative, double absolute,
                                   int max_iterations) {
  const std::size_t n = b.size();
  assert(x.size() == n && inverse_diagonal.size() == n);
  r_.resize(n);
  p_.assign(n, 0.0);
  Ap_.resize(n);

  A(x, Ap_);
  const double residual_squared = parallel_sum(n, [&](std::size_t i) {
    r_[i] = b[i] - Ap_[i];
    return r_[i] * r_[i];
  });
  const double tolerance = std::max(absolute, relative * std::sqrt(dot(b, b)));
  CgResult result{0, std::sqrt(residual_squared), false};
  double rz_old = 0.0;
  while (!(result.residual <= tolerance)) {
    const double rz = preconditioned_square(r_, inverse_diagonal);
    if (result.iterations == max_iterations || !(rz > 0.0) || !std::isfinite(rz)) {
      result.worst = largest(x);
      return result;
    }
    update_direction(r_, inverse_diagonal, result.iterations == 0 ? 0.0 : rz / rz_old, p_);
    rz_old = rz;
    A(p_, Ap_);
    const double pAp = dot(p_, Ap_);
    if (!(pAp > 0.0) || !std::isfinite(pAp)) {
      result.worst = largest(p_);
      return result;
    }
    const double alpha = rz / pAp;
    result.residual = std::sqrt(parallel_sum(n, [&](std::size_t i) {
      x[i] += alpha * p_[i];
      r_[i] -= alpha * Ap_[i];
      return r_[i] * r_[i];
    }));
    ++result.iterations;
  }
  result.converged = true;
  return result;
}

}  // namespace carom
