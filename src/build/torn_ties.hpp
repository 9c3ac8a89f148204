// Ties that cannot hold: sides that part as the run begins, bodies in statics that nothing else holds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "casefile/case.hpp"
#include "contact/contact_geometry.hpp"
#include "model/compatibility.hpp"

namespace carom {

/// Does it hold for any dof that the row sees?
template <class Holds>
bool any_dof(const ConstraintRows& rows, std::size_t r, const Holds& holds) {
  for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      for (const Vec3& line : rows.block[k])
        if (line[c] != 0.0 && holds(3 * static_cast<std::size_t>(rows.node[k]) + c)) return true;
  return false;
}

/// CaseError where an initial displacement or velocity (dof vectors) parts what a tie keeps together: it would have to
/// be torn back before the first step, by energy that nobody asked for. Rounding apart: 1e-9 of the largest entry.
void refuse_torn_ties(const Case& given, const Model& model, const ContactGeometry& contact,
                      std::span<const double> displacement, std::span<const double> velocity);

/// The same of linear equations, the velocity being that of the first stage with inertia, with what its supports
/// impose.
void refuse_broken_equations(const Case& given, const Model& model, const ContactGeometry& contact,
                             std::span<const double> displacement, std::span<const double> velocity);

/// What is known of the velocity of a dof as a later stage begins: nothing, what a support imposes, what the stage
/// gives.
enum class Velocity : std::uint8_t { unknown, imposed, given };

/// The same of velocities that begin with a later stage; where they are given to some of the nodes of a tie or an
/// equation they must be given to all.
void refuse_parting_velocities(const Case& given, const Model& model, const ContactGeometry& contact, std::size_t stage,
                               std::span<const double> velocity, const std::vector<Velocity>& known);

/// CaseError where a tie joins two bodies that no support holds, which statics does not find the place of; and where a
/// tie alone is to hold one by multipliers. `free_bodies`: nodes of the bodies that can move (FreeModes), of all
/// `nodes`.
void refuse_floating_ties(const Case& given, const Model& model, const ContactGeometry& contact,
                          EnforcementKind enforcement, const std::vector<std::vector<Index>>& free_bodies,
                          std::size_t nodes);

}  // namespace carom
