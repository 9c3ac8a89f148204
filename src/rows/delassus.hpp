// The Delassus operator: the motion of rows under forces on rows.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "linalg/half_solution.hpp"
#include "rows/constraint_rows.hpp"
#include "rows/inverse_operator.hpp"

namespace carom {

/// A 3 x 3 block in the frames of two rows, row-major.
using FrameBlock = std::array<double, 9>;

/// Thrown when a dense W would take more than Delassus::most_bytes.
struct TooManyRows : std::length_error {
  using std::length_error::length_error;
};

/// W = G A^-1 G^T for some rows of a ConstraintRows: symmetric, 3 x 3 blocks, sparse or dense. Row i of W is rows[i] of
/// the ConstraintRows. Components that take no part (Admissible::components: the tangential ones of rows without
/// friction) have entries of zero; where no row has tangents, the normal entries are kept alone.
struct Delassus {
  /// The most that the entries of a dense W may take: 16,384 rows without friction, 5,461 rows with it.
  static constexpr std::size_t most_bytes = std::size_t{1} << 31;

  std::vector<std::size_t> rows;  ///< numbers of the rows in the ConstraintRows
  /// Compressed rows: rows.size() + 1 entries, and columns, sorted, the diagonal always there. Both are empty where W
  /// is dense: row-major then.
  std::vector<std::size_t> begin, column;
  std::vector<FrameBlock> block;
  std::vector<double> normal;  ///< instead of blocks, where no row has tangents

  std::vector<std::size_t> names;  ///< of the rows, the same in one W after the other; empty: the numbers

  /// A dense W of zeros. Throws TooManyRows.
  static Delassus dense(std::vector<std::size_t> rows, bool has_tangents);
  /// A dense W of zeros for rows with so many components each. Throws TooManyRows.
  static Delassus dense(std::span<const std::size_t> rows, std::span<const std::size_t> components);
  /// The largest number of rows that a dense W may have.
  static std::size_t most_rows(bool has_tangents);
  /// Throws TooManyRows where a dense W of so many rows would take too much.
  static void admit_dense(std::size_t count, bool has_tangents);

  std::size_t size() const { return rows.size(); }
  std::size_t name(std::size_t i) const { return names.empty() ? rows[i] : names[i]; }
  std::size_t entries() const { return block.empty() ? normal.size() : block.size(); }
  /// The entries [first_entry, end_entry) are those of row i.
  std::size_t first_entry(std::size_t i) const { return begin.empty() ? i * size() : begin[i]; }
  std::size_t end_entry(std::size_t i) const { return first_entry(i + 1); }
  /// visit(j, entry) for the rows j that W has in row i.
  template <class Visit>
  void each(std::size_t i, const Visit& visit) const {
    if (begin.empty())
      for (std::size_t j = 0, k = i * size(); j < size(); ++j, ++k) visit(j, k);
    else
      for (std::size_t k = begin[i]; k < begin[i + 1]; ++k) visit(column[k], k);
  }
  /// The entry of a row on itself.
  std::size_t own_entry(std::size_t i) const;
  double normal_at(std::size_t entry) const { return block.empty() ? normal[entry] : block[entry][0]; }
  FrameBlock block_at(std::size_t entry) const { return block.empty() ? FrameBlock{normal[entry]} : block[entry]; }
  void add(std::size_t entry, const FrameBlock& more);
  /// w = W r
  void apply(std::span<const Vec3> r, std::span<Vec3> w) const;

  friend bool operator==(const Delassus&, const Delassus&) = default;
};

/// Appends the components [first, last) of a row of G to sparse dof vectors.
void add_components(const ConstraintRows& rows, std::size_t row, std::size_t first, std::size_t last, SparseColumns& G);

/// Makes W for any symmetric positive definite A, by one solve, or half of one, per row and component (tangential ones
/// only where the row has friction). W is dense. Throws TooManyRows.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen, std::size_t dof_count,
                       const InverseOperator& inverse);

/// Makes W for a diagonal A (lumped mass). inverse_diagonal has one entry per dof, 0 on fixed ones. Only blocks of rows
/// that share a node are stored.
Delassus make_delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen,
                       std::span<const double> inverse_diagonal);

/// The sum of W and of a dense operator `more` on some of its rows: row i of `more` is the row some[i] of W
/// (ascending).
Delassus sum_of(const Delassus& W, const std::vector<std::size_t>& some, const Delassus& more);

}  // namespace carom
