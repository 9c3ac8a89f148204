#include "march/artificial_energy_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/types.hpp"

namespace carom {

namespace {

constexpr double customary_share = 0.1;
constexpr double least_share_of_run = 1e-3;  // a part with less than this of the run's internal energy says nothing

}  // namespace

void ArtificialEnergyWatch::Peaks::see(const EnergyTerms& terms) {
  hourglass = std::max(hourglass, terms.hourglass + terms.hourglass_loss);
  internal = std::max(internal, terms.strain + terms.plastic);
}

ArtificialEnergyWatch::ArtificialEnergyWatch(const Simulation& simulation) {
  const Model& model = simulation.model();
  const std::vector<Index> numbers = model.part_numbers();
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    const bool is_new = numbers_.empty() || numbers_.back() != at(numbers[p]);
    if (model.parts[p].formulation != Formulation::one_point || model.parts[p].rigid_body >= 0 || !is_new) continue;
    names_.push_back(model.parts[p].name);
    numbers_.push_back(at(numbers[p]));
  }
  parts_.resize(numbers_.size());
}

void ArtificialEnergyWatch::see(const StepView& view) {
  EnergyTerms sum;
  for (std::size_t k = 0; k < numbers_.size(); ++k) {
    const EnergyTerms& of_part = view.forces.of_parts[numbers_[k]];
    parts_[k].see(of_part);
    sum += of_part;
  }
  all_.see(sum);
  viscous_ = std::max(viscous_, view.ledger.now().viscous);
  scale_ = view.ledger.scale();
}

std::vector<std::string> ArtificialEnergyWatch::warnings() const {
  std::vector<std::string> out;
  const auto percent = [](double part, double whole) { return fmt::format("{:.3g} %", 100.0 * part / whole); };
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Peaks& of = parts_[k];
    const bool counts = of.hourglass > least_share_of_run * all_.internal;
    if (!counts || !(of.hourglass > customary_share * of.internal)) continue;
    out.push_back(fmt::format(
        "part \"{}\": its hourglass energy (hourglass and hourglass_loss) comes to {} of its internal energy (strain "
        "and plastic), and 10 % is the customary bound: its stiffness against bending is largely artificial. Take "
        "formulation = \"stabilised\" or more cells through what bends, and spread forces and contact over several "
        "nodes",
        names_[k], percent(of.hourglass, of.internal)));
  }
  if (parts_.size() > 1 && all_.hourglass > customary_share * all_.internal)
    out.push_back(fmt::format("all parts of one-point cells together: hourglass energy {} of their internal energy",
                              percent(all_.hourglass, all_.internal)));
  if (viscous_ > customary_share * scale_)
    out.push_back(fmt::format(
        "artificial viscosity has dissipated {} of the run's energy (the larger of initial and supplied). In strong "
        "shocks it stands for what a shock dissipates; elsewhere lower linear_bulk_viscosity, quadratic_bulk_viscosity "
        "or hourglass_viscosity of the parts",
        percent(viscous_, scale_)));
  return out;
}

}  // namespace carom
