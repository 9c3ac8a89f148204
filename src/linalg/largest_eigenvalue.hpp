// Largest eigenvalue of a symmetric operator by Lanczos iteration.
#pragma once

#include <cstddef>

#include "linalg/conjugate_gradients.hpp"

namespace carom {

struct EigenvalueEstimate {
  double value = 0.0;  ///< Ritz value: a lower bound of the largest eigenvalue
  double upper = 0.0;  ///< Ritz value + residual norm: above the eigenvalue the iteration has found
  int iterations = 0;
};

/// K x = lambda M x with K symmetric positive semi-definite and M symmetric positive definite. What M_inverse sets to
/// zero (fixed unknowns) stays out.
struct Pencil {
  LinearOperator K, M, M_inverse;
};

/// Largest eigenvalue of the symmetric positive semi-definite operator A by Lanczos iteration (Golub and Van
/// Loan, Matrix Computations, 4th ed., section 10.1) from a fixed pseudo-random start vector, until the residual bound
/// |beta_k s_k| is below `tolerance` times the value, not before least_iterations, or max_iterations is reached. Same
/// bits for any number of threads, and of ranks, all of which call it where they share the entries out.
EigenvalueEstimate largest_eigenvalue(const LinearOperator& A, const Entries& entries, double tolerance = 1e-3,
                                      int max_iterations = 300, int least_iterations = 1);

/// The same for K x = lambda M x, in the inner product of M (Parlett, The Symmetric Eigenvalue Problem, section 15.11).
EigenvalueEstimate largest_eigenvalue(const Pencil& pencil, const Entries& entries, double tolerance = 1e-3,
                                      int max_iterations = 300, int least_iterations = 1);

}  // namespace carom
