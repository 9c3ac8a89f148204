#include "system/tangent_factors.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

namespace carom {

void TangentFactors::go_on(Index negative) {
  negative_ = negative;
  const Method method = negative < 0 ? first_ : Method::ldlt;
  if (method != method_) has_factors_ = false;
  method_ = method;
}

std::string TangentFactors::factorize(const CsrMatrix& A) {
  has_factors_ = false;
  singular_row_ = -1;
  try {
    if (method_ == Method::cholesky) {
      try {
        if (cholesky_)
          cholesky_->factorize(A);
        else
          cholesky_.emplace(A);
      } catch (const NotPositiveDefinite&) {
        method_ = Method::ldlt;
      }
    }
    if (method_ == Method::ldlt) {
      cholesky_.reset();  // both at once may not fit
      ldlt_.factorize(A);
    }
    if (method_ != first_ && negative_ < 0) negative_ = ldlt_.negative_eigenvalues();
  } catch (const SingularMatrix& e) {
    singular_row_ = e.row;
    return e.what();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  has_factors_ = true;
  return {};
}

void TangentFactors::solve(std::span<double> b, int columns) const {
  assert(has_factors_);
  if (method_ == Method::cholesky)
    cholesky_->solve(b, columns);
  else
    ldlt_.solve(b, columns);
}

std::string TangentFactors::name(Index negative) const {
  if (first_ == Method::ldlt) return "LDL^T factorisation";
  if (negative < 0) return "Cholesky factorisation";
  return fmt::format("LDL^T factorisation since a tangent had {} negative eigenvalue{}", negative,
                     negative == 1 ? "" : "s");
}

}  // namespace carom
