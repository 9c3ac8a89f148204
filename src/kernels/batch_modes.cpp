// The hourglass modes of a batch: those with a flow or a viscosity of their own, and those that are stabilised.
#include <algorithm>
#include <cmath>

#include "kernels/staged_batch.hpp"

namespace carom {

/// The modes of stabilised cells as they would be without flow in this step. What they store per volume, w / 6, counts
/// in the equivalent trial stress as the energy q^2 / 6 G of the deviator does: by 6 G times it.
void Batch::try_modes() const {
  const ModeStages& stabilisation = stages_.cell->stabilisation;
  stabilisation.pull(b_.geometry, finite(b_.gradient), b_.q, b_.modes.z);
  std::fill_n(b_.modes.share, lanes(), 1.0);
  if (modes_flow())
    stabilisation.begin(b_.geometry, finite(b_.strain), b_.modes.z, slot(MemorySlot::hourglass, cells_.history),
                        cells_.is_over, b_.modes.plastic, b_.modes.share);
  try_forces();
}

/// Of modes z and the strain of the point.
void Batch::try_forces() const {
  StabilisedModes& modes = b_.modes;
  stages_.cell->stabilisation.trial(b_.geometry, stages_.moduli, finite(b_.strain), modes.z, plastic(), modes.energy,
                                    modes.T, modes.S);
  for (int l = 0; l < lanes(); ++l) modes.square[l] = 6.0 * stages_.modulus * modes.energy[l];
}

/// z of q, and W += its energy per volume at E.
void Batch::add_mode_energy(const double* F, const double* E, const double* q, double* z, double* W) const {
  StabilisedModes& modes = b_.modes;
  const ModeStages& stabilisation = stages_.cell->stabilisation;
  stabilisation.pull(b_.geometry, finite(F), q, z);
  stabilisation.trial(b_.geometry, stages_.moduli, finite(E), z, nullptr, modes.energy, modes.T, modes.S);
  for (int l = 0; l < lanes(); ++l) W[l] += modes.energy[l];
}

/// After `evaluate`: the forces Q of stabilised modes, and what they add to P; returns what the cells store in them.
double Batch::push_modes() const {
  const StabilisedModes& modes = b_.modes;
  stages_.cell->stabilisation.push(b_.geometry, finite(b_.gradient), b_.q, modes.T, modes.share, b_.Q, b_.P);
  double sum = 0.0;
  for (int l = 0; l < count_; ++l) sum += weight(0, l) * modes.share[l] * modes.share[l] * modes.energy[l];
  return sum;
}

/// After `evaluate`: modes that yield or are viscous at the end of the step, and what is remembered of them.
void Batch::return_modes(ModeReturn& modes) const {
  const Viscosity& viscosity = stages_.viscosity;
  ModeFlow flow{stages_.hourglass_coefficient, stages_.modulus, viscosity.hourglass > 0.0, 0.0, cells_.is_over};
  if (flow.is_viscous && cells_.viscous_dt > 0.0)
    flow.viscosity = viscosity.hourglass * stages_.modulus / (stages_.wave_speed * cells_.viscous_dt);
  stages_.cell->stabilisation.pull(b_.geometry, finite(b_.gradient), b_.q, b_.modes.z);
  stages_.cell->flow.give(b_.geometry, flow, b_.modes.z, modes_yield() ? b_.yield_stress : nullptr,
                          flow.is_viscous ? cells_.length + first_ : nullptr,
                          slot(MemorySlot::hourglass, cells_.history), slot(MemorySlot::hourglass, cells_.new_history),
                          modes);
}

}  // namespace carom
