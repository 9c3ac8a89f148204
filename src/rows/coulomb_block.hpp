// One row, solved exactly: of contact with Coulomb friction, or of a bond.
#pragma once

#include "base/types.hpp"
#include "rows/delassus.hpp"

namespace carom {

/// The force r of one row for w = W r + q (components normal, tangent_1, tangent_2), W symmetric positive semidefinite
/// with W_nn > 0: open where q_n >= 0; else stick, r = -W^-1 q, where that lies in the cone |r_T| <= mu r_n; else slip,
/// r = r_n (1, -mu w_T / |w_T|), found as a root in the angle of the slip: with the direction d of r_T, a quadratic in
/// (cos, sin) (Bonnefon and Daviet, Quartic formulation of Coulomb 3D frictional contact, INRIA RT-0400, 2011).
/// Components without compliance (W_tt = 0, as the third one in plane models) get no force in stick. mu = 0 gives
/// r_T = 0.
Vec3 solve_coulomb(const FrameBlock& W, const Vec3& q, double mu);

/// The force r of one bond: W r + q = 0, components without compliance getting none.
Vec3 solve_bond(const FrameBlock& W, const Vec3& q);

}  // namespace carom
