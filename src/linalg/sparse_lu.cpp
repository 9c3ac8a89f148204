#include "linalg/sparse_lu.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "linalg/mumps.hpp"

namespace carom {

struct SparseLu::Impl {
  Mumps mumps{Mumps::Symmetry::general};
};

SparseLu::SparseLu(const CsrMatrix& A, const std::vector<Index>& order) : impl_(std::make_unique<Impl>()) {
  if (A.size == 0) return;
  constexpr std::size_t column_permutation = 6;  // would spoil the given order
  Mumps& mumps = impl_->mumps;
  mumps.control(column_permutation) = 0;
  std::vector<MUMPS_INT> row, column;
  row.reserve(A.value.size());
  column.reserve(A.value.size());
  for (Index i = 0; i < A.size; ++i) {
    const auto last = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i) + 1]);
    for (auto k = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i)]); k < last; ++k) {
      if (!std::isfinite(A.value[k]))
        throw std::runtime_error(fmt::format("LU factorisation: entry ({}, {}) is not finite", i, A.column[k]));
      row.push_back(i + 1);
      column.push_back(A.column[k] + 1);
    }
  }
  MUMPS_INT code = mumps.analyse(A.size, std::move(row), std::move(column), order);
  if (code == 0) code = mumps.factorise(A.value);
  if (Mumps::is_singular(code))
    throw std::runtime_error("LU factorisation: the matrix is singular to working precision");
  if (code < 0) throw std::runtime_error("LU factorisation: " + mumps.reason(code));
}

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

void SparseLu::solve(std::span<double> b) const {
  if (b.empty()) return;
  assert(b.size() == static_cast<std::size_t>(impl_->mumps.size()));
  const MUMPS_INT code = impl_->mumps.solve(b.data(), 1);
  if (code < 0) throw std::runtime_error("LU solve: " + impl_->mumps.reason(code));
}

}  // namespace carom
