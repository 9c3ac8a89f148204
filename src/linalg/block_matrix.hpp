// Sparse matrices of 3 x 3 blocks, and interpolation between the points that their rows stand for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "linalg/csr_matrix.hpp"
#include "parallel/ranks.hpp"

namespace carom {

/// Square, both triangles stored, columns sorted in each row; vectors have x y z of a point together.
struct BlockMatrix {
  std::vector<std::int64_t> row_begin{0};  ///< points + 1 entries
  std::vector<Index> column;
  std::vector<double> value;  ///< entry (i, j) of block k at [9 k + 3 i + j]
  std::vector<float> single;  ///< those of a matrix that is only applied, instead

  /// Of this graph, all zero; neighbours: those of each point, sorted.
  static BlockMatrix with_graph(const std::vector<std::vector<Index>>& neighbours);

  std::size_t points() const { return row_begin.size() - 1; }
  /// The block of a pair of neighbours.
  double* block(Index row, Index col) { return value.data() + 9 * place(row, col); }
  /// The same of a matrix in single precision.
  float* single_block(Index row, Index col) { return single.data() + 9 * place(row, col); }
  /// y = A x, at the points of the range alone; threaded, same bits for any thread count.
  void apply(std::span<const double> x, std::span<double> y, EntryRange range) const;
  void apply(std::span<const double> x, std::span<double> y) const { apply(x, y, {0, points()}); }
  /// Keeps the entries in single precision, half the memory to go through, for apply() and nothing else.
  void round_to_single();
  /// One entry per unknown.
  std::vector<double> diagonal() const;

 private:
  std::ptrdiff_t place(Index row, Index col) const;
};

/// The pairs of points that a sparse matrix couples.
class PointGraph {
 public:
  explicit PointGraph(std::size_t points) : neighbours_(points) {}
  /// All pairs of these points.
  void couple(std::span<const Index> points);
  /// All pairs of one of each.
  void couple(std::span<const Index> rows, std::span<const Index> columns);
  /// The matrix with these entries, all zero.
  BlockMatrix matrix() const { return BlockMatrix::with_graph(neighbours_); }

 private:
  std::vector<std::vector<Index>> neighbours_;
};

/// A + B, of the same size.
BlockMatrix sum(const BlockMatrix& A, const BlockMatrix& B);
/// The same matrix by rows of unknowns.
CsrMatrix by_unknowns(const BlockMatrix& A);
/// The same matrix by points; A has whole blocks.
BlockMatrix by_points(const CsrMatrix& A);

/// u_n = sum over the coarse points I of a fine point n of w_nI U_I, the same for all three components.
class Interpolation {
 public:
  /// Appends a fine point.
  void add_point(std::span<const Index> coarse, std::span<const double> weights);
  /// The last point has been added; coarse points number 0 to coarse_points - 1.
  void finish(std::size_t coarse_points);

  std::size_t fine_points() const { return begin_.size() - 1; }
  std::size_t coarse_points() const { return to_begin_.size() - 1; }
  std::span<const Index> coarse_of(std::size_t n) const {
    return {coarse_.data() + begin_[n], coarse_.data() + begin_[n + 1]};
  }
  std::span<const double> weights_of(std::size_t n) const {
    return {weight_.data() + begin_[n], weight_.data() + begin_[n + 1]};
  }

  /// x = P X, at the points of the range alone. Threaded, same bits for any thread count, as are the others.
  void apply(std::span<const double> X, std::span<double> x, EntryRange range) const;
  void apply(std::span<const double> X, std::span<double> x) const { apply(X, x, {0, fine_points()}); }
  /// R = P^T r, at the coarse points of the range alone.
  void restrict_to(std::span<const double> r, std::span<double> R, EntryRange range) const;
  void restrict_to(std::span<const double> r, std::span<double> R) const { restrict_to(r, R, {0, coarse_points()}); }
  /// The fine points that a coarse one is interpolated to.
  std::span<const Index> fine_of(std::size_t I) const {
    return {fine_.data() + to_begin_[I], fine_.data() + to_begin_[I + 1]};
  }

 private:
  std::vector<std::int64_t> begin_{0}, to_begin_{0};
  std::vector<Index> coarse_, fine_;
  std::vector<double> weight_, to_weight_;
};

/// out = P^T A P (Galerkin). out: empty, or of an earlier call with the same graph of A, whose graph it keeps.
void galerkin(const BlockMatrix& A, const Interpolation& P, BlockMatrix& out);

/// Calls body(row, column, its nine entries) for all blocks of a matrix in double precision.
template <class Body>
void for_each_block(const BlockMatrix& A, const Body& body) {
  for (std::size_t n = 0; n < A.points(); ++n)
    for (auto k = static_cast<std::size_t>(A.row_begin[n]); k < static_cast<std::size_t>(A.row_begin[n + 1]); ++k)
      body(static_cast<Index>(n), A.column[k], A.value.data() + 9 * k);
}

}  // namespace carom
