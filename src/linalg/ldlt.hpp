// Sparse factorisation of symmetric indefinite matrices (MUMPS, sequential: no MPI is started or needed).
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "linalg/csr_matrix.hpp"

namespace carom {

/// What Ldlt throws for a matrix that is singular to working precision.
struct SingularMatrix : std::runtime_error {
  SingularMatrix(const std::string& what, Index a_row) : std::runtime_error(what), row(a_row) {}
  Index row;  ///< of a pivot that vanishes: an unknown that takes part in a motion without resistance; -1: not known
};

/// P A P^T = L D L^T with D of 1 x 1 and 2 x 2 pivots (multifrontal, threshold pivoting: Duff and Reid, ACM Trans.
/// Math. Softw. 9, 1983; Amestoy, Duff, L'Excellent and Koster, SIAM J. Matrix Anal. Appl. 23, 2001), for symmetric
/// matrices that Cholesky refuses: tangents beyond a limit point, saddle points. The pattern is analysed once and
/// again only when it changes.
class Ldlt {
 public:
  Ldlt();
  ~Ldlt();
  Ldlt(Ldlt&&) noexcept;
  Ldlt& operator=(Ldlt&&) noexcept;

  /// Reads the lower triangle of A. Throws SingularMatrix, or std::runtime_error when an entry is not finite or when
  /// memory runs out; there are no factors then.
  void factorize(const CsrMatrix& A);
  /// Solves A X = B in place for `columns` right-hand sides stored one after the other (column-major, n x columns).
  /// One object must not solve from several threads at once.
  void solve(std::span<double> b, int columns = 1) const;
  /// Number of negative eigenvalues of A (Sylvester's law of inertia: D has as many).
  Index negative_eigenvalues() const;
  /// Entries of L and D.
  double factor_entries() const;
  /// How often a pattern has been analysed.
  int analyses() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
