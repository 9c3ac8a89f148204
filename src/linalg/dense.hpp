// Small dense systems.
#pragma once

#include <span>
#include <vector>

namespace carom {

/// LU factorisation with partial pivoting of a dense matrix, row-major (LAPACK dgetrf / dgetrs).
class DenseLu {
 public:
  /// Throws std::runtime_error when the n x n matrix is singular to working precision.
  DenseLu(std::vector<double> a, int n);
  void solve(std::span<double> b) const;

 private:
  std::vector<double> lu_;
  std::vector<int> pivot_;
  int n_;
};

/// Eigenvalues of a symmetric matrix, increasing, and orthonormal eigenvectors: entry i of the k-th is vectors[k n +
/// i].
struct SymmetricEigen {
  std::vector<double> values, vectors;
};

/// Of the n x n matrix a (LAPACK dsyev). Throws std::runtime_error when an entry is not finite.
SymmetricEigen symmetric_eigen(std::vector<double> a, int n);

}  // namespace carom
