// Factors of the operator of implicit steps: Cholesky while it is positive definite, L D L^T where it is not.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "linalg/cholesky.hpp"
#include "linalg/ldlt.hpp"

namespace carom {

/// A tangent beyond a limit or bifurcation point is regular but indefinite. From the first such matrix on all are
/// factored as L D L^T, which keeps the analysis of the pattern, so that a run changes its solver once at most.
class TangentFactors {
 public:
  enum class Method : std::uint8_t { cholesky, ldlt };

  explicit TangentFactors(Method first) : first_(first), method_(first) {}

  /// Factors A. Returns why there are no factors, "" when there are.
  std::string factorize(const CsrMatrix& A);
  /// The row of A that the last call found to be without a pivot, and so in a motion without resistance; -1: none.
  Index singular_row() const { return singular_row_; }
  bool has_factors() const { return has_factors_; }
  /// Overwrites b by A^-1 b, column by column.
  void solve(std::span<double> b, int columns) const;
  /// For the log; says how many directions of the first indefinite tangent were unstable.
  std::string name() const;

 private:
  Method first_, method_;
  Index negative_ = 0;  ///< eigenvalues of the first matrix that was not positive definite
  Index singular_row_ = -1;
  bool has_factors_ = false;
  std::optional<Cholesky> cholesky_;
  Ldlt ldlt_;
};

}  // namespace carom
