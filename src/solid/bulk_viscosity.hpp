// Bulk viscosity: a pressure against fast changes of a cell's volume, which smears shocks over a few cells.
#pragma once

namespace carom {

/// What a cell remembers: its volume over that at rest, less 1; the rate of that in the step; the energy that its
/// viscosity has dissipated.
inline constexpr int bulk_history = 3;

/// The viscous pressure of one cell, j = V / V_0 its volume over that at rest and j' = (j_1 - j_0) / dt:
///   q = rho_0 l_0 (b_1 c j' - b_2^2 l_0 j' min(0, j')) / j,
/// which is rho l (b_1 c d - b_2^2 l d min(0, d)) of d = j' / j with the density rho_0 / j and the length l_0 j of a
/// cell that a plane wave compresses (von Neumann and Richtmyer, J. Appl. Phys. 21, 1950; the linear term: Landshoff,
/// Los Alamos report LA-1930, 1955). Its forces are q dV/du. The rate is that of the step, so that explicit steps take
/// it at their middle; the work of q is booked as that of all internal forces, by the trapezoidal rule. Plane stress
/// has the area for the volume, bars the length.
struct BulkReturn {
  double linear = 0.0, quadratic = 0.0;  ///< rho_0 l_0 b_1 c and rho_0 (b_2 l_0)^2
  double rate = 0.0;                     ///< j'
  double pressure = 0.0;                 ///< q, positive in tension
  double slope = 0.0;                    ///< dq/dj_1
  double lost = 0.0;                     ///< in the step, over V_0

  /// The step is over: q of the rate that it had.
  void stay(double rate_of_step, double after) {
    rate = rate_of_step;
    pressure = pressure_of(rate, after);
  }
  /// before, after: j - 1; rate_before: of the step before. Without a step nothing flows.
  void go(double before, double rate_before, double after, double dt) {
    if (!(dt > 0.0)) return;
    rate = (after - before) / dt;
    pressure = pressure_of(rate, after);
    slope = (linear + 2.0 * quadratic * closing(rate)) / (dt * (1.0 + after)) - pressure / (1.0 + after);
    lost = 0.5 * (pressure_of(rate_before, before) + pressure) * (after - before);
  }

 private:
  static double closing(double of_rate) { return of_rate < 0.0 ? -of_rate : 0.0; }
  double pressure_of(double of_rate, double change) const {
    return (linear + quadratic * closing(of_rate)) * of_rate / (1.0 + change);
  }
};

}  // namespace carom
