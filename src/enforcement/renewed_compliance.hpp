// The compliance of rows on bodies whose operator is another one at every iterate.
#pragma once

#include "enforcement/port_compliance.hpp"
#include "system/row_compliance.hpp"

namespace carom {

/// Makes the columns A^-1 G^T of the rows in question anew for every operator and all rows.
class RenewedCompliance final : public PortCompliance {
 public:
  explicit RenewedCompliance(std::size_t dof_count) : columns_(dof_count, RowCompliance::most_column_entries) {}

  bool use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) override;
  void forget() override { columns_.forget(); }
  Delassus make(const ConstraintRows& rows, std::span<const std::size_t> acting, std::span<const std::size_t> counts,
                const InverseOperator& inverse) override;
  bool knows_columns() const override { return columns_.has_columns(); }
  void add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force, std::span<double> y) const override;

 private:
  RowCompliance columns_;
};

}  // namespace carom
