// Choices that the case format shares with the model and the solvers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace carom {

/// What the cells of a part are a section of. Plane cells (QUAD4) lie in the x-y plane, numbered counter-clockwise;
/// axisymmetric ones turn about the y axis, with x >= 0 the radius, and stand for the whole circumference (2 pi x);
/// bars are LINE2 in space.
enum class Section : std::uint8_t { solid, plane_strain, plane_stress, axisymmetric, bar };

/// How many of the last of x, y, z are without stress.
constexpr int free_directions(Section section) {
  if (section == Section::bar) return 2;
  return section == Section::plane_stress ? 1 : 0;
}

/// What is imposed on one component of a group of nodes.
enum class MotionKind : std::uint8_t { displacement, velocity, acceleration, rotation };

constexpr const char* name(MotionKind kind) {
  return std::array{"displacement", "velocity", "acceleration", "rotation"}[static_cast<std::size_t>(kind)];
}

/// Who solves the linear systems of implicit steps.
enum class SolverKind : std::uint8_t { automatic, conjugate_gradients, multigrid, cholesky, ldlt };

/// What is done about rows that penetrate in the initial state.
enum class InitialPenetration : std::uint8_t { refuse, strain_free_offset, prestress };

/// How the rows of a pair of deformable surfaces are made: one row per slave node at its closest point on the master
/// surface; the same with the roles exchanged as well; or one row per slave node, averaged over its facets' overlaps
/// with the master surface (mortar); or the penetration integrated over the overlaps, from both sides, beside nodes
/// of sharp edges (springs), and mean gaps over the finer side with nodes of both sides as guards (what multipliers and
/// impulses hold).
enum class PairMethod : std::uint8_t { node_to_surface, two_pass, surface_to_surface, faces };

/// True when both sides of a pair have rows of their own, each with half of the stiffness.
constexpr bool has_both_passes(PairMethod method) {
  return method == PairMethod::two_pass || method == PairMethod::faces;
}

/// Which facets that approximate a smooth surface are seen as that.
enum class Smoothing : std::uint8_t {
  none,
  round,  ///< of contacts in whose surfaces no edge is sharp
  all,    ///< beside sharp edges, too
};

/// True when facets that approximate a smooth surface can be seen as that.
constexpr bool smooths(PairMethod method) {
  return has_both_passes(method);
}

/// How the rows of a tie are made: each slave node at its closest point of the master, or means over the overlaps of
/// the facets (mortar).
enum class TieMethod : std::uint8_t { node_to_surface, surface_to_surface };

/// What is done about slave nodes that are too far from the master to be tied.
enum class FarNodes : std::uint8_t { refuse, leave };

/// How the damper of a stop acts while it touches: never so that its sum with the spring pulls, or in both directions.
enum class DamperActs : std::uint8_t { compression, two_sided };

}  // namespace carom
