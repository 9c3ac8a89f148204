// The kernels of any cell out of its stages, batch after batch.
#include <algorithm>
#include <utility>

#include "base/types.hpp"
#include "kernels/staged_batch.hpp"
#include "material/discrete_gradient.hpp"

namespace carom {

/// Of the strain E of the kinematics: the viscous pressure and what is remembered of it.
void Batch::return_bulk() const {
  Bulk& bulk = b_.bulk;
  stages_.bulk->volume(points(), b_.geometry, b_.strain, bulk.change, bulk.stretch, bulk.g);
  const int n = lanes();
  const double* history = slot(MemorySlot::viscosity, cells_.history);
  double* new_history = slot(MemorySlot::viscosity, cells_.new_history);
  for (int l = 0; l < n; ++l) {
    double volume = 0.0;
    for (int p = 0; p < points(); ++p) volume += weight(p, l);
    double begin[bulk_history] = {};
    for (int k = 0; history != nullptr && k < bulk_history; ++k) begin[k] = history[k * n + l];
    const BulkHistory before{begin[0], begin[1], begin[2], begin[3], begin[4]};
    BulkHistory after{.change = bulk.change[l] / volume, .stretch = bulk.stretch[l]};
    BulkReturn of_lane;
    if (cells_.is_over)
      after = before;
    else
      of_lane.go(before, cells_.viscous_dt, stages_.rho, cells_.length[first_ + l],
                 stages_.viscosity.linear * stages_.wave_speed,
                 stages_.viscosity.quadratic * stages_.viscosity.quadratic, after);
    bulk.pressure[l] = after.pressure;
    bulk.slope[l] = of_lane.slope / volume;
    bulk.lost[l] = after.lost * volume;
    if (new_history == nullptr) continue;
    const double end[bulk_history] = {after.change, after.pressure, after.lost, after.stretch, after.speed};
    for (int k = 0; k < bulk_history; ++k) new_history[k * n + l] = end[k];
  }
}

/// dS = dq g + q dg of dE.
void Batch::change_bulk(const double* dE, double* dS) const {
  alignas(64) double dg[6 * most_points * most_lanes];
  const Bulk& bulk = b_.bulk;
  alignas(64) double dq[most_lanes];
  stages_.bulk->volume_change(points(), b_.geometry, bulk.g, dE, dq);
  for (int l = 0; l < lanes(); ++l) dq[l] *= bulk.slope[l];
  stages_.bulk->gradient_change(points(), bulk.g, dE, dg);
  std::fill_n(dS, 6 * points() * lanes(), 0.0);
  stages_.bulk->add_scaled(points(), dq, bulk.g, dS);
  stages_.bulk->add_scaled(points(), bulk.pressure, dg, dS);
}

/// P = F_mid S with F_mid the mean of both F and S the discrete gradient of the energy by E between E_0 and E_1
/// (material/discrete_gradient.hpp). Under mean dilatation the energy is a function of the strains of all points of the
/// cell, and so is its discrete gradient: S_p += [W_1 - W_0 - sum_q w_q S_q : dE_q] / (sum_q w_q |dE_q|^2) dE_p.
/// Stabilised modes z = F^T q add to W, and change by F_mid^T dq + dF^T q_mid, so that T at the middle works with both;
/// what is missing is made up for along E as well, since at a given E the energy is quadratic in z.
void Batch::add_discrete_gradient_force(const double* u_0, const double* u_1, double* f) const {
  constexpr int size = most_points * most_lanes;
  alignas(64) double E_0[6 * size], E_1[6 * size], F_1[9 * size], seen[6 * size], W_0[size], W_1[size];
  const int values = points() * lanes();
  kinematics(u_0, b_.gradient, E_0);
  alignas(64) double q_0[most_stabilised * most_lanes];
  std::copy_n(b_.q, hourglass_numbers() * lanes(), q_0);
  kinematics(u_1, F_1, E_1);
  for (const auto& [E, W] : {std::pair{E_0, W_0}, std::pair{E_1, W_1}}) {
    std::copy_n(E, 6 * values, seen);
    to_law(seen);
    constitutive(seen, b_.stress, W, nullptr, false);
  }
  alignas(64) double z_0[most_stabilised * most_lanes], z_1[most_stabilised * most_lanes];
  if (is_stabilised()) {
    add_mode_energy(b_.gradient, E_0, q_0, z_0, W_0);
    add_mode_energy(F_1, E_1, b_.q, z_1, W_1);
  }
  for (int c = 0; c < 6 * values; ++c) b_.strain[c] = 0.5 * (E_0[c] + E_1[c]);
  for (int c = 0; c < 9 * values; ++c) b_.gradient[c] = 0.5 * (b_.gradient[c] + F_1[c]);
  to_law(b_.strain);
  constitutive(b_.strain, b_.stress, nullptr, nullptr, false);
  from_law(b_.strain, b_.stress);
  if (is_stabilised()) {
    for (int c = 0; c < hourglass_numbers() * lanes(); ++c) b_.modes.z[c] = 0.5 * (z_0[c] + z_1[c]);
    std::fill_n(b_.modes.share, lanes(), 1.0);
    try_forces();
    for (int c = 0; c < hourglass_numbers() * lanes(); ++c) W_1[c % lanes()] -= b_.modes.T[c] * (z_1[c] - z_0[c]);
    add_modes(b_.modes.S, b_.modes.share, 6, b_.stress);
  }
  if (stages_.points->is_finite) {
    if (stages_.dilatation == nullptr)
      correct_points(E_0, E_1, W_0, W_1);
    else
      correct_cells(E_0, E_1, W_0, W_1);
  }
  stages_.points->stress(points(), frame(), b_.gradient, b_.stress, b_.P);
  for (int c = 0; c < hourglass_numbers() * lanes(); ++c) b_.q[c] = 0.5 * (b_.q[c] + q_0[c]);
  if (is_stabilised())
    push_modes();
  else
    elastic_modes();
  scatter(b_.Q, f);
}

/// Of the parts of a patch: the stress that its point has with all modes acts on the gradients of the wanted cells, the
/// modes' forces are those of the wanted cells.
void Batch::add_internal_force_of_parts(const double* u, const unsigned char* wanted, double* f) const {
  const ModeStages& stabilisation = stages_.cell->stabilisation;
  evaluate(u, false);
  complete_stress();
  stages_.points->stress(points(), frame(), b_.gradient, b_.stress, b_.P);
  push_modes();
  stabilisation.relative(b_.geometry, -1.0, b_.Q, b_.P);
  stabilisation.keep_cells(b_.geometry, wanted);
  try_forces();
  alignas(64) double unused[9 * most_lanes] = {};
  stabilisation.push(b_.geometry, finite(b_.gradient), b_.q, b_.modes.T, b_.modes.share, b_.Q, unused);
  stabilisation.relative(b_.geometry, 1.0, b_.Q, b_.P);
  scatter(b_.Q, f);
}

void Batch::correct_points(const double* E_0, const double* E_1, const double* W_0, const double* W_1) const {
  for (int p = 0; p < points(); ++p)
    for (int l = 0; l < lanes(); ++l) {
      double e_0[6], e_1[6], S[6];
      for (int c = 0; c < 6; ++c) {
        e_0[c] = E_0[at(p, c, l)];
        e_1[c] = E_1[at(p, c, l)];
        S[c] = b_.stress[at(p, c, l)];
      }
      discrete_gradient_stress(e_0, e_1, S, W_0[p * lanes() + l], W_1[p * lanes() + l], S);
      for (int c = 0; c < 6; ++c) b_.stress[at(p, c, l)] = S[c];
    }
}

void Batch::correct_cells(const double* E_0, const double* E_1, const double* W_0, const double* W_1) const {
  constexpr double nearest_square = 1e-10;  // as discrete_gradient_stress
  for (int l = 0; l < lanes(); ++l) {
    double bracket = 0.0, square = 0.0, mean_square = 0.0;
    for (int p = 0; p < points(); ++p) {
      double missing = W_1[p * lanes() + l] - W_0[p * lanes() + l];
      for (int c = 0; c < 6; ++c) {
        const double e_0 = E_0[at(p, c, l)], e_1 = E_1[at(p, c, l)], tensor = c < 3 ? 1.0 : 0.5;
        missing -= b_.stress[at(p, c, l)] * (e_1 - e_0);
        square += weight(p, l) * tensor * (e_1 - e_0) * (e_1 - e_0);
        mean_square += weight(p, l) * tensor * 0.25 * (e_0 + e_1) * (e_0 + e_1);
      }
      bracket += weight(p, l) * missing;
    }
    const double factor = square > nearest_square * mean_square ? bracket / square : 0.0;
    for (int p = 0; p < points(); ++p)
      for (int c = 0; c < 6; ++c)
        b_.stress[at(p, c, l)] += (c < 3 ? 1.0 : 0.5) * factor * (E_1[at(p, c, l)] - E_0[at(p, c, l)]);
  }
}

namespace {

/// Calls body(batch) for each batch of the cells.
template <class Body>
void for_each_batch(const CellBatches& cells, const BatchLaw& law, const Body& body) {
  Buffers buffers;
  Batch batch(cells, law, buffers);
  for (Index first = 0; first < cells.cells; first += batch.lanes()) {
    batch.place(first);
    body(batch);
  }
}

void add_internal_force(const CellBatches& cells, const BatchLaw& law, const double* u, double* f,
                        SolidEnergies* energies) {
  for_each_batch(cells, law, [&](const Batch& batch) { batch.add_internal_force(u, f, energies); });
}

void add_tangent_action(const CellBatches& cells, const BatchLaw& law, const double* u, const double* x, double* y) {
  for_each_batch(cells, law, [&](const Batch& batch) { batch.add_tangent_action(u, x, y); });
}

void add_discrete_gradient_force(const CellBatches& cells, const BatchLaw& law, const double* u_0, const double* u_1,
                                 double* f) {
  for_each_batch(cells, law, [&](const Batch& batch) { batch.add_discrete_gradient_force(u_0, u_1, f); });
}

void mean_stress(const CellBatches& cells, const BatchLaw& law, const double* u, double* stress) {
  for_each_batch(cells, law, [&](const Batch& batch) {
    batch.mean_stress(u, stress);
    stress += 6 * batch.count();
  });
}

}  // namespace

void wave_modulus(const CellBatches& cells, const BatchLaw& law, const double* u, double* modulus) {
  for_each_batch(cells, law, [&](const Batch& batch) {
    batch.wave_modulus(u, modulus);
    modulus += batch.count();
  });
}

void add_internal_force_of_parts(const CellBatches& cells, const BatchLaw& law, const double* u,
                                 const unsigned char* wanted, double* f) {
  for_each_batch(cells, law, [&](const Batch& batch) { batch.add_internal_force_of_parts(u, wanted, f); });
}

const CellKernels staged_kernels{add_internal_force, add_tangent_action, nullptr, add_discrete_gradient_force,
                                 mean_stress};

}  // namespace carom
