// The Delassus operator: what forces on the rows do to the rows.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "contact/constraint_rows.hpp"

namespace carom {

/// A 3 x 3 block in the frames of two rows, row-major.
using FrameBlock = std::array<double, 9>;

/// W = G A^-1 G^T for some rows of a ConstraintRows: symmetric, 3 x 3 blocks in compressed rows, columns sorted, the
/// diagonal block always there. Row i of W is rows[i] of the ConstraintRows. Tangential components of rows without
/// friction (mu = 0) take no part: their entries are zero.
struct Delassus {
  std::vector<std::size_t> rows;   ///< numbers of the rows in the ConstraintRows
  std::vector<std::size_t> begin;  ///< rows.size() + 1 entries
  std::vector<std::size_t> column;
  std::vector<FrameBlock> block;

  std::size_t size() const { return rows.size(); }
  /// w = W r
  void apply(std::span<const Vec3> r, std::span<Vec3> w) const;
};

/// A^-1: overwrites the dof vectors b (columns of them, stored one after the other) by A^-1 b, with zero on fixed dofs
/// whatever b is there.
using InverseOperator = std::function<void(std::span<double> b, int columns)>;

/// For any symmetric positive definite A: one solve per row and component (tangential ones only where the row has
/// friction), in batches of up to 32. All blocks are stored; W is made symmetric by the mean with its transpose.
/// `columns` receives A^-1 G^T, 3 dof vectors per row one after the other (zero for tangential components without
/// friction), when it is not nullptr.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen, std::size_t dof_count,
                       const InverseOperator& inverse, std::vector<double>* columns = nullptr);

/// For a diagonal A (lumped mass): inverse_diagonal has one entry per dof, 0 on fixed ones. Only blocks of rows that
/// share a node are stored.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen,
                       std::span<const double> inverse_diagonal);

}  // namespace carom
