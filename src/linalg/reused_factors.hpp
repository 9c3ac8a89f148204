// Systems that come one after the other and are much alike: the factors of one serve the next.
#pragma once

#include <cstddef>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "linalg/conjugate_gradients.hpp"
#include "linalg/csr_matrix.hpp"
#include "linalg/dense.hpp"
#include "linalg/sparse_lu.hpp"

namespace carom {

/// Factors of a dense or a sparse system whose unknowns have names (numbers). Other systems, over some of these
/// unknowns and others, are solved by GMRES with them: k unknowns that came, went, or obey another equation change the
/// matrix by a rank of 2 k at most, and cost as many iterations of a few n^2 operations; a factorisation costs 2/3 n^3.
class ReusedFactors {
 public:
  /// Solves A x = b by the factors there are until |b - A x|_2 is about relative |b|_2, at most ten times that; false
  /// where there are none, where they do not get there, or where to make others is expected to cost less. Unknowns that
  /// the factors do not have are to have a diagonal near 1.
  bool solve(std::span<const std::size_t> unknowns, const LinearOperator& A, std::span<const double> b,
             std::span<double> x, double relative) const;
  /// Makes the factors of the matrix a (row-major) and solves a x = b. False, and no factors, where it is singular.
  bool factor(std::span<const std::size_t> unknowns, std::vector<double> a, std::span<const double> b,
              std::span<double> x);
  /// The same of a sparse matrix, eliminated in this order (SparseLu).
  bool factor(std::span<const std::size_t> unknowns, const CsrMatrix& a, const std::vector<Index>& order,
              std::span<const double> b, std::span<double> x);
  void forget() { factors_ = {}; }

 private:
  template <class Factors, class... Matrix>
  bool make(std::span<const std::size_t> unknowns, std::span<const double> b, std::span<double> x, Matrix&&... matrix);
  void substitute(std::span<double> b) const;

  std::unordered_map<std::size_t, std::size_t> place_;  ///< of each unknown in the factors
  std::variant<std::monostate, DenseLu, SparseLu> factors_;
};

}  // namespace carom
