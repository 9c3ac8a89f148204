// Hourglass modes of one-point cells of materials that yield, or that are viscous, over a number type.
#pragma once

#include <limits>

#include "kernels/stages.hpp"
#include "math/pack.hpp"

// Internal linkage throughout: see math/pack.hpp.
namespace carom {

/// Numbers that a cell remembers of its modes: their plastic parts and the energy that these have dissipated, of
/// stabilised cells 1 - share instead of it (ModeStages::begin); of viscous modes how far they are deformed, their
/// viscous forces, and what viscosity has dissipated.
inline int hourglass_history(const CellStages& cell, bool is_viscous) {
  const int size = cell.modes * cell.directions;
  return size == 0 ? 0 : size + 1 + (is_viscous ? 2 * size + 1 : 0);
}

/// The modes of one cell behave as `coefficient` times the cell's volume V of an elastic, perfectly plastic body of the
/// cell's shear modulus G, whose shear strain is |q - q_p| sqrt(kappa / V), q = F^T gamma_a u_a the modes as they enter
/// the Green-Lagrange strain (small strain: F = 1), kappa the cell's stiffness of coefficient x modulus = 1: forces
/// k (q - q_p), k = coefficient G kappa, returned radially to the size coefficient sqrt(kappa V) sigma_y / sqrt(3),
/// with the yield stress of the cell's point at the beginning of the step. So the stabilisation resists flow with a
/// share of the material's own strength and not with its elastic stiffness (physical stabilisation: Belytschko and
/// Bindeman, Comput. Methods Appl. Mech. Eng. 105, 1993; Puso, Int. J. Numer. Methods Eng. 49, 2000).
///
/// Viscous modes have the force viscosity G kappa (l / c) dq/dt besides, l the cell's length and c the speed of waves
/// at rest, with the rate of the step (viscous control: Flanagan and Belytschko, Int. J. Numer. Methods Eng. 17, 1981).
template <class Real, int size>
struct HourglassReturn {
  Real force[size];                  ///< that works with q
  Real returned[size];               ///< the part of it that is not viscous
  Real plastic[size];                ///< q_p at the end
  Real share = Real{} + 1.0;         ///< |returned| over that of an elastic step
  Real damper{};                     ///< viscous force over the step's change of q
  Real stored{}, lost{}, viscous{};  ///< energy at the end, and dissipated: in the step, by viscosity since the start

  /// `before`: q_p; null: 0.
  [[gnu::always_inline]] inline void go(const Real q[size], const double* before, const Real& stiffness,
                                        const Real& limit) {
    const Real zero{}, one = zero + 1.0;
    Real square{};
    for (int c = 0; c < size; ++c) {
      plastic[c] = before == nullptr ? zero : load<Real>(before + c * lanes<Real>);
      force[c] = stiffness * (q[c] - plastic[c]);
      square += force[c] * force[c];
    }
    const Real root = square_root(square), compliance = 1.0 / (stiffness > 0.0 ? stiffness : one);
    share = root > limit ? limit / (root > limit ? root : one) : one;
    const Real of_plastic = stiffness > 0.0 ? (1.0 - share) * compliance : zero;
    for (int c = 0; c < size; ++c) {
      plastic[c] += of_plastic * force[c];
      returned[c] = force[c] *= share;
    }
    stored = stiffness > 0.0 ? 0.5 * share * share * square * compliance : zero;
    lost = share * of_plastic * square;
  }

