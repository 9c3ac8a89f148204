#include "linalg/csr_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

#include "parallel/threads.hpp"

namespace carom {

namespace {
constexpr std::size_t row_grain = 512;
}

void CsrMatrix::apply(std::span<const double> x, std::span<double> y) const {
  const auto rows = static_cast<std::size_t>(size);
  assert(x.size() == rows && y.size() == rows && x.data() != y.data());
  parallel_for(rows, row_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0.0;
      const auto last = static_cast<std::size_t>(row_begin[i + 1]);
      for (auto k = static_cast<std::size_t>(row_begin[i]); k < last; ++k)
        sum += value[k] * x[static_cast<std::size_t>(column[k])];
      y[i] = sum;
    }
  });
}

std::vector<double> CsrMatrix::diagonal() const {
  std::vector<double> d(static_cast<std::size_t>(size), 0.0);
  for (Index i = 0; i < size; ++i) {
    const auto row = static_cast<std::size_t>(i);
    const auto first = column.begin() + row_begin[row];
    const auto last = column.begin() + row_begin[row + 1];
    const auto found = std::lower_bound(first, last, i);
    if (found != last && *found == i) d[row] = value[static_cast<std::size_t>(found - column.begin())];
  }
  return d;
}

CsrMatrix diagonal_matrix(std::span<const double> diagonal) {
  CsrMatrix matrix;
  matrix.size = static_cast<Index>(diagonal.size());
  matrix.row_begin.resize(diagonal.size() + 1);
  std::iota(matrix.row_begin.begin(), matrix.row_begin.end(), std::int64_t{0});
  matrix.column.resize(diagonal.size());
  std::iota(matrix.column.begin(), matrix.column.end(), Index{0});
  matrix.value.assign(diagonal.begin(), diagonal.end());
  return matrix;
}

}  // namespace carom
