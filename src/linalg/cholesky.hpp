// Sparse Cholesky factorisation (SuiteSparse CHOLMOD, supernodal, METIS ordering).
#pragma once

#include <memory>
#include <span>

#include "linalg/csr_matrix.hpp"

namespace carom {

/// A = L L^T of a symmetric positive definite matrix; factored once, solved many times.
class Cholesky {
 public:
  /// Throws std::runtime_error naming the row when A is not positive definite or memory runs out.
  explicit Cholesky(const CsrMatrix& A);
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Solves A X = B in place for `columns` right-hand sides stored one after the other (column-major, n x columns).
  void solve(std::span<double> b, int columns = 1) const;
  /// Entries of L.
  double factor_entries() const;
  /// Bytes of L.
  double factor_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// OpenBLAS 0.3.21 takes new processors for an old one unless OPENBLAS_CORETYPE is in the environment before the
/// library loads. If it is unset and the processor has AVX2 or AVX-512, sets it (HASWELL, SKYLAKEX), fixes the number
/// of BLAS threads to 1 (results must not depend on it) and executes the program again. To be called first in main.
void prepare_blas_environment(char** argv);

}  // namespace carom
