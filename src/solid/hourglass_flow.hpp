// Hourglass modes of one-point cells of materials that yield.
#pragma once

#include <cmath>

#include "solid/stages.hpp"

namespace carom {

/// Numbers of all modes of a cell at most: 4 modes, 3 directions.
inline constexpr int most_hourglass = 12;

/// What a cell remembers of its modes: their plastic parts, and the energy that they have dissipated.
inline int hourglass_history(const CellStages& cell) {
  return cell.modes == 0 ? 0 : cell.modes * cell.directions + 1;
}

/// The modes of one cell behave as `coefficient` times the cell's volume V of an elastic, perfectly plastic body of the
/// cell's shear modulus G, whose shear strain is |q - q_p| sqrt(kappa / V), q = F^T gamma_a u_a the modes as they enter
/// the Green-Lagrange strain (small strain: F = 1), kappa the cell's stiffness of coefficient x modulus = 1: forces
/// k (q - q_p), k = coefficient G kappa, returned radially to the size coefficient sqrt(kappa V) sigma_y / sqrt(3),
/// with the yield stress of the cell's point at the beginning of the step. So the stabilisation resists flow with a
/// share of the material's own strength and not with its elastic stiffness (physical stabilisation: Belytschko and
/// Bindeman, Comput. Methods Appl. Mech. Eng. 105, 1993; Puso, Int. J. Numer. Methods Eng. 49, 2000).
struct HourglassReturn {
  double force[most_hourglass];     ///< T, work-conjugate to q
  double plastic[most_hourglass];   ///< q_p at the end
  double share = 1.0;               ///< |T| over that of an elastic step
  double stored = 0.0, lost = 0.0;  ///< energy at the end, and dissipated in the step

  /// `plastic_before` and `q`: `size` numbers, `stride` apart.
  void go(int size, int stride, const double* q, const double* plastic_before, double stiffness, double limit) {
    double square = 0.0;
    share = 1.0;
    for (int c = 0; c < size; ++c) {
      plastic[c] = plastic_before == nullptr ? 0.0 : plastic_before[c * stride];
      force[c] = stiffness * (q[c * stride] - plastic[c]);
      square += force[c] * force[c];
    }
    if (square > limit * limit) share = limit / std::sqrt(square);
    const double compliance = stiffness > 0.0 ? 1.0 / stiffness : 0.0;
    for (int c = 0; c < size; ++c) {
      plastic[c] += (1.0 - share) * force[c] * compliance;
      force[c] *= share;
    }
    stored = 0.5 * share * share * square * compliance;
    lost = share * (1.0 - share) * square * compliance;
  }

  /// dT of dq: k share (dq - n (n . dq)) where the modes yield, n the direction of T. dT may stand where dq does.
  void change(int size, int stride, double stiffness, const double* dq, double* dT) const {
    double square = 0.0, product = 0.0;
    for (int c = 0; c < size; ++c) {
      square += force[c] * force[c];
      product += force[c] * dq[c * stride];
    }
    const double along = share < 1.0 && square > 0.0 ? product / square : 0.0;  // molten metal has no force
    for (int c = 0; c < size; ++c) dT[c * stride] = stiffness * share * (dq[c * stride] - along * force[c]);
  }
};

}  // namespace carom
