// What bounds the stable step of the bodies: frequencies and dampings of their cells.
#pragma once

#include <span>
#include <vector>

#include "solid/solid.hpp"

namespace carom {

/// Upper bound of omega^2 per cell: |A^8|^(1/8) of A = M_e^-1/2 K_e M_e^-1/2 with the lumped mass of the cell, in the
/// largest-row-sum norm (a power sharpens Gershgorin's bound). The largest over the cells bounds the omega^2 of the
/// whole body with lumped mass (Irons). K_e is that of the reference configuration. Cells of the same shape
/// (congruent_cells) share theirs.
std::vector<double> cell_frequency_bounds(const Solid& solid);
/// The largest of them; 0 without cells.
double largest_frequency_bound(const Solid& solid);

/// How many times the omega^2 of each cell is at u what it is at rest, for elastic changes: (c / l)^2 over that at
/// rest, c the fastest elastic wave of its points (PointBatch::wave_modulus) and l its length (BodyCells::lengths)
/// where its nodes stand (Courant, Friedrichs and Lewy, Mathematische Annalen 100, 1928); 1 of cells of small strain.
/// Not a number where a cell is inverted.
void frequency_growth(const Solid& solid, std::span<const double> u, const PointStep& step, std::span<double> growth);

/// Upper bound of the eigenvalues of M^-1 C, C the damping of artificial viscosity at the rates of the last step that
/// the history remembers (empty: at rest), by the lumped masses of the cells in the reference configuration; 1 / time.
/// Of the quadratic term twice the secant, its slope.
double largest_damping(const Solid& solid, std::span<const double> history);

}  // namespace carom
