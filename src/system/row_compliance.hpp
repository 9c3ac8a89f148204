// The effect of forces on rows through the inverse of an operator: A^-1 G^T and G A^-1 G^T, grown as rows are needed.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "rows/compliance.hpp"
#include "rows/delassus.hpp"
#include "state/growth.hpp"

namespace carom {

/// One component of one row: a column of G^T.
struct RowComponent {
  std::size_t row;
  std::size_t component;
};

/// S = G A^-1 G^T for some components of the rows of one ConstraintRows; a component is solved for once.
class RowCompliance {
 public:
  /// The usual value of column_entries where columns are wanted: 512 MiB.
  static constexpr std::size_t most_column_entries = std::size_t{1} << 26;

  /// column_entries: how many numbers of A^-1 G^T may be kept (0: none), where inverses have no halves.
  RowCompliance(std::size_t dof_count, std::size_t column_entries)
      : dof_count_(dof_count), column_entries_(column_entries) {}

  /// Forgets everything, unless it was made for these rows already.
  void use(const std::shared_ptr<const ConstraintRows>& rows);
  void forget() { rows_.reset(); }
  /// Adds those components that are not there yet.
  void extend(std::span<const RowComponent> wanted, const InverseOperator& inverse);
  /// The order in which the components came, as 3 row + component. A compliance that grows in the same order has the
  /// same bits.
  const Growth& growth() const { return growth_; }
  /// Makes this compliance the one that has grown in the given order. Returns true when it was another one.
  bool grow_as(const Growth& growth, const InverseOperator& inverse);
  /// S of the listed rows, of which row i has counts[i] components, dense; what is not there yet is solved for. Throws
  /// TooManyRows before that.
  Delassus compliance(std::span<const std::size_t> rows, std::span<const std::size_t> counts,
                      const InverseOperator& inverse);
  bool knows(const RowComponent& rc) const { return known_[3 * rc.row + rc.component] >= 0; }
  /// Number of components.
  std::size_t size() const { return components_.size(); }
  /// Entry of S; both components are known.
  double operator()(const RowComponent& a, const RowComponent& b) const;
  /// True when all columns of A^-1 G^T are kept.
  bool has_columns() const { return columns_.size() == components_.size() * dof_count_; }
  /// x += A^-1 G^T force, force in the frames of the listed rows; only known components count.
  void add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force, std::span<double> x) const;

 private:
  void add(std::span<const Index> missing, const InverseOperator& inverse);
  void cut(std::size_t count);

  std::size_t dof_count_, column_entries_;
  std::shared_ptr<const ConstraintRows> rows_;
  Growth growth_;
  std::vector<RowComponent> components_;
  std::vector<int> known_;  ///< position of each row component, -1 when it is not there yet
  Compliance S_;            ///< in the order of components_
  std::vector<double> columns_;
};

}  // namespace carom
