// One batch of cells on its way through the stages: plain code over buffers whose lanes it only adds up.
#pragma once

#include <algorithm>
#include <cstddef>

#include "base/types.hpp"
#include "kernels/bulk_viscosity.hpp"
#include "kernels/kernels.hpp"

namespace carom {

/// The bulk viscosity of one batch.
struct Bulk {
  alignas(64) double change[most_lanes], stretch[most_lanes];  ///< V - V_0; the least, less 1
  alignas(64) double g[6 * most_points * most_lanes];          ///< dJ/dE
  alignas(64) double pressure[most_lanes];                     ///< q
  alignas(64) double slope[most_lanes], lost[most_lanes];      ///< dq/dV, and dissipated since the start
};

/// The modes of stabilised cells of one batch, or their changes.
struct StabilisedModes {
  alignas(64) double z[most_stabilised * most_lanes];  ///< as they enter the strain
  alignas(64) double T[most_stabilised * most_lanes];  ///< of an elastic step, per volume
  alignas(64) double S[6 * most_lanes];                ///< what they add to the stress of the point then
  alignas(64) double energy[most_lanes];               ///< per volume
  alignas(64) double square[most_lanes];               ///< PointBatch::mode_square
  alignas(64) double share[most_lanes], along[most_lanes];
  alignas(64) double plastic[most_stabilised * most_lanes];  ///< q_p at the beginning of the step
};

/// Buffers of the points of one batch.
struct Buffers {
  alignas(64) double geometry[most_geometry * most_lanes];
  alignas(64) double gradient[9 * most_points * most_lanes];  ///< H, then F
  alignas(64) double strain[6 * most_points * most_lanes];    ///< what the law sees
  alignas(64) double stress[6 * most_points * most_lanes];
  alignas(64) double memory[dilatation_memory * most_points * most_lanes];
  alignas(64) double energy[most_points * most_lanes];
  alignas(64) double dissipation[most_points * most_lanes];
  alignas(64) double P[9 * most_points * most_lanes];
  alignas(64) double yield_stress[most_points * most_lanes];
  alignas(64) double q[most_stabilised * most_lanes], Q[most_stabilised * most_lanes];  ///< modes and their forces
  Bulk bulk;
  StabilisedModes modes;
};

/// One batch on its way through the stages.
class Batch {
 public:
  Batch(const CellBatches& cells, const BatchLaw& law, Buffers& buffers)
      : cells_(cells), stages_(*cells.stages), law_(law), b_(buffers) {}

  /// Goes to the batch that begins with a cell.
  void place(Index first) {
    first_ = first;
    offset_ = cells_.offset + static_cast<std::ptrdiff_t>(first) * stages_.cell->places();
    count_ = static_cast<int>(std::min<Index>(stages_.lanes, cells_.cells - first));
    stages_.cell->prepare(*stages_.cell, cells_.x, offset_, cells_.thickness, b_.geometry);
    if (first + stages_.lanes >= cells_.cells) return;
    fetch_next(cells_.history);
    fetch_next(cells_.new_history);
  }
  /// Asks for the history of the next batch: without it the first of its stages to touch it waits for the memory, and
  /// stores to the new one hold up all that follow. Inlined, since GCC drops calls that do nothing but ask.
  [[gnu::always_inline]] void fetch_next(const double* history) const {
    if (history == nullptr) return;
    const std::ptrdiff_t size = memory_of_batch();
    constexpr std::ptrdiff_t line = 8;
    for (std::ptrdiff_t k = 0; k < size; k += line) __builtin_prefetch(of_batch(history) + size + k);
  }
  int points() const { return stages_.cell->points; }
  int lanes() const { return stages_.lanes; }
  int count() const { return count_; }
  const double* frame() const {
    return stages_.cell->frame_offset == 0 ? nullptr : b_.geometry + stages_.cell->frame_offset;
  }
  /// Where the batch stands in a history.
  template <class Number>
  Number* of_batch(Number* history) const {
    return history == nullptr ? nullptr : history + first_ / lanes() * memory_of_batch();
  }
  /// Where a slot of the memory of the batch begins in a history; null where there is no history.
  template <class Number>
  Number* slot(MemorySlot which, Number* history) const {
    return history == nullptr ? nullptr
                              : of_batch(history) + static_cast<std::ptrdiff_t>(stages_.memory.begin(which)) * lanes();
  }
  std::ptrdiff_t memory_of_batch() const { return static_cast<std::ptrdiff_t>(stages_.memory.size()) * lanes(); }
  bool is_stabilised() const { return stages_.cell->stabilisation.trial != nullptr; }
  /// Of cells whose modes have a flow or a viscosity of their own (kernels/hourglass_flow.hpp).
  bool modes_remember() const { return stages_.memory.size(MemorySlot::hourglass) > 0 && !is_stabilised(); }
  bool modes_yield() const { return modes_remember() && cells_.history_variables > 0; }
  /// Of cells whose modes flow with the point.
  bool modes_flow() const { return is_stabilised() && cells_.history_variables > 0; }
  /// F and E of the point; null of small strain.
  const double* finite(const double* values) const { return stages_.points->is_finite ? values : nullptr; }
  double weight(int p, int l) const { return b_.geometry[p * lanes() + l]; }

