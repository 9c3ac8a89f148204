// Chooses how the compliance of rows is kept.
#pragma once

#include <memory>

#include "enforcement/port_compliance.hpp"

namespace carom {

/// Makes the PortCompliance that suits the system: FixedRowsCompliance where bodies are linear and rows fixed,
/// MovingRowsCompliance where rows move over linear bodies, else RenewedCompliance.
std::unique_ptr<PortCompliance> make_port_compliance(const System& system);

}  // namespace carom
