// Sparse factorisation of general matrices with a symmetric pattern (MUMPS, sequential).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linalg/csr_matrix.hpp"

namespace carom {

/// P A P^T = L U with pivots chosen within the fronts (multifrontal, threshold pivoting: Amestoy, Duff, L'Excellent and
/// Koster, SIAM J. Matrix Anal. Appl. 23, 2001). Entries that vanish are part of the pattern, which is to be symmetric.
class SparseLu {
 public:
  /// order: of elimination, 0-based (nested_dissection). Throws std::runtime_error when A is singular to working
  /// precision, an entry is not finite, or memory runs out.
  SparseLu(const CsrMatrix& A, const std::vector<Index>& order);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// b = A^-1 b. One object must not solve from several threads at once.
  void solve(std::span<double> b) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
