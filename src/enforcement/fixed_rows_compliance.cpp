#include "enforcement/fixed_rows_compliance.hpp"

#include <utility>

namespace carom {

bool FixedRowsCompliance::use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) {
  const bool is_same = std::exchange(operator_, operator_number) == operator_number;
  if (!is_same) columns_.forget();
  columns_.use(rows);
  return is_same;
}

bool FixedRowsCompliance::go_on(const StageMemory& memory, std::vector<std::size_t>& chosen,
                                const InverseOperator& inverse) {
  const std::vector<std::size_t> before = std::exchange(chosen, {memory.chosen_rows.begin(), memory.chosen_rows.end()});
  return columns_.grow_as(memory.port_rows, inverse) || chosen != before;
}

void FixedRowsCompliance::leave(StageMemory& memory, std::span<const std::size_t> chosen) const {
  memory.port_rows = columns_.growth();
  memory.chosen_rows.assign(chosen.begin(), chosen.end());
}

Delassus FixedRowsCompliance::make(const ConstraintRows& /*rows*/, std::span<const std::size_t> acting,
                                   std::span<const std::size_t> counts, const InverseOperator& inverse) {
  return columns_.compliance(acting, counts, inverse);
}

void FixedRowsCompliance::add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force,
                                      std::span<double> y) const {
  columns_.add_columns(rows, force, y);
}

}  // namespace carom