  /// F, the strain E and the hourglass modes of u.
  void kinematics(const double* u, double* gradient, double* strain) const {
    stages_.cell->gradients(b_.geometry, u, offset_, gradient, b_.q);
    stages_.points->strain(points(), frame(), gradient, strain);
  }
  void to_law(double* strain) const {
    if (stages_.dilatation != nullptr) stages_.dilatation->strain(points(), b_.geometry, strain, b_.memory);
  }
  void from_law(const double* strain, double* stress) const {
    if (stages_.dilatation != nullptr) stages_.dilatation->stress(points(), b_.geometry, b_.memory, strain, stress);
  }
  /// The law's answer to a strain; energies and the new history where they are wanted.
  void constitutive(double* strain, double* stress, double* energy, double* dissipation, bool keep_history) const {
    PointBatch batch{points(), strain, stress, energy};
    batch.dt = cells_.dt;
    batch.history = of_batch(cells_.history);
    if (keep_history) batch.new_history = of_batch(cells_.new_history);
    batch.dissipation = dissipation;
    batch.is_over = cells_.is_over;
    if (modes_yield()) batch.yield_stress = b_.yield_stress;
    if (modes_flow() && !cells_.is_over) {  // else all is elastic
      batch.mode_square = b_.modes.square;
      batch.share = b_.modes.share;
    }
    law_.update(law_.parameters, batch);
  }
  /// All up to the stress that works with the strain E.
  void evaluate(const double* u, bool with_energies) const {
    kinematics(u, b_.gradient, b_.strain);
    if (stages_.bulk != nullptr) return_bulk();
    to_law(b_.strain);
    if (is_stabilised()) try_modes();
    const bool dissipates = with_energies && cells_.history_variables > 0;
    constitutive(b_.strain, b_.stress, with_energies ? b_.energy : nullptr, dissipates ? b_.dissipation : nullptr,
                 true);
    if (modes_flow() && cells_.new_history != nullptr)
      stages_.cell->stabilisation.flow(b_.geometry, finite(b_.strain), b_.modes.z, b_.modes.plastic, b_.modes.share,
                                       slot(MemorySlot::hourglass, cells_.new_history));
  }
  /// Adds the forces of the stress P and of the hourglass modes.
  void scatter(const double* Q, double* f) const { stages_.cell->add_forces(b_.geometry, b_.P, Q, offset_, count_, f); }
  /// The sum over the cells of the batch of the integral of a density.
  double integral(const double* density) const {
    double sum = 0.0;
    for (int l = 0; l < count_; ++l) {
      double of_cell = 0.0;
      for (int p = 0; p < points(); ++p) of_cell += weight(p, l) * density[p * lanes() + l];
      sum += of_cell;
    }
    return sum;
  }
  int hourglass_numbers() const { return stages_.cell->modes * stages_.cell->directions; }
  /// The forces Q = k q of elastic hourglass modes; returns their energy q.Q / 2.
  double elastic_modes() const {
    if (stages_.cell->modes == 0) return 0.0;
    double energy[most_lanes], sum = 0.0;
    stages_.cell->elastic_modes(b_.geometry, stages_.hourglass, b_.q, b_.Q, energy);
    for (int l = 0; l < count_; ++l) sum += energy[l];
    return sum;
  }
  void return_bulk() const;
  void try_modes() const;
  void try_forces() const;
  void add_mode_energy(const double* F, const double* E, const double* q, double* z, double* W) const;
  double push_modes() const;
  void return_modes(ModeReturn& modes) const;

