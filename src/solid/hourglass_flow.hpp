// Hourglass modes of one-point cells of materials that yield, or that are viscous.
#pragma once

#include <cmath>

#include "solid/stages.hpp"

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
struct HourglassReturn {
  double force[most_hourglass];     ///< T, work-conjugate to q
  double returned[most_hourglass];  ///< the part of it that is not viscous
  double plastic[most_hourglass];   ///< q_p at the end
  double share = 1.0;               ///< |returned| over that of an elastic step
  double damper = 0.0;              ///< viscous force over the step's change of q
  double stored = 0.0, lost = 0.0;  ///< energy at the end, and dissipated in the step

  /// `plastic_before` and `q`: `size` numbers, `stride` apart.
  void go(int size, int stride, const double* q, const double* plastic_before, double stiffness, double limit) {
    double square = 0.0;
    share = 1.0;
    damper = 0.0;
    for (int c = 0; c < size; ++c) {
      plastic[c] = plastic_before == nullptr ? 0.0 : plastic_before[c * stride];
      force[c] = stiffness * (q[c * stride] - plastic[c]);
      square += force[c] * force[c];
    }
    if (square > limit * limit) share = limit / std::sqrt(square);
    const double compliance = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
    for (int c = 0; c < size; ++c) {
      plastic[c] += (1.0 - share) * force[c] * compliance;
      returned[c] = force[c] *= share;
    }
    stored = 0.5 * share * share * square * compliance;
    lost = share * (1.0 - share) * square * compliance;
  }

  /// Adds the viscous force of the change from what is remembered in `before` (null: rest): damper (q - q_0); returns
  /// the energy dissipated since the start, by the trapezoidal rule. `before` has the modes, their viscous forces and
  /// that energy.
  double damp(int size, int stride, const double* q, const double* before, double damper_of_step) {
    damper = damper_of_step;
    double work = 0.0;
    for (int c = 0; c < size; ++c) {
      const double change = q[c * stride] - (before == nullptr ? 0.0 : before[c * stride]);
      const double force_before = before == nullptr ? 0.0 : before[(size + c) * stride];
      force[c] += damper * change;
      work += 0.5 * (force_before + damper * change) * change;
    }
    return work + (before == nullptr ? 0.0 : before[2 * size * stride]);
  }
  /// The step is over: adds the viscous force that it ended with.
  void hold(int size, int stride, const double* before) {
    for (int c = 0; c < size; ++c) force[c] += before[(size + c) * stride];
  }
  double viscous_force(int c) const { return force[c] - returned[c]; }

  /// dT of dq: k share (dq - n (n . dq)) where the modes yield, n the direction of what is returned, and damper dq. dT
  /// may stand where dq does.
  void change(int size, int stride, double stiffness, const double* dq, double* dT) const {
    double square = 0.0, product = 0.0;
    for (int c = 0; c < size; ++c) {
      square += returned[c] * returned[c];
      product += returned[c] * dq[c * stride];
    }
    const double along = share < 1.0 && square > 0.0 ? product / square : 0.0;  // molten metal has no force
    for (int c = 0; c < size; ++c)
      dT[c * stride] = (stiffness * share + damper) * dq[c * stride] - stiffness * share * along * returned[c];
  }
};

}  // namespace carom
