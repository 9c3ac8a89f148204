#include "linalg/dense.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "linalg/lapack.hpp"

namespace carom {

namespace {

/// Largest sum of |a_ij| over a stored row (the 1-norm of the matrix that LAPACK sees, the transpose); not a number
/// when an entry is not.
double largest_row_sum(const std::vector<double>& a, std::size_t n) {
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < n; ++j) sum += std::abs(a[i * n + j]);
    if (std::isnan(sum)) return sum;
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

DenseLu::DenseLu(std::vector<double> a, int n) : lu_(std::move(a)), pivot_(static_cast<std::size_t>(n)), n_(n) {
  const auto size = static_cast<std::size_t>(n);
  assert(lu_.size() == size * size);
  if (n == 0) return;
  const double norm = largest_row_sum(lu_, size);
  if (!std::isfinite(norm)) throw std::runtime_error(fmt::format("dense {0} x {0} matrix: an entry is not finite", n));
  openblas_set_num_threads(1);
  int info = 0;
  dgetrf_(&n_, &n_, lu_.data(), &n_, pivot_.data(), &info);
  double reciprocal_condition = 0.0;
  if (info == 0) {
    std::vector<double> work(4 * size);
    std::vector<int> integer_work(size);
    dgecon_("1", &n_, lu_.data(), &n_, &norm, &reciprocal_condition, work.data(), integer_work.data(), &info);
  }
  if (!(reciprocal_condition > std::numeric_limits<double>::epsilon()))
    throw std::runtime_error(
        fmt::format("dense {0} x {0} matrix: singular to working precision (reciprocal condition {1:.1e})", n,
                    reciprocal_condition));
}

void DenseLu::solve(std::span<double> b) const {
  assert(b.size() == static_cast<std::size_t>(n_));
  if (n_ == 0) return;
  const int columns = 1;
  int info = 0;
  dgetrs_("T", &n_, &columns, lu_.data(), &n_, pivot_.data(), b.data(), &n_, &info);
  assert(info == 0);
}

SymmetricEigen symmetric_eigen(std::vector<double> a, int n) {
  const auto size = static_cast<std::size_t>(n);
  assert(a.size() == size * size);
  if (n == 0) return {};
  if (!std::isfinite(largest_row_sum(a, size)))
    throw std::runtime_error(fmt::format("dense {0} x {0} matrix: an entry is not finite", n));
  openblas_set_num_threads(1);
  SymmetricEigen out{std::vector<double>(size), std::move(a)};
  std::vector<double> work(34 * size);
  const int length = static_cast<int>(work.size());
  int info = 0;
  dsyev_("V", "L", &n, out.vectors.data(), &n, out.values.data(), work.data(), &length, &info);
  if (info != 0) throw std::runtime_error(fmt::format("dense {0} x {0} matrix: no eigenvalues found", n));
  return out;
}

}  // namespace carom