  /// The stress that works with E, from what the law has answered.
  void complete_stress() const {
    from_law(b_.strain, b_.stress);
    if (stages_.bulk != nullptr) stages_.bulk->add_scaled(points(), b_.bulk.pressure, b_.bulk.g, b_.stress);
    if (is_stabilised()) add_modes(b_.modes.S, b_.modes.share, 6, b_.stress);
  }

  void add_internal_force(const double* u, double* f, SolidEnergies* energies) const {
    evaluate(u, energies != nullptr);
    complete_stress();
    stages_.points->stress(points(), frame(), b_.gradient, b_.stress, b_.P);
    double hourglass = 0.0, loss = 0.0, viscous = 0.0;
    if (modes_remember()) {
      ModeReturn modes;
      return_modes(modes);
      stages_.cell->stabilisation.push(b_.geometry, finite(b_.gradient), b_.q, modes.T, nullptr, b_.Q, b_.P);
      for (int l = 0; l < count_; ++l) {
        hourglass += modes.stored[l];
        loss += modes.lost[l];
        viscous += modes.viscous[l];
      }
    } else {
      hourglass = is_stabilised() ? push_modes() : elastic_modes();
    }
    scatter(b_.Q, f);
    if (energies == nullptr) return;
    if (stages_.bulk != nullptr)
      for (int l = 0; l < count_; ++l) viscous += b_.bulk.lost[l];
    energies->hourglass_loss += loss;
    energies->viscous += viscous;
    energies->strain += integral(b_.energy);
    if (cells_.history_variables > 0) {
      const double plastic = integral(b_.dissipation);
      energies->plastic += plastic;
      energies->heat += stages_.heating_share * plastic;
    }
    energies->hourglass += hourglass;
  }

  /// P = dH S + F dS, dS by the law's tangent of dE.
  void add_tangent_action(const double* u, const double* x, double* y) const {
    evaluate(u, false);
    complete_stress();
    alignas(64) double dE[6 * most_points * most_lanes], dS[6 * most_points * most_lanes];
    alignas(64) double viscous[6 * most_points * most_lanes];
    ModeReturn modes;
    StabilisedModes stabilised;
    const ModeStages& stabilisation = stages_.cell->stabilisation;
    alignas(64) double q[most_stabilised * most_lanes];
    if (modes_remember()) return_modes(modes);
    std::copy_n(b_.q, hourglass_numbers() * lanes(), q);
    stages_.cell->gradients(b_.geometry, x, offset_, b_.P, b_.q);
    stages_.points->strain_change(points(), frame(), b_.gradient, b_.P, dE);
    if (stages_.bulk != nullptr) change_bulk(dE, viscous);
    const DilatationStages* dilatation = stages_.dilatation;
    if (dilatation != nullptr) dilatation->strain_change(points(), b_.geometry, b_.memory, b_.strain, dE);
    TangentBatch batch{points(), b_.strain, dE, dS, cells_.dt, of_batch(cells_.history)};
    if (is_stabilised()) {
      stabilisation.pull_change(b_.geometry, finite(b_.gradient), b_.P, q, b_.q, stabilised.z);
      stabilisation.change(b_.geometry, stages_.moduli, finite(b_.strain), finite(dE), b_.modes.z, stabilised.z,
                           plastic(), stabilised.energy, stabilised.T, stabilised.S);
      for (int l = 0; l < lanes(); ++l) stabilised.square[l] = 3.0 * stages_.modulus * stabilised.energy[l];
      if (modes_flow()) {
        batch.mode_square = b_.modes.square;
        batch.half_change = stabilised.square;
        batch.share = b_.modes.share;
        batch.along = stabilised.along;
      } else {
        std::fill_n(stabilised.along, lanes(), 0.0);
      }
    }
    law_.tangent(law_.parameters, batch);
    if (dilatation != nullptr) dilatation->stress_change(points(), b_.geometry, b_.memory, b_.strain, dE, dS);
    if (stages_.bulk != nullptr)
      for (int c = 0; c < 6 * points() * lanes(); ++c) dS[c] += viscous[c];
    alignas(64) double dH[9 * most_lanes];
    if (is_stabilised() || modes_remember()) std::copy_n(b_.P, 9 * lanes(), dH);
    if (modes_remember()) {
      stabilisation.pull_change(b_.geometry, finite(b_.gradient), dH, q, b_.q, stabilised.z);
      stages_.cell->flow.change(b_.geometry, modes, stabilised.z, stabilised.T);
    }
    if (is_stabilised()) {
      add_modes(stabilised.S, b_.modes.share, 6, dS);
      add_modes(b_.modes.S, stabilised.along, 6, dS);
    }
    stages_.points->stress_change(points(), frame(), b_.gradient, b_.P, b_.stress, dS, b_.P);
    if (is_stabilised()) {
      alignas(64) double T[most_stabilised * most_lanes], dT[most_stabilised * most_lanes];
      std::fill_n(T, hourglass_numbers() * lanes(), 0.0);
      std::fill_n(dT, hourglass_numbers() * lanes(), 0.0);
      add_modes(b_.modes.T, b_.modes.share, hourglass_numbers(), T);
      add_modes(stabilised.T, b_.modes.share, hourglass_numbers(), dT);
      add_modes(b_.modes.T, stabilised.along, hourglass_numbers(), dT);
      stabilisation.push_change(b_.geometry, finite(b_.gradient), dH, q, b_.q, T, dT, b_.Q, b_.P);
      return scatter(b_.Q, y);
    }
    if (modes_remember())
      stabilisation.push_change(b_.geometry, finite(b_.gradient), dH, q, b_.q, modes.T, stabilised.T, b_.Q, b_.P);
    else
      elastic_modes();
    scatter(b_.Q, y);
  }

