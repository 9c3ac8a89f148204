// Two elastic bars meet end to end: the waves that leave their contact faces, and the force between them.
#pragma once

#include <array>
#include <vector>

#include "exact/piecewise_linear.hpp"

namespace carom {

/// A bar seen from its contact face; any consistent units. Infinity for impedance and round_trip, and zero for the
/// rest, make it a rigid wall at rest.
struct BarFace {
  double impedance = 0.0;     ///< Z = rho c A, force per velocity
  double round_trip = 0.0;    ///< T = 2 L / c
  double velocity = 0.0;      ///< of all points at t = 0, positive from the left bar to the right one
  double acceleration = 0.0;  ///< by a uniform field, same sign
};

/// Zero gap over [begin, end].
struct ContactPhase {
  double begin = 0.0;
  double end = 0.0;
  double impulse = 0.0;  ///< integral of the force; 0 for a grazing phase
};

/// What happens between the faces for 0 <= t <= until.
struct FaceContact {
  std::array<PiecewiseLinear, 2> waves;  ///< f_i: the left bar, the right bar
  PiecewiseLinear force;                 ///< F >= 0, compressive
  /// In order of time. Consecutive phases with and without pressure stand apart; one that lasts beyond until ends
  /// there.
  std::vector<ContactPhase> phases;
  std::vector<double> releases;  ///< times at which a gap opens
};

/// Exact solution by characteristics. The velocity of bar i is a_i t plus a wave f_i that leaves the face and its
/// reflection at the free end, so that at the face
///   v_i(t) = a_i t + f_i(t) + f_i(t - T_i),  f_i(t) = f_i(t - T_i) -+ F / Z_i  (- left, + right bar)
/// (Achenbach, Wave Propagation in Elastic Solids, 1973, chapter 1). Let w be the speed at which the faces
/// would approach if F were zero. With zero gap and w >= 0 they move together under F = w / (1/Z_1 + 1/Z_2); else
/// F = 0. All functions are linear between events: a front comes back to the face, the gap closes, the force
/// vanishes. When fronts of both bars come back at one time they act together.
///
/// Grazing: w = 0 with zero gap. The force is then exactly 0, the gap stays exactly 0 and the faces keep one velocity
/// until a front makes w negative (they part) or positive (they press); a grazing phase is a contact phase with
/// impulse 0. Speeds below 1e-12 of the largest one met count as zero, as do times below 1e-12 (T_1 + T_2), so that
/// fronts that coincide in exact arithmetic do so here.
///
/// gap >= 0 is the gap at t = 0. Not both faces may be walls.
FaceContact solve_face_contact(const BarFace& left, const BarFace& right, double gap, double until);

}  // namespace carom
