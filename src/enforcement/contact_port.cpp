#include "enforcement/contact_port.hpp"

#include <algorithm>

#include "enforcement/exact_port.hpp"
#include "enforcement/penalty_port.hpp"

namespace carom {

std::unique_ptr<ContactPort> make_contact_port(const System& system, const ImplicitSettings& settings) {
  switch (settings.enforcement) {
    case EnforcementKind::augmented_lagrangian: {
      const std::vector<double>& lengths = system.solid.cell_lengths();
      return std::make_unique<AugmentedLagrangianPort>(
          system, settings.penetration * *std::min_element(lengths.begin(), lengths.end()));
    }
    case EnforcementKind::lagrange:
      return std::make_unique<MultiplierPort>(system);
    case EnforcementKind::impulse:
      return std::make_unique<ImpulsePort>(system);
    case EnforcementKind::penalty:
      break;
  }
  return std::make_unique<PenaltyPort>(system);
}

}  // namespace carom
