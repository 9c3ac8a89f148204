#include "linalg/conjugate_gradients.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace carom {

namespace {

std::size_t largest(std::span<const double> v) {
  const auto is_less = [](double a, double b) { return !(std::abs(b) <= std::abs(a)); };
  return static_cast<std::size_t>(std::max_element(v.begin(), v.end(), is_less) - v.begin());
}

}  // namespace

CgResult ConjugateGradients::solve(const LinearOperator& A, std::span<const double> inverse_diagonal,
                                   std::span<const double> b, std::span<double> x, double relative, double absolute,
                                   int max_iterations, const Entries& entries) {
  assert(inverse_diagonal.size() == b.size());
  const LinearOperator jacobi = [&](std::span<const double> r, std::span<double> z) {
    entries.each([&](std::size_t i) { z[i] = inverse_diagonal[i] * r[i]; });
  };
  return solve(A, jacobi, b, x, relative, absolute, max_iterations, entries);
}

CgResult ConjugateGradients::solve(const LinearOperator& A, const LinearOperator& B, std::span<const double> b,
                                   std::span<double> x, double relative, double absolute, int max_iterations,
                                   const Entries& entries) {
  const std::size_t n = b.size();
  assert(x.size() == n && entries.count() == n);
  z_.resize(n);
  r_.resize(n);
  p_.assign(n, 0.0);
  Ap_.resize(n);
  for (const std::span<double> v : {x, std::span<double>(r_), std::span<double>(p_)}) entries.spoil(v);

  A(x, Ap_);
  const double residual_squared = entries.sum([&](std::size_t i) {
    r_[i] = b[i] - Ap_[i];
    return r_[i] * r_[i];
  });
  const double tolerance = std::max(absolute, relative * std::sqrt(entries.dot(b, b)));
  CgResult result{0, std::sqrt(residual_squared), false};
  double rz_old = 0.0;
  while (!(result.residual <= tolerance)) {
    B(r_, z_);
    const double rz = entries.dot(r_, z_);
    if (result.iterations == max_iterations || !(rz > 0.0) || !std::isfinite(rz)) {
      entries.complete(x);
      result.worst = largest(x);
      return result;
    }
    const double beta = result.iterations == 0 ? 0.0 : rz / rz_old;
    entries.each([&](std::size_t i) { p_[i] = z_[i] + beta * p_[i]; });
    rz_old = rz;
    A(p_, Ap_);
    const double pAp = entries.dot(p_, Ap_);
    if (!(pAp > 0.0) || !std::isfinite(pAp)) {
      entries.complete(x);
      entries.complete(p_);
      result.worst = largest(p_);
      return result;
    }
    const double alpha = rz / pAp;
    result.residual = std::sqrt(entries.sum([&](std::size_t i) {
      x[i] += alpha * p_[i];
      r_[i] -= alpha * Ap_[i];
      return r_[i] * r_[i];
    }));
    ++result.iterations;
  }
  entries.complete(x);
  result.converged = true;
  return result;
}

}  // namespace carom
