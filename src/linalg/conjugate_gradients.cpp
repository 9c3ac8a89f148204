#include "linalg/conjugate_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "parallel/threads.hpp"

namespace carom {

namespace {

std::size_t largest(std::span<const double> v) {
  const auto is_less = [](double a, double b) { return !(std::abs(b) <= std::abs(a)); };
  return static_cast<std::size_t>(std::max_element(v.begin(), v.end(), is_less) - v.begin());
}

}  // namespace

CgResult ConjugateGradients::solve(const LinearOperator& A, std::span<const double> inverse_diagonal,
                                   std::span<const double> b, std::span<double> x, double relative, double absolute,
                                   int max_iterations) {
  assert(inverse_diagonal.size() == b.size());
  const LinearOperator jacobi = [&](std::span<const double> r, std::span<double> z) {
    parallel_each(r.size(), [&](std::size_t i) { z[i] = inverse_diagonal[i] * r[i]; });
  };
  return solve(A, jacobi, b, x, relative, absolute, max_iterations);
}

CgResult ConjugateGradients::solve(const LinearOperator& A, const LinearOperator& B, std::span<const double> b,
                                   std::span<double> x, double relative, double absolute, int max_iterations) {
  const std::size_t n = b.size();
  assert(x.size() == n);
  z_.resize(n);
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
    B(r_, z_);
    const double rz = dot(r_, z_);
    if (result.iterations == max_iterations || !(rz > 0.0) || !std::isfinite(rz)) {
      result.worst = largest(x);
      return result;
    }
    const double beta = result.iterations == 0 ? 0.0 : rz / rz_old;
    parallel_each(n, [&](std::size_t i) { p_[i] = z_[i] + beta * p_[i]; });
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
