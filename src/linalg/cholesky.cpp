#include "linalg/cholesky.hpp"

#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "linalg/lapack.hpp"

namespace carom {

namespace {

/// The lower triangle by rows. CHOLMOD reads it as the upper triangle by columns (stype = 1).
struct LowerTriangle {
  std::vector<SuiteSparse_long> begin, column;
  std::vector<double> value;

  explicit LowerTriangle(const CsrMatrix& A);
  cholmod_sparse view();
};

LowerTriangle::LowerTriangle(const CsrMatrix& A) : begin(static_cast<std::size_t>(A.size) + 1, 0) {
  const std::size_t about_half = (A.value.size() + static_cast<std::size_t>(A.size)) / 2;
  column.reserve(about_half);
  value.reserve(about_half);
  for (Index i = 0; i < A.size; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const auto last = static_cast<std::size_t>(A.row_begin[row + 1]);
    for (auto k = static_cast<std::size_t>(A.row_begin[row]); k < last && A.column[k] <= i; ++k) {
      if (!std::isfinite(A.value[k]))
        throw std::runtime_error(fmt::format("Cholesky factorisation: entry ({}, {}) is not finite", i, A.column[k]));
      column.push_back(A.column[k]);
      value.push_back(A.value[k]);
    }
    begin[row + 1] = static_cast<SuiteSparse_long>(value.size());
  }
}

cholmod_sparse LowerTriangle::view() {
  cholmod_sparse view{};
  view.nrow = view.ncol = begin.size() - 1;
  view.nzmax = value.size();
  view.p = begin.data();
  view.i = column.data();
  view.x = value.data();
  view.stype = 1;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

std::string reason(const cholmod_common& common) {
  switch (common.status) {
    case CHOLMOD_OUT_OF_MEMORY:
      return "out of memory";
    case CHOLMOD_TOO_LARGE:
      return "the matrix is too large";
    case CHOLMOD_NOT_INSTALLED:
      return "this CHOLMOD was built without METIS";
    default:
      return fmt::format("CHOLMOD status {}", common.status);
  }
}

}  // namespace

struct Cholesky::Impl {
  cholmod_common common{};
  cholmod_factor* L = nullptr;
  // Kept between solves.
  cholmod_dense* X = nullptr;
  cholmod_dense* Y = nullptr;
  cholmod_dense* E = nullptr;

  Impl();
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void factorize(cholmod_sparse& A);
};

Cholesky::Impl::Impl() {
  cholmod_l_start(&common);
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  common.quick_return_if_not_posdef = 1;
}

Cholesky::Impl::~Impl() {
  cholmod_l_free_dense(&E, &common);
  cholmod_l_free_dense(&Y, &common);
  cholmod_l_free_dense(&X, &common);
  cholmod_l_free_factor(&L, &common);
  cholmod_l_finish(&common);
}

void Cholesky::Impl::factorize(cholmod_sparse& A) {
  L = cholmod_l_analyze(&A, &common);
  if (L == nullptr) throw std::runtime_error("Cholesky factorisation: ordering failed: " + reason(common));
  const bool done = cholmod_l_factorize(&A, L, &common) != 0;
  if (common.status == CHOLMOD_NOT_POSDEF || (done && L->minor < L->n)) {
    const SuiteSparse_long row = static_cast<const SuiteSparse_long*>(L->Perm)[L->minor];
    throw NotPositiveDefinite(
        fmt::format("Cholesky factorisation: the matrix is not positive definite (pivot of row {})", row));
  }
  if (!done) throw std::runtime_error("Cholesky factorisation failed: " + reason(common));
}

Cholesky::Cholesky(const CsrMatrix& A) : impl_(std::make_unique<Impl>()) {
  if (A.size == 0) return;
  openblas_set_num_threads(1);
  LowerTriangle lower(A);
  cholmod_sparse view = lower.view();
  impl_->factorize(view);
}

Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::solve(std::span<double> b, int columns) const {
  if (impl_->L == nullptr || columns == 0) return;
  const std::size_t n = impl_->L->n;
  assert(columns > 0 && b.size() == n * static_cast<std::size_t>(columns));
  cholmod_dense B{};
  B.nrow = B.d = n;
  B.ncol = static_cast<std::size_t>(columns);
  B.nzmax = b.size();
  B.x = b.data();
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  if (cholmod_l_solve2(CHOLMOD_A, impl_->L, &B, nullptr, &impl_->X, nullptr, &impl_->Y, &impl_->E, &impl_->common) == 0)
    throw std::runtime_error("Cholesky solve failed: " + reason(impl_->common));
  const auto* x = static_cast<const double*>(impl_->X->x);
  std::copy(x, x + b.size(), b.begin());
}

double Cholesky::factor_entries() const {
  return impl_->L == nullptr ? 0.0 : static_cast<double>(impl_->L->xsize);
}

double Cholesky::factor_bytes() const {
  if (impl_->L == nullptr) return 0.0;
  return static_cast<double>(impl_->L->xsize * sizeof(double) + impl_->L->ssize * sizeof(SuiteSparse_long));
}

}  // namespace carom
