#include "enforcement/renewed_compliance.hpp"

namespace carom {

bool RenewedCompliance::use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t /*operator_number*/) {
  columns_.forget();
  columns_.use(rows);
  return false;
}

Delassus RenewedCompliance::make(const ConstraintRows& /*rows*/, std::span<const std::size_t> acting,
                                 std::span<const std::size_t> counts, const InverseOperator& inverse) {
  return columns_.compliance(acting, counts, inverse);
}

void RenewedCompliance::add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force,
                                    std::span<double> y) const {
  columns_.add_columns(rows, force, y);
}

}  // namespace carom
