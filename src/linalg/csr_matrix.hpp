// Compressed sparse rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Square sparse matrix, both triangles stored, columns sorted in each row.
struct CsrMatrix {
  Index size = 0;
  std::vector<std::int64_t> row_begin;  ///< size + 1 entries
  std::vector<Index> column;
  std::vector<double> value;

  /// y = A x; threaded over rows, same bits for any thread count.
  void apply(std::span<const double> x, std::span<double> y) const;
  /// The diagonal (0 where a row has none).
  std::vector<double> diagonal() const;
};

/// The matrix of this diagonal.
CsrMatrix diagonal_matrix(std::span<const double> diagonal);

}  // namespace carom
