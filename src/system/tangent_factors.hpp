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
/// factored as L D L^T, which keeps the analysis of the pattern, so that a run changes its solver once at most. That it
/// has is part of the state (StageMemory::negative_eigenvalues).
class TangentFactors {
 public:
  enum class Method : std::uint8_t { cholesky, ldlt };

  explicit TangentFactors(Method first) : first_(first), method_(first) {}

  /// Number of negative eigenvalues of the first matrix so far that was not positive definite; -1: all were.
  Index negative_eigenvalues() const { return negative_; }
  /// Goes on from there; factors made by the other method are forgotten.
  void go_on(Index negative);
  /// Factors A. Returns why there are no factors, "" when there are.
  std::string factorize(const CsrMatrix& A);
  /// The row of A that the last call found to be without a pivot, and so in a motion without resistance; -1: none.
  Index singular_row() const { return singular_row_; }
  bool has_factors() const { return has_factors_; }
  /// Overwrites b by A^-1 b, column by column.
  void solve(std::span<double> b, int columns) const;
  /// L of A = L L^T where the factors are of that kind, else nullptr.
  const Cholesky* cholesky() const { return cholesky_ && has_factors_ ? &*cholesky_ : nullptr; }
  /// For the log; says how many directions of the first indefinite tangent were unstable.
  std::string name(Index negative) const;

 private:
  Method first_, method_;
  Index negative_ = -1;
  Index singular_row_ = -1;
  bool has_factors_ = false;
  std::optional<Cholesky> cholesky_;
  Ldlt ldlt_;
};

}  // namespace carom