  void add_discrete_gradient_force(const double* u_0, const double* u_1, double* f) const;
  void add_internal_force_of_parts(const double* u, const unsigned char* wanted, double* f) const;

  /// The largest of the points of each cell of the batch.
  void wave_modulus(const double* u, double* largest) const {
    kinematics(u, b_.gradient, b_.strain);
    to_law(b_.strain);
    PointBatch batch{points(), b_.strain, b_.stress};
    batch.dt = cells_.dt;
    batch.history = of_batch(cells_.history);
    batch.is_over = cells_.is_over;
    batch.wave_modulus = b_.energy;
    law_.update(law_.parameters, batch);
    for (int l = 0; l < count_; ++l) {
      largest[l] = b_.energy[l];
      for (int p = 1; p < points(); ++p) largest[l] = std::max(largest[l], b_.energy[p * lanes() + l]);
    }
  }

  /// mean[6 l + c] of the cells of the batch.
  void mean_stress(const double* u, double* mean) const {
    evaluate(u, false);
    double* sigma = b_.P;
    stages_.points->cauchy(points(), frame(), b_.gradient, b_.strain, b_.stress, sigma);
    if (stages_.dilatation != nullptr) stages_.dilatation->cauchy(points(), b_.memory, sigma);
    for (int l = 0; l < count_; ++l) {
      double volume = 0.0, sum[6] = {};
      for (int p = 0; p < points(); ++p) {
        volume += weight(p, l);
        for (int c = 0; c < 6; ++c) sum[c] += weight(p, l) * sigma[(6 * p + c) * lanes() + l];
      }
      for (int c = 0; c < 6; ++c) mean[6 * l + c] = sum[c] / volume;
    }
  }

 private:
  /// values_c += factor of_modes_c of each lane; what changes the stress is nothing of small strain, whose metric does
  /// not change.
  void add_modes(const double* of_modes, const double* factor, int size, double* values) const {
    if (size == 6 && !stages_.points->is_finite) return;
    for (int c = 0; c < size; ++c)
      for (int l = 0; l < lanes(); ++l) values[c * lanes() + l] += factor[l] * of_modes[c * lanes() + l];
  }
  const double* plastic() const { return modes_flow() ? b_.modes.plastic : nullptr; }
  std::ptrdiff_t at(int p, int c, int l) const { return static_cast<std::ptrdiff_t>(6 * p + c) * lanes() + l; }
  void change_bulk(const double* dE, double* dS) const;
  void correct_points(const double* E_0, const double* E_1, const double* W_0, const double* W_1) const;
  void correct_cells(const double* E_0, const double* E_1, const double* W_0, const double* W_1) const;

  const CellBatches& cells_;
  const BatchStages& stages_;
  const BatchLaw& law_;
  Buffers& b_;
  const Index* offset_ = nullptr;
  Index first_ = 0;
  int count_ = 0;
};

}  // namespace carom
