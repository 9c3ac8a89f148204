#include "enforcement/make_contact_port.hpp"

#include <algorithm>

#include "enforcement/exact_port.hpp"
#include "enforcement/penalty_port.hpp"
#include "solid/smallest_cell.hpp"

namespace carom {

std::unique_ptr<ContactPort> make_contact_port(const System& system, const ImplicitSettings& settings) {
  switch (settings.enforcement) {
    case EnforcementKind::augmented_lagrangian:
      return std::make_unique<AugmentedLagrangianPort>(system, settings.penetration * smallest_cell(system.solid));
    case EnforcementKind::lagrange:
    case EnforcementKind::plain:
      return std::make_unique<MultiplierPort>(system);
    case EnforcementKind::impulse:
      return std::make_unique<ImpulsePort>(system);
    case EnforcementKind::penalty:
      break;
  }
  return std::make_unique<PenaltyPort>(system);
}

}  // namespace carom
