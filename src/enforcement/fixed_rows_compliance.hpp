// The compliance of rows that stay, on linear bodies.
#pragma once

#include "enforcement/port_compliance.hpp"
#include "system/row_compliance.hpp"

namespace carom {

/// Keeps the columns A^-1 G^T for the run, so that an iteration with contact costs one back-substitution and products
/// with them. StageMemory says in which order they have grown and rows have been chosen.
class FixedRowsCompliance final : public PortCompliance {
 public:
  explicit FixedRowsCompliance(std::size_t dof_count) : columns_(dof_count, RowCompliance::most_column_entries) {}

  bool use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) override;
  void forget() override { columns_.forget(); }
  bool go_on(const StageMemory& memory, std::vector<std::size_t>& chosen, const InverseOperator& inverse) override;
  void leave(StageMemory& memory, std::span<const std::size_t> chosen) const override;
  Delassus make(const ConstraintRows& rows, std::span<const std::size_t> acting, std::span<const std::size_t> counts,
                const InverseOperator& inverse) override;
  bool knows_columns() const override { return columns_.has_columns(); }
  void add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force, std::span<double> y) const override;

 private:
  RowCompliance columns_;
  std::size_t operator_ = 0;  ///< number of the one that they are of
};

}  // namespace carom