  /// Adds the viscous force damper (q - q_0) of the change from what is remembered in `before` (null: rest), the modes,
  /// their viscous forces and the energy dissipated since the start, by the trapezoidal rule.
  [[gnu::always_inline]] inline void damp(const Real q[size], const double* before, const Real& damper_of_step) {
    constexpr int n = lanes<Real>;
    damper = damper_of_step;
    viscous = before == nullptr ? Real{} : load<Real>(before + 2 * size * n);
    for (int c = 0; c < size; ++c) {
      const Real change = before == nullptr ? q[c] : q[c] - load<Real>(before + c * n), added = damper * change;
      const Real force_before = before == nullptr ? Real{} : load<Real>(before + (size + c) * n);
      force[c] += added;
      viscous += 0.5 * (force_before + added) * change;
    }
  }
  /// The step is over: adds the viscous force that it ended with, and keeps what had been dissipated then.
  [[gnu::always_inline]] inline void hold(const double* before) {
    viscous = load<Real>(before + 2 * size * lanes<Real>);
    for (int c = 0; c < size; ++c) force[c] += load<Real>(before + (size + c) * lanes<Real>);
  }
};

/// The change of forces of dq: k share (dq - n (n . dq)) where the modes yield, n the direction of what is returned,
/// and damper dq.
template <class Real, int size>
[[gnu::always_inline]] static inline void change_returned(const Real returned[size], const Real& stiffness,
                                                          const Real& share, const Real& damper, const Real dq[size],
                                                          Real change[size]) {
  const Real zero{}, one = zero + 1.0;
  Real square{}, product{};
  for (int c = 0; c < size; ++c) {
    square += returned[c] * returned[c];
    product += returned[c] * dq[c];
  }
  const Real yields = share < 1.0 ? square : zero;  // molten metal has no force
  const Real along = yields > 0.0 ? product / (yields > 0.0 ? yields : one) : zero;
  for (int c = 0; c < size; ++c)
    change[c] = (stiffness * share + damper) * dq[c] - stiffness * share * along * returned[c];
}

namespace hourglass_flow {

template <class Real, int size>
[[gnu::always_inline]] static inline void load_all(const double* values, Real (&out)[size]) {
  for (int c = 0; c < size; ++c) out[c] = load<Real>(values + c * lanes<Real>);
}
template <class Real, int size>
[[gnu::always_inline]] static inline void store_all(double* values, const Real& factor, const Real (&in)[size]) {
  for (int c = 0; c < size; ++c) store(values + c * lanes<Real>, Real(factor * in[c]));
}

template <class Real, class Cell>
static void give(const double* geometry, const ModeFlow& flow, const double* z, const double* yield_stress,
                 const double* length, const double* before, double* after, ModeReturn& out) {
  constexpr int n = lanes<Real>, size = Cell::modes * Cell::directions;
  const auto& of_cell = *reinterpret_cast<const typename Cell::template Geometry<Real>*>(geometry);
  const Real one = Real{} + 1.0, volume = of_cell.weight[0], kappa = of_cell.stiffness;
  Real limit = Real{} + std::numeric_limits<double>::infinity();
  if (yield_stress != nullptr && !flow.is_over)
    limit = flow.coefficient * square_root(Real((1.0 / 3.0) * kappa * volume)) * load<Real>(yield_stress);
  const Real stiffness = flow.coefficient * flow.modulus * kappa;
  const double* rest = before == nullptr ? nullptr : before + (size + 1) * n;
  Real q[size];
  load_all(z, q);
  HourglassReturn<Real, size> modes;
  modes.go(q, before, stiffness, limit);
  if (before != nullptr) modes.lost += load<Real>(before + size * n);
  if (flow.is_viscous && flow.is_over && rest != nullptr)
    modes.hold(rest);
  else if (flow.is_viscous)
    modes.damp(q, rest, Real(flow.viscosity * kappa * load<Real>(length)));
  store_all(out.T, Real(1.0 / volume), modes.force);
  store_all(out.returned, one, modes.returned);
  store(out.stiffness, stiffness);
  store(out.share, modes.share);
  store(out.damper, modes.damper);
  store(out.stored, modes.stored);
  store(out.lost, modes.lost);
  store(out.viscous, modes.viscous);
  if (after == nullptr) return;
  store_all(after, one, modes.plastic);
  store(after + size * n, modes.lost);
  if (!flow.is_viscous) return;
  store_all(after + (size + 1) * n, one, q);
  for (int c = 0; c < size; ++c) store(after + (2 * size + 1 + c) * n, Real(modes.force[c] - modes.returned[c]));
  store(after + (3 * size + 1) * n, modes.viscous);
}

template <class Real, class Cell>
static void change(const double* geometry, const ModeReturn& modes, const double* dz, double* dT) {
  constexpr int size = Cell::modes * Cell::directions;
  Real returned[size], dq[size], of_forces[size];
  load_all(modes.returned, returned);
  load_all(dz, dq);
  change_returned<Real, size>(returned, load<Real>(modes.stiffness), load<Real>(modes.share), load<Real>(modes.damper),
                              dq, of_forces);
  store_all(dT, Real(1.0 / load<Real>(geometry)), of_forces);
}

template <class Real, class Cell>
static constexpr ModeFlowStages stages() {
  return {give<Real, Cell>, change<Real, Cell>};
}

}  // namespace hourglass_flow

}  // namespace carom
