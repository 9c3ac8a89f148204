// Sparse Cholesky factorisation (SuiteSparse CHOLMOD, supernodal, METIS ordering).
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "linalg/csr_matrix.hpp"
#include "linalg/half_solution.hpp"

namespace carom {

/// What Cholesky throws for a matrix that has no such factors.
struct NotPositiveDefinite : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A = L L^T of a symmetric positive definite matrix; factored once, solved many times.
class Cholesky {
 public:
  /// Reads the lower triangle of A. Throws NotPositiveDefinite (names the 0-based row), std::runtime_error when an
  /// entry is not finite or when memory runs out.
  explicit Cholesky(const CsrMatrix& A);
  /// Factors another matrix in the place of the last; ordering and analysis are made anew only for another pattern.
  void factorize(const CsrMatrix& A);
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Solves A X = B in place for `columns` right-hand sides stored one after the other (column-major, n x columns).
  /// The workspace is kept between calls, so one object must not solve from several threads at once.
  void solve(std::span<double> b, int columns = 1) const;
  /// L^-1 P B, P the ordering. Columns whose rows are eliminated one after the other share a panel. Not from several
  /// threads at once.
  std::vector<HalfPanel> half_solve(const SparseColumns& B) const;
  /// Entries of L.
  double factor_entries() const;
  /// Bytes of L.
  double factor_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
