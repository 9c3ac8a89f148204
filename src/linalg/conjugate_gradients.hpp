// Preconditioned conjugate gradients for an operator given as a function.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "parallel/entries.hpp"

namespace carom {

/// y = A x for a symmetric operator; must not keep references to its arguments.
using LinearOperator = std::function<void(std::span<const double> x, std::span<double> y)>;

struct CgResult {
  int iterations = 0;
  double residual = 0.0;  ///< |b - A x|_2, by recurrence
  bool converged = false;
  /// Where it has not converged: the largest entry of the direction that A does not resist (breakdown), or of x, which
  /// runs away along such a direction.
  std::size_t worst = 0;
};

/// Preconditioned conjugate gradients (Saad, Iterative Methods for Sparse Linear Systems, 2nd ed., algorithm 9.1). The
/// work vectors are kept between calls: no vector is allocated after the first.
class ConjugateGradients {
 public:
  /// Solves A x = b from the start value in x until |b - A x|_2 <= max(absolute, relative |b|_2).
  /// inverse_diagonal: 1 / diag(A). Breakdown (A not positive definite, NaN) returns converged = false.
  /// Same bits for any number of threads and ranks.
  CgResult solve(const LinearOperator& A, std::span<const double> inverse_diagonal, std::span<const double> b,
                 std::span<double> x, double relative, double absolute, int max_iterations, const Entries& entries);
  CgResult solve(const LinearOperator& A, std::span<const double> inverse_diagonal, std::span<const double> b,
                 std::span<double> x, double relative, double absolute, int max_iterations) {
    return solve(A, inverse_diagonal, b, x, relative, absolute, max_iterations, b.size());
  }
  /// The same with z = B r for a symmetric positive definite B near to A^-1. Of vectors that ranks share out, A and B
  /// take and give what this one holds; x is whole on every rank at the end. All ranks call it.
  CgResult solve(const LinearOperator& A, const LinearOperator& B, std::span<const double> b, std::span<double> x,
                 double relative, double absolute, int max_iterations, const Entries& entries);

 private:
  std::vector<double> r_, p_, Ap_, z_;
};

}  // namespace carom
