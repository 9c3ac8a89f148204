// Penalty enforcement of unilateral contact with regularised Coulomb friction and normal damping.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "rows/constraint_rows.hpp"
#include "rows/response.hpp"

namespace carom {

/// Which part of its sliding a row's friction counts in the step that closes it.
enum class CountedSlip : std::uint8_t { after_touch, whole_step };

/// The penalty port of contact (Wriggers, Computational Contact Mechanics, 2nd ed., sections 5.2 and 10.5):
///   p = eps_N <-g>, and with a damper p = max(0, -eps_N g - c dg/dt) in the steps that begin with the row closed: a
///   damper that acted at first touch would make the force jump within an implicit step, which then has no solution
///   (of two sides: p = eps_N <-g> - c dg/dt, which may pull), with RowLaw::spring_force for eps_N <-g>;
///   trial t = eps_T (s_e + c (w_T(x) - w_T(x_begin))), returned to |t| <= mu p; open rows forget their slip;
///   c = 1, but in a step that closes the row c = g / (g - g_begin): what is left of a straight path after first touch
///   (CountedSlip::after_touch). Without inertia the path has a corner at the touch, where the body stops and slides
///   on: all of the step's sliding counts then, as it does for multipliers (CountedSlip::whole_step).
/// Fills the forces at displacement x and velocity v on rows that were made at x. The given history (one entry per
/// slot) is that at displacement x_begin; slots without a closed row forget theirs. Bonds are left without force
/// (bond_springs.hpp, BondedMass).
void penalty_response(std::shared_ptr<const ConstraintRows> rows, std::span<const double> x_begin,
                      std::span<const double> x, std::span<const double> v, std::span<const RowHistory> history,
                      ContactResponse& response, CountedSlip slip = CountedSlip::after_touch);

/// The tangent of row r for the same arguments, while the rows are kept and the velocity follows the displacement with
/// the slope dv_dx.
RowTangent penalty_tangent(const ConstraintRows& rows, std::size_t r, std::span<const double> x_begin,
                           std::span<const double> x, std::span<const double> v, std::span<const RowHistory> history,
                           double dv_dx, CountedSlip slip = CountedSlip::after_touch);

/// y += G^T diag(eps_N, eps_T, eps_T) G x with every row closed: the stiffness that the stable step must allow for,
/// where bonds have none (BondedMass).
void add_closed_stiffness(const ConstraintRows& rows, std::span<const double> x, std::span<double> y);
/// d += the diagonal of that stiffness, and of the springs of bonds; d has one entry per dof.
void add_closed_diagonal(const ConstraintRows& rows, std::span<double> d);

}  // namespace carom
