// Bulk viscosity: a pressure against fast changes of a cell's volume, which smears shocks over a few cells.
#pragma once

namespace carom {

/// What a cell remembers of its bulk viscosity, all 0 at rest.
struct BulkHistory {
  double change = 0.0;    ///< j - 1, j its volume over that at rest
  double pressure = 0.0;  ///< q, positive in tension
  double lost = 0.0;      ///< dissipated since the start, over V_0
  double stretch = 0.0;   ///< the least of its points, less 1: by which its length has changed
  double speed = 0.0;     ///< l d, by which its far sides part
};
inline constexpr int bulk_history = 5;

/// The viscous pressure of one cell:
///   q = rho l d (b_1 c - b_2^2 l min(0, d)), d = j' / j, rho = rho_0 / j
/// (von Neumann and Richtmyer, J. Appl. Phys. 21, 1950; the linear term: Landshoff, Los Alamos report LA-1930, 1955),
/// j' = (j_1 - j_0) / dt of the step, so that explicit steps take the rate at their middle, and l the length at rest
/// times the least stretch at the beginning of the step. Its forces are q dV/du; the work of q is booked as that of all
/// internal forces, by the trapezoidal rule. Plane stress has the area for the volume, bars the length.
struct BulkReturn {
  double slope = 0.0;  ///< dq/dj_1

  /// `linear`: b_1 c; `quadratic`: b_2^2. `end` has the change and the stretch at the end, and receives the rest.
  /// Without a step nothing flows.
  void go(const BulkHistory& begin, double dt, double rho, double length, double linear, double quadratic,
          BulkHistory& end) {
    end.lost = begin.lost;
    if (!(dt > 0.0)) return;
    const double j = 1.0 + end.change, l = length * (1.0 + begin.stretch);
    const double rate = (end.change - begin.change) / (dt * j), closing = rate < 0.0 ? -rate : 0.0;
    end.pressure = rho / j * l * rate * (linear + quadratic * l * closing);
    end.speed = l * rate;
    const double by_rate = rho / j * l * (linear + 2.0 * quadratic * l * closing);
    slope = by_rate * (1.0 / dt - rate) / j - end.pressure / j;
    end.lost += 0.5 * (begin.pressure + end.pressure) * (end.change - begin.change);
  }
};

}  // namespace carom
