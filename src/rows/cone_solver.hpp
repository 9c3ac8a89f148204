// The one complementarity solver: unilateral contact with Coulomb friction, and bonds, on a few rows.
#pragma once

#include <span>
#include <vector>

#include "rows/admissible.hpp"
#include "rows/cone_newton.hpp"
#include "rows/delassus.hpp"

namespace carom {

/// The result of solve_cone: how near it has come to a solution.
struct ConeResult {
  bool converged = false;
  int iterations = 0;     ///< sweeps and linear systems, of the set of coupled rows that took most; 0: start accepted
  double error = 0.0;     ///< largest violation of the conditions, relative (see solve_cone)
  std::size_t worst = 0;  ///< the row of W where that is
};

/// Factors that one call leaves to the next, which is alike: they save time and change nothing but rounding.
struct ConeFactors {
  cone::ActiveSystem active;
  cone::NewtonSystem newton;
};

/// Finds r (r[i] is the force or impulse of row i of W in its frame; start values in, solution out) and w = W r + b so
/// that in every row (normal n, tangents T)
///   0 <= r_n, 0 <= w_n, r_n w_n = 0                                   (Signorini)
///   |r_T| <= mu r_n;  w_T = 0 where |r_T| < mu r_n, else w_T = -s r_T, s >= 0   (Coulomb)
/// Rows with mu = 0 have r_T = 0; bonds have w = 0 instead, whatever r. What w means is the caller's affair:
/// displacement, slip increment or velocity, the gap or the restitution being part of b_n.
///
/// Sets of rows that do not act on each other are problems of their own. Each starts with block Gauss-Seidel sweeps
/// (Jourdan, Alart and Jean, Comput. Methods Appl. Mech. Eng. 155, 1998), whose rows are solved exactly: independent
/// rows are done in one. What follows are proximal steps (Rockafellar, SIAM J. Control Optim. 14, 1976), each on the
/// regular W + rho D: frictionless sets by block principal pivoting (the primal-dual active set of Hintermueller, Ito
/// and Kunisch, SIAM J. Optim. 13, 2003), and where that does not end by projected Newton; sets with friction by
/// semismooth Newton on the projection equations (Alart and Curnier, Comput. Methods Appl. Mech. Eng. 92, 1991) and
/// sweeps in turn. So W need only be semidefinite, as redundant rows make it: w is unique there, r is one of many.
/// Where such rows contradict each other, sticking ones above all, forces that cancel grow until one row gives way. The
/// solution need not be unique for large mu.
///
/// The error is the largest violation of the natural map of a row, min(w_n, W_nn r_n) and W_TT (r_T - projection of
/// r_T - w_T / W_TT on the disc of radius mu r_n), over the largest |b| and |W_ii r_i| of the set. Not converged: no
/// solution exists (nothing can move a row that is closing), b is not finite, a row gives way against its force (W_nn <
/// 0, the error is infinite then), or the iterations ran out; r is then the best found, with 0 <= r_n. Deterministic,
/// and independent of units.
///
/// Iterations end when the error is at most `tolerance`; or at most `accepted` (where that is larger), or a motion of
/// at most `round_off`, and no longer falling: so forces can be had to round-off, wherever that is. The forces are
/// always exact for a b that differs from the given one by the error.
ConeResult solve_cone(const Delassus& W, std::span<const Vec3> b, std::span<const Admissible> sets,
                      std::vector<Vec3>& r, double tolerance = 1e-12, double accepted = 0.0, double round_off = 0.0,
                      ConeFactors* factors = nullptr);
/// Solves the problem whose rows are all cones, with these coefficients of friction.
ConeResult solve_cone(const Delassus& W, std::span<const Vec3> b, std::span<const double> mu, std::vector<Vec3>& r,
                      double tolerance = 1e-12, double accepted = 0.0, double round_off = 0.0,
                      ConeFactors* factors = nullptr);

}  // namespace carom
