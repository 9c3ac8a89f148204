#include "linalg/ldlt.hpp"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "linalg/lapack.hpp"
#include "linalg/nested_dissection.hpp"

namespace carom {

namespace {

enum class Job : MUMPS_INT { initialise = -1, terminate = -2, analyse = 1, factorise = 2, solve = 3 };

// Numbers of the MUMPS 5.5 users' guide, sections 5 and 6 (1-based there and here).
constexpr std::size_t ordering = 7, workspace_excess = 14, null_pivots = 24;
constexpr std::size_t null_pivot_threshold = 3;
constexpr std::size_t error_code = 1, error_detail = 2, negative_count = 12, null_count = 28, entries = 29;
constexpr MUMPS_INT given_order = 1;
constexpr MUMPS_INT communicator_of_the_dummy_mpi = -987654;
constexpr MUMPS_INT most_workspace_excess = 1000;  // per cent

/// A MUMPS count: millions where it is negative (users' guide, section 5.4).
double count(MUMPS_INT n) {
  return n >= 0 ? n : -1e6 * n;
}

bool lacks_workspace(MUMPS_INT code) {
  return code == -8 || code == -9 || code == -14 || code == -15 || code == -17 || code == -20;
}

std::string reason(MUMPS_INT code, MUMPS_INT detail) {
  switch (code) {
    case -5:
    case -7:
    case -13:
    case -19:
    case -22:
      return fmt::format("out of memory ({:.3g} numbers more were asked for); use fewer cells or solver \"cg\"",
                         count(detail));
    default:
      if (lacks_workspace(code)) return "out of memory: the pivots need far more workspace than foreseen";
      return fmt::format("MUMPS error {}, detail {}", code, detail);
  }
}

/// Throws what an error code of MUMPS means.
[[noreturn]] void fail(MUMPS_INT code, MUMPS_INT detail) {
  if (code == -6 || code == -10) {
    throw SingularMatrix(
        fmt::format("LDL^T factorisation: the matrix is singular to working precision (rank {} at most)", detail), -1);
  }
  throw std::runtime_error("LDL^T factorisation: " + reason(code, detail));
}

}  // namespace

struct Ldlt::Impl {
  DMUMPS_STRUC_C mumps{};
  Index size = 0;
  std::vector<MUMPS_INT> row, column;  ///< lower triangle, 1-based
  std::vector<double> value;
  std::vector<MUMPS_INT> place;  ///< of each row in the order of elimination, 1-based
  int analyses = 0;
  bool has_factors = false;

  Impl();
  ~Impl() { call(Job::terminate); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  MUMPS_INT& control(std::size_t i) { return mumps.icntl[i - 1]; }
  MUMPS_INT info(std::size_t i) const { return mumps.infog[i - 1]; }
  MUMPS_INT call(Job job) {
    mumps.job = static_cast<MUMPS_INT>(job);
    dmumps_c(&mumps);
    return info(error_code);
  }
  void read(const CsrMatrix& A);
  void analyse(const CsrMatrix& A);
  void factorise();
};

Ldlt::Impl::Impl() {
  mumps.par = 1;
  mumps.sym = 2;  // symmetric, not known to be definite
  mumps.comm_fortran = communicator_of_the_dummy_mpi;
  call(Job::initialise);
  for (std::size_t stream = 1; stream <= 3; ++stream) control(stream) = -1;  // no output, errors included
  control(4) = 0;
  control(ordering) = given_order;
  control(null_pivots) = 1;
  // Of matrices scaled to entries of about 1: what rounding leaves of a pivot that should vanish.
  mumps.cntl[null_pivot_threshold - 1] = 64.0 * std::numeric_limits<double>::epsilon();
}

/// Takes over the values, and the pattern too where it is another one.
void Ldlt::Impl::read(const CsrMatrix& A) {
  std::vector<MUMPS_INT> new_row, new_column;
  new_row.reserve(row.size());
  new_column.reserve(column.size());
  value.clear();
  for (Index i = 0; i < A.size; ++i) {
    const auto last = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i) + 1]);
    for (auto k = static_cast<std::size_t>(A.row_begin[static_cast<std::size_t>(i)]); k < last; ++k) {
      if (A.column[k] > i) break;
      if (!std::isfinite(A.value[k]))
        throw std::runtime_error(fmt::format("LDL^T factorisation: entry ({}, {}) is not finite", i, A.column[k]));
      new_row.push_back(i + 1);
      new_column.push_back(A.column[k] + 1);
      value.push_back(A.value[k]);
    }
  }
  mumps.a = value.data();
  if (size == A.size && new_row == row && new_column == column) return;
  size = A.size;
  row = std::move(new_row);
  column = std::move(new_column);
  analyse(A);
}

void Ldlt::Impl::analyse(const CsrMatrix& A) {
  ++analyses;
  const std::vector<Index> order = nested_dissection(A);
  place.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[static_cast<std::size_t>(order[k])] = static_cast<int>(k) + 1;
  mumps.n = A.size;
  mumps.nnz = static_cast<MUMPS_INT8>(value.size());
  mumps.irn = row.data();
  mumps.jcn = column.data();
  mumps.perm_in = place.data();
  const MUMPS_INT code = call(Job::analyse);
  if (code >= 0) return;
  size = 0;  // no pattern has been analysed
  fail(code, info(error_detail));
}

/// Pivots that are postponed for stability take workspace that the analysis could not foresee.
void Ldlt::Impl::factorise() {
  MUMPS_INT code = call(Job::factorise);
  while (lacks_workspace(code) && control(workspace_excess) < most_workspace_excess) {
    control(workspace_excess) *= 2;
    code = call(Job::factorise);
  }
  if (code < 0) fail(code, info(error_detail));
  if (info(null_count) > 0) {
    const Index null_row = mumps.pivnul_list[0] - 1;
    throw SingularMatrix(
        fmt::format("LDL^T factorisation: the matrix is singular to working precision ({} null pivots, one of row {})",
                    info(null_count), null_row),
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
  openblas_set_num_threads(1);
  impl_->read(A);
  impl_->factorise();
}

void Ldlt::solve(std::span<double> b, int columns) const {
  if (columns == 0 || b.empty()) return;
  assert(impl_->has_factors && columns > 0);
  assert(b.size() == static_cast<std::size_t>(impl_->size) * static_cast<std::size_t>(columns));
  impl_->mumps.rhs = b.data();
  impl_->mumps.nrhs = columns;
  impl_->mumps.lrhs = impl_->size;
  const MUMPS_INT code = impl_->call(Job::solve);
  if (code < 0) throw std::runtime_error("LDL^T solve: " + reason(code, impl_->info(error_detail)));
}

Index Ldlt::negative_eigenvalues() const {
  return impl_->has_factors ? impl_->info(negative_count) : 0;
}

double Ldlt::factor_entries() const {
  return impl_->has_factors ? count(impl_->info(entries)) : 0.0;
}

int Ldlt::analyses() const {
  return impl_->analyses;
}

}  // namespace carom
