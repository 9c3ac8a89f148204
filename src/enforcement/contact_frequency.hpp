// A bound of the frequency of contact springs on the masses of their nodes.
#pragma once

#include <span>

#include "system/system.hpp"

namespace carom {

/// The rows as they would be when they close: rows that are open at u (and those alone) without the part of their
/// tangential blocks that turns with the facet, since that is proportional to the gap, which is zero then. Far from
/// touching and beside edges that part may be many times the weights of the nodes.
ConstraintRows as_they_close(const ConstraintRows& rows, std::span<const double> u);

/// Upper bound of omega^2 of the springs of all rows, closed, on the free masses alone. The largest eigenvalue of
/// M^-1 G^T D G with D = (slope of the normal spring at u, eps_T, eps_T) per row is that of the blocks sum over n of
/// A_rn A_sn^T, A_rn = D_r^1/2 G_rn M_n^-1/2, over the nodes n that the rows r and s share. It is at most that of the
/// matrix B_rs = sum over n of |A_rn| |A_sn|, |A|^2 the largest row sum of |A A^T|, and B has no negative entries, so
/// that
///   max over r of (B x)_r / x_r
/// is a bound for every x > 0 (Collatz and Wielandt; Horn and Johnson, Matrix Analysis, theorem 8.1.26). x is that of a
/// few power iterations from 1, which lower the bound. For the consistent mass of parallelepipeds M >= 1/8 of its
/// diagonal is used (Wathen, IMA Journal of Numerical Analysis 7, 1987). 16 passes over the rows, fewer where a bound
/// of `enough` does. 0 without rows.
double contact_frequency_bound(const System& system, const ConstraintRows& rows, std::span<const double> u,
                               double enough = 0.0);

}  // namespace carom
