#include "linalg/ldlt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "linalg/mumps.hpp"
#include "linalg/nested_dissection.hpp"

namespace carom {

namespace {

constexpr std::size_t null_pivot_threshold = 3;

}  // namespace

struct Ldlt::Impl {
  Mumps mumps{Mumps::Symmetry::symmetric};
  int analyses = 0;
  bool has_factors = false;

  Impl();
  [[noreturn]] void fail(MUMPS_INT code) const;
  /// The values in the order of the pattern, which is taken over where it is another one.
  std::vector<double> read(const CsrMatrix& A);
  void factorise(std::vector<double> value);
};

Ldlt::Impl::Impl() {
  mumps.control(Mumps::null_pivots) = 1;
  // Of matrices scaled to entries of about 1: what rounding leaves of a pivot that should vanish.
  mumps.real_control(null_pivot_threshold) = 64.0 * std::numeric_limits<double>::epsilon();
}

/// Throws what an error code of MUMPS means.
void Ldlt::Impl::fail(MUMPS_INT code) const {
  if (Mumps::is_singular(code)) {
    throw SingularMatrix(fmt::format("LDL^T factorisation: the matrix is singular to working precision (rank {} at "
                                     "most)",
                                     mumps.detail()),
                         -1);
  }
  throw std::runtime_error("LDL^T factorisation: " + mumps.reason(code));
}

std::vector<double> Ldlt::Impl::read(const CsrMatrix& A) {
  std::vector<MUMPS_INT> row, column;
  std::vector<double> value;
  for (Index i = 0; i < A.size; ++i) {
    const auto last = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i) + 1]);
    for (auto k = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i)]); k < last; ++k) {
      if (A.column[k] > i) break;
      if (!std::isfinite(A.value[k]))
        throw std::runtime_error(fmt::format("LDL^T factorisation: entry ({}, {}) is not finite", i, A.column[k]));
      row.push_back(i + 1);
      column.push_back(A.column[k] + 1);
      value.push_back(A.value[k]);
    }
  }
  if (mumps.has_pattern(A.size, row, column)) return value;
  ++analyses;
  const MUMPS_INT code = mumps.analyse(A.size, std::move(row), std::move(column), nested_dissection(A));
  if (code < 0) fail(code);
  return value;
}

void Ldlt::Impl::factorise(std::vector<double> value) {
  const MUMPS_INT code = mumps.factorise(std::move(value));
  if (code < 0) fail(code);
  if (mumps.info(Mumps::null_count) > 0) {
    const Index null_row = mumps.null_pivot();
    throw SingularMatrix(
        fmt::format("LDL^T factorisation: the matrix is singular to working precision ({} null pivots, one of row {})",
                    mumps.info(Mumps::null_count), null_row),
        null_row);
  }
  has_factors = true;
}

Ldlt::Ldlt() : impl_(std::make_unique<Impl>()) {}
Ldlt::~Ldlt() = default;
Ldlt::Ldlt(Ldlt&&) noexcept = default;
Ldlt& Ldlt::operator=(Ldlt&&) noexcept = default;

void Ldlt::factorize(const CsrMatrix& A) {
  impl_->has_factors = false;
  if (A.size == 0) return;
  impl_->factorise(impl_->read(A));
}

void Ldlt::solve(std::span<double> b, int columns) const {
  if (columns == 0 || b.empty()) return;
  assert(impl_->has_factors && columns > 0);
  assert(b.size() == static_cast<std::size_t>(impl_->mumps.size()) * static_cast<std::size_t>(columns));
  const MUMPS_INT code = impl_->mumps.solve(b.data(), columns);
  if (code < 0) throw std::runtime_error("LDL^T solve: " + impl_->mumps.reason(code));
}

Index Ldlt::negative_eigenvalues() const {
  return impl_->has_factors ? impl_->mumps.info(Mumps::negative_count) : 0;
}

double Ldlt::factor_entries() const {
  return impl_->has_factors ? impl_->mumps.count(Mumps::entries) : 0.0;
}

int Ldlt::analyses() const {
  return impl_->analyses;
}

}  // namespace carom
