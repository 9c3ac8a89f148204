#include "enforcement/moving_rows_compliance.hpp"

#include <utility>

namespace carom {

bool MovingRowsCompliance::use(const std::shared_ptr<const ConstraintRows>& rows, std::size_t operator_number) {
  if (std::exchange(operator_, operator_number) != operator_number) nodes_.forget();
  return columns_.use(rows, operator_number);
}

void MovingRowsCompliance::forget() {
  nodes_.forget();
  columns_.forget();
}

bool MovingRowsCompliance::go_on(const StageMemory& memory, std::vector<std::size_t>& /*chosen*/,
                                 const InverseOperator& inverse) {
  return nodes_.grow_as(memory.port_nodes, dof_count_, inverse);
}

void MovingRowsCompliance::leave(StageMemory& memory, std::span<const std::size_t> /*chosen*/) const {
  memory.port_nodes = nodes_.growth();
}

Delassus MovingRowsCompliance::make(const ConstraintRows& rows, std::span<const std::size_t> acting,
                                    std::span<const std::size_t> counts, const InverseOperator& inverse) {
  is_by_nodes_ = nodes_.extend(rows, acting, dof_count_, inverse);
  return is_by_nodes_ ? nodes_.compliance(rows, acting, counts) : columns_.make(rows, acting, counts, inverse);
}

void MovingRowsCompliance::add_node_motion(std::span<const double> load, std::span<double> y) const {
  nodes_.add_motion(load, y);
}

void MovingRowsCompliance::add_columns(std::span<const std::size_t> rows, std::span<const Vec3> force,
                                       std::span<double> y) const {
  columns_.add_columns(rows, force, y);
}

}  // namespace carom
