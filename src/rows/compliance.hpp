// The motion of sparse dof vectors under each other's forces, through the inverse of an operator; grown as it is
// needed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "rows/inverse_operator.hpp"

namespace carom {

/// C = B^T A^-1 B for sparse dof vectors B, which come in several calls and are each solved for once. Where the inverse
/// has halves (HalfPanel), C = Y^T Y, and Y is kept for what comes later; else each vector costs a solve.
class Compliance {
 public:
  /// A function that is called with the number of the first of some columns and with A^-1 B of these, where it is made.
  using Seen = std::function<void(std::size_t first, std::span<const double> block)>;

  void forget() { cut(0); }
  /// Keeps the first `count` columns, which are those of whole calls.
  void cut(std::size_t count);
  void add(const SparseColumns& B, std::size_t dof_count, const InverseOperator& inverse, const Seen& seen = {});
  std::size_t size() const { return line_.size(); }
  double operator()(std::size_t i, std::size_t j) const {
    const Line& line = line_[std::max(i, j)];
    const std::size_t k = std::min(i, j);
    return k < line.first ? 0.0 : line.value[k - line.first];
  }
  /// Entries first ... i of row i; those before `first` are zero.
  struct Line {
    std::size_t first = 0;
    std::vector<double> value;
  };
  const Line& line(std::size_t i) const { return line_[i]; }
  /// The number of values that are kept.
  std::size_t entries() const;

 private:
  void add_halves(const SparseColumns& B, const InverseOperator& inverse);
  void add_solutions(const SparseColumns& B, std::size_t dof_count, const InverseOperator& inverse, const Seen& seen);

  std::vector<Line> line_;
  std::vector<HalfPanel> panels_;  ///< their columns numbered as those of C
  SparseColumns columns_;          ///< B, where there are no halves
};

}  // namespace carom
