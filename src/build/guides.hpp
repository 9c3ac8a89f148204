// Guides and hinges that hold rigid bodies along or about axes.
#pragma once

#include <string>

#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

/// Adds the equations between the four nodes of a body that hold it, which are linear at finite rotations too: with
/// u_a the displacements of the nodes, X the point that is held and N_a its weights (TurningBody),
///   along the axis c:   sum over a of N_a(X) u_a,c = 0,
///   about all but k:    the material direction d^k that is e_k at first keeps its direction, d^k_c - delta_kc = 0 for
///                       both c that are not k,
///   about all:          d^i_j = d^j_i for the three pairs, the polar decomposition of the directors has no rotation,
/// where d^k - e_k = sum over a of (sum over i of (e_k . axis_i) s_ai / (4 r_i)) u_a. Their forces do no work.
/// Precondition: the nodes of the body are known.
void add_guide(const CaseGuide& guide, const TurningBody& body, const Location& where, Model& model);

/// Throws CaseError where a body of a section ("contact", "rigid_body") that begins with these velocities of its centre
/// of mass and about it would move against its guide.
void refuse_guided_motion(const CaseGuide& guide, const std::string& section, const std::string& name,
                          const Vec3& centre, const Vec3& velocity, const Vec3& angular_velocity);

}  // namespace carom
