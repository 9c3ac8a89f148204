// The Delassus operator: what forces on the rows do to the rows.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "contact/constraint_rows.hpp"
#include "linalg/half_solution.hpp"

namespace carom {

/// A 3 x 3 block in the frames of two rows, row-major.
using FrameBlock = std::array<double, 9>;

/// W = G A^-1 G^T for some rows of a ConstraintRows: symmetric, 3 x 3 blocks in compressed rows, columns sorted, the
/// diagonal block always there. Row i of W is rows[i] of the ConstraintRows. Components that take no part
/// (Admissible::components: the tangential ones of rows without friction) have entries of zero.
struct Delassus {
  std::vector<std::size_t> rows;   ///< numbers of the rows in the ConstraintRows
  std::vector<std::size_t> begin;  ///< rows.size() + 1 entries
  std::vector<std::size_t> column;
  std::vector<FrameBlock> block;

  std::vector<std::size_t> names;  ///< of the rows, the same in one W after the other; empty: the numbers

  std::size_t size() const { return rows.size(); }
  std::size_t name(std::size_t i) const { return names.empty() ? rows[i] : names[i]; }
  /// w = W r
  void apply(std::span<const Vec3> r, std::span<Vec3> w) const;
};

/// A^-1, with zero on fixed dofs whatever stands there on the right.
struct InverseOperator {
  /// Overwrites the dof vectors b (columns of them, stored one after the other) by A^-1 b.
  std::function<void(std::span<double> b, int columns)> solve;
  /// Y of sparse dof vectors B, B^T A^-1 B = Y^T Y; empty where A has no factors L L^T.
  std::function<std::vector<HalfPanel>(const SparseColumns& B)> half{};
};

/// Appends the components [first, last) of a row of G to sparse dof vectors.
void add_components(const ConstraintRows& rows, std::size_t row, std::size_t first, std::size_t last, SparseColumns& G);

/// For any symmetric positive definite A: a solve, or half of one, per row and component (tangential ones only where
/// the row has friction). All blocks are stored.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen, std::size_t dof_count,
                       const InverseOperator& inverse);

/// For a diagonal A (lumped mass): inverse_diagonal has one entry per dof, 0 on fixed ones. Only blocks of rows that
/// share a node are stored.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen,
                       std::span<const double> inverse_diagonal);

}  // namespace carom
