// Choices of a contact, shared by the case format and the model.
#pragma once

#include <cstdint>

namespace carom {

/// What is done about rows that penetrate in the initial state.
enum class InitialPenetration : std::uint8_t { refuse, strain_free_offset, prestress };

/// How the rows of a pair of deformable surfaces are made: one row per slave node at its closest point on the master
/// surface; the same with the roles exchanged as well; or one row per slave node, averaged over its facets' overlaps
/// with the master surface (mortar).
enum class PairMethod : std::uint8_t { node_to_surface, two_pass, surface_to_surface };

/// How the damper of a stop acts while it touches: never so that its sum with the spring pulls, or in both directions.
enum class DamperActs : std::uint8_t { compression, two_sided };

}  // namespace carom
