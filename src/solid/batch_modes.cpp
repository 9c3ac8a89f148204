// The hourglass modes of a batch: those with a flow or a viscosity of their own, and those that are stabilised.
#include <algorithm>
#include <cmath>

#include "solid/staged_batch.hpp"

namespace carom {

/// The modes of stabilised cells as they would be without flow in this step. What they store per volume, w / 6, counts
/// in the equivalent trial stress as the energy q^2 / 6 G of the deviator does: by 6 G times it.
void Batch::try_modes() const {
  const ModeStages& stabilisation = stages_.cell->stabilisation;
  stabilisation.pull(b_.geometry, finite(b_.gradient), b_.q, b_.modes.z);
  std::fill_n(b_.modes.share, lanes(), 1.0);
  if (modes_flow())
    stabilisation.begin(b_.geometry, finite(b_.strain), b_.modes.z, plastic_modes(cells_.history), cells_.is_over,
                        b_.modes.plastic, b_.modes.share);
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

/// After `evaluate`: the modes at the end of the step, and what is remembered of them. Their forces are F T on the
/// nodes' modes, and q T^T / V on F.
void Batch::return_modes(Modes& modes) const {
  const int n = lanes(), d = stages_.cell->directions, size = stages_.cell->modes * d;
  std::copy_n(b_.q, size * n, modes.q);
  std::copy_n(stages_.cell->stiffness(b_.geometry), n, modes.stiffness);
  const bool is_finite = stages_.points->is_finite;
  const auto F = [&](int i, int j, int l) { return b_.gradient[(3 * i + j) * n + l]; };
  std::fill_n(modes.P, 9 * n, 0.0);
  const std::ptrdiff_t behind = static_cast<std::ptrdiff_t>(cells_.history_variables) * n;
  const double* history = of_batch(cells_.history);
  double* new_history = of_batch(cells_.new_history);
  for (int l = 0; l < n; ++l) {
    const auto at_mode = [&](int m, int i) { return (d * m + i) * n + l; };
    for (int c = 0; c < size; ++c) modes.pulled[c * n + l] = is_finite ? 0.0 : modes.q[c * n + l];
    for (int m = 0; is_finite && m < stages_.cell->modes; ++m)
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j) modes.pulled[at_mode(m, j)] += F(i, j, l) * modes.q[at_mode(m, i)];
    const double* before = history == nullptr ? nullptr : history + behind + l;
    const double volume = weight(0, l), c = stages_.hourglass_coefficient;
    const double limit = modes_yield() && !cells_.is_over
                             ? c * std::sqrt(modes.stiffness[l] * volume / 3.0) * b_.yield_stress[l]
                             : infinity;
    double damper = 0.0;  // of the step: viscosity over its length
    if (stages_.viscosity.hourglass > 0.0 && cells_.viscous_dt > 0.0)
      damper = stages_.viscosity.hourglass * stages_.modulus * modes.stiffness[l] * cells_.length[first_ + l] /
               (stages_.wave_speed * cells_.viscous_dt);
    modes.stiffness[l] *= stages_.hourglass;
    HourglassReturn& of_lane = modes.of_lane[l];
    of_lane.go(size, n, modes.pulled + l, before, modes.stiffness[l], limit);
    modes.stored[l] = of_lane.stored;
    modes.lost[l] = of_lane.lost + (before == nullptr ? 0.0 : before[size * n]);
    modes.viscous[l] = 0.0;
    if (stages_.viscosity.hourglass > 0.0) {
      const double* rest = before == nullptr ? nullptr : before + (size + 1) * n;
      if (cells_.is_over && rest != nullptr)
        of_lane.hold(size, n, rest);
      else
        modes.viscous[l] = of_lane.damp(size, n, modes.pulled + l, rest, damper);
    }
    if (new_history != nullptr) {
      double* after = new_history + behind + l;
      for (int k = 0; k < size; ++k) after[k * n] = of_lane.plastic[k];
      after[size * n] = modes.lost[l];
      if (stages_.viscosity.hourglass > 0.0) {
        for (int k = 0; k < size; ++k) {
          after[(size + 1 + k) * n] = modes.pulled[k * n + l];
          after[(2 * size + 1 + k) * n] = of_lane.viscous_force(k);
        }
        after[(3 * size + 1) * n] = modes.viscous[l];
      }
    }
    for (int m = 0; m < stages_.cell->modes; ++m)
      for (int i = 0; i < d; ++i) {
        double& force = modes.force[at_mode(m, i)];
        force = is_finite ? 0.0 : of_lane.force[d * m + i];
        for (int j = 0; is_finite && j < d; ++j) {
          const double T = of_lane.force[d * m + j];
          force += F(i, j, l) * T;
          modes.P[(3 * i + j) * n + l] += modes.q[at_mode(m, i)] * T / volume;
        }
      }
  }
}

/// The changes of forces and stress with x, whose gradient is dH and whose modes are change.q: d(F^T q) = dH^T q + F^T
/// dq, d(F T) = dH T + F dT and d(q T^T) = dq T^T + q dT^T.
void Batch::change_modes(const double* dH, const Modes& modes, Modes& change) const {
  const int n = lanes(), d = stages_.cell->directions, size = stages_.cell->modes * d;
  const bool is_finite = stages_.points->is_finite;
  std::fill_n(change.P, 9 * n, 0.0);
  for (int l = 0; l < n; ++l) {
    const auto at_mode = [&](int m, int i) { return (d * m + i) * n + l; };
    const auto at_point = [&](int i, int j) { return (3 * i + j) * n + l; };
    for (int c = 0; c < size; ++c) change.pulled[c * n + l] = is_finite ? 0.0 : change.q[c * n + l];
    for (int m = 0; is_finite && m < stages_.cell->modes; ++m)
      for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j)
          change.pulled[at_mode(m, j)] +=
              dH[at_point(i, j)] * modes.q[at_mode(m, i)] + b_.gradient[at_point(i, j)] * change.q[at_mode(m, i)];
    modes.of_lane[l].change(size, n, modes.stiffness[l], change.pulled + l, change.pulled + l);
    for (int m = 0; m < stages_.cell->modes; ++m)
      for (int i = 0; i < d; ++i) {
        double& force = change.force[at_mode(m, i)];
        force = is_finite ? 0.0 : change.pulled[at_mode(m, i)];
        for (int j = 0; is_finite && j < d; ++j) {
          const double T = modes.of_lane[l].force[d * m + j], dT = change.pulled[at_mode(m, j)];
          force += dH[at_point(i, j)] * T + b_.gradient[at_point(i, j)] * dT;
          change.P[at_point(i, j)] += (change.q[at_mode(m, i)] * T + modes.q[at_mode(m, i)] * dT) / weight(0, l);
        }
      }
  }
}

}  // namespace carom
