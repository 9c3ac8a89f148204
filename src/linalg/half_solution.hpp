// L^-1 B of a factor L L^T and sparse columns B, kept where it is not zero.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Sparse vectors, one after the other.
struct SparseColumns {
  std::vector<std::size_t> begin{0};
  std::vector<Index> row;
  std::vector<double> value;

  std::size_t size() const { return begin.size() - 1; }
  void add_entry(Index i, double v) {
    row.push_back(i);
    value.push_back(v);
  }
  /// What has been added since the last call is a column.
  void end_column() { begin.push_back(row.size()); }
};

/// Some columns of Y = L^-1 B on the supernodes that the rows of these columns lead to in the elimination tree: a
/// column of the inverse needs no others (Gilbert, SIAM J. Matrix Anal. Appl. 15, 1994). So
///   B^T A^-1 B = Y^T Y
/// costs half a solve per column, on the way from its rows to the root.
struct HalfPanel {
  std::vector<std::size_t> column;  ///< numbers of the columns, in the order of the panel
  std::vector<Index> supernode;     ///< ascending
  std::vector<std::size_t> begin;   ///< first row of each supernode in `value`; one more entry than supernodes
  std::vector<double> value;        ///< column-major, begin.back() rows

  std::size_t rows() const { return begin.back(); }
};

/// Adds A^T B, row-major with `stride` entries a row, to C: row i is column i of A.
void add_product(const HalfPanel& A, const HalfPanel& B, std::size_t stride, std::span<double> C);

}  // namespace carom
