#include "solid/mass.hpp"

#include <numeric>
#include <utility>

#include "parallel/threads.hpp"

namespace carom {
namespace {

CsrMatrix diagonal_matrix(const std::vector<double>& diagonal) {
  CsrMatrix matrix;
  matrix.size = static_cast<Index>(diagonal.size());
  matrix.row_begin.resize(diagonal.size() + 1);
  std::iota(matrix.row_begin.begin(), matrix.row_begin.end(), std::int64_t{0});
  matrix.column.resize(diagonal.size());
  std::iota(matrix.column.begin(), matrix.column.end(), Index{0});
  matrix.value = diagonal;
  return matrix;
}

}  // namespace

Mass::Mass(MassKind kind, CsrMatrix node_matrix) : kind_(kind), matrix_(std::move(node_matrix)) {
  diagonal_.assign(static_cast<std::size_t>(matrix_.size), 0.0);
  for (std::size_t n = 0; n < diagonal_.size(); ++n)
    for (std::int64_t k = matrix_.row_begin[n]; k < matrix_.row_begin[n + 1]; ++k)
      if (static_cast<std::size_t>(matrix_.column[static_cast<std::size_t>(k)]) == n)
        diagonal_[n] = matrix_.value[static_cast<std::size_t>(k)];
  if (kind_ == MassKind::lumped) matrix_ = diagonal_matrix(diagonal_);
  row_sums_.assign(diagonal_.size(), 0.0);
  for (std::size_t n = 0; n < row_sums_.size(); ++n)
    for (std::int64_t k = matrix_.row_begin[n]; k < matrix_.row_begin[n + 1]; ++k)
      row_sums_[n] += matrix_.value[static_cast<std::size_t>(k)];
}

Mass::Mass(const std::vector<double>& node_masses) : Mass(MassKind::lumped, diagonal_matrix(node_masses)) {}

void Mass::add_gravity(const Vec3& acceleration, std::span<double> f) const {
  parallel_each(row_sums_.size(), [&](std::size_t n) {
    for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] += row_sums_[n] * acceleration[i];
  });
}

void Mass::combine(double m, std::span<const double> x, double c, std::span<double> y) const {
  constexpr std::size_t rows_per_task = 1024;
  parallel_for(diagonal_.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Vec3 sum = at_node(n, x);
      for (std::size_t i = 0; i < 3; ++i) y[3 * n + i] = m * sum[i] + (c == 0.0 ? 0.0 : c * y[3 * n + i]);
    }
  });
}

double Mass::total() const {
  return parallel_sum(matrix_.value.size(), [&](std::size_t k) { return matrix_.value[k]; });
}

}  // namespace carom
