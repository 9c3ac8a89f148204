#include "solid/mass.hpp"

#include <utility>

#include "parallel/threads.hpp"

namespace carom {
Mass::Mass(CsrMatrix node_matrix)
    : kind_(MassKind::consistent),
      matrix_(std::move(node_matrix)),
      diagonal_(matrix_.diagonal()),
      row_sums_(diagonal_.size(), 0.0) {
  for (std::size_t n = 0; n < row_sums_.size(); ++n)
    for (std::size_t k = at(matrix_.row_begin[n]); k < at(matrix_.row_begin[n + 1]); ++k)
      row_sums_[n] += matrix_.value[k];
}

Mass::Mass(std::vector<double> node_masses) : kind_(MassKind::lumped), diagonal_(std::move(node_masses)) {}

void Mass::add_gravity(const Vec3& acceleration, EntryRange nodes, std::span<double> f) const {
  const std::vector<double>& sums = kind_ == MassKind::lumped ? diagonal_ : row_sums_;
  for (std::size_t n = nodes.begin; n < nodes.end; ++n)
    for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] += sums[n] * acceleration[i];
}

void Mass::combine(double m, std::span<const double> x, double c, std::span<double> y, EntryRange range) const {
  for (std::size_t n = range.begin; n < range.end; ++n) {
    const Vec3 sum = at_node(n, x);
    for (std::size_t i = 0; i < 3; ++i) y[3 * n + i] = m * sum[i] + (c == 0.0 ? 0.0 : c * y[3 * n + i]);
  }
}

void Mass::combine(double m, std::span<const double> x, double c, std::span<double> y) const {
  constexpr std::size_t rows_per_task = 1024;
  parallel_for(diagonal_.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    combine(m, x, c, y, EntryRange{begin, end});
  });
}

void Mass::combine(double m, std::span<const double> x, double c, std::span<double> y, const Holding& nodes) const {
  if (kind_ == MassKind::lumped || nodes.is_whole())
    return nodes.each_range([&](std::size_t begin, std::size_t end) { combine(m, x, c, y, EntryRange{begin, end}); });
  constexpr std::size_t rows_per_task = 1024;
  const EntryRange own = own_share_of(diagonal_.size());
  parallel_for(own.size(), rows_per_task, [&](std::size_t begin, std::size_t end) {
    combine(m, x, c, y, EntryRange{own.begin + begin, own.begin + end});
  });
  nodes.update(y);
}

double Mass::total() const {
  const std::vector<double>& entries = kind_ == MassKind::lumped ? diagonal_ : matrix_.value;
  return parallel_sum(entries.size(), [&](std::size_t k) { return entries[k]; });
}

}  // namespace carom
