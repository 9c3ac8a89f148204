#include "enforcement/make_port_compliance.hpp"

#include "enforcement/fixed_rows_compliance.hpp"
#include "enforcement/moving_rows_compliance.hpp"
#include "enforcement/renewed_compliance.hpp"

namespace carom {

std::unique_ptr<PortCompliance> make_port_compliance(const System& system) {
  const std::size_t dof_count = system.solid.dof_count();
  if (!system.solid.is_linear()) return std::make_unique<RenewedCompliance>(dof_count);
  if (!system.contact.is_fixed()) return std::make_unique<MovingRowsCompliance>(dof_count);
  return std::make_unique<FixedRowsCompliance>(dof_count);
}

}  // namespace carom
