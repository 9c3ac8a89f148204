// The modified mass: no inertia on contact nodes, the same total.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Where the mass of the contact nodes goes (Khenous, Laborde and Renard, Eur. J. Mech. A/Solids 27, 2008; Hager,
/// Hueber and Wohlmuth, Int. J. Numer. Methods Eng. 73, 2008).
enum class MassSpread : std::uint8_t {
  /// In equal parts to each of the next layers of nodes, from each node to its neighbours in the next layer in
  /// proportion to the size of the consistent mass M_nm between them (on regular meshes: to those below in proportion
  /// to
  /// their own mass; in equal parts where there is none between them, as in TETRA10 of parts). The layer of a node is
  /// its distance from the contact nodes in cells. Contact nodes that are neighbours form
  /// a patch, which keeps its mass to its own layers; those of them that are not beside the first layer pass theirs on
  /// to those that are.
  layers,
  /// Over all other nodes of the body, so that its mass, centre and inertia stay: minimise sum of (dm_a)^2 / m_a under
  /// these (at most ten) conditions and m_a + dm_a >= m_a / 4.
  least_squares
};

struct MassModification {
  MassSpread spread = MassSpread::layers;
  int layers = 4;  ///< at least 1; where a body has fewer, those that there are
};

/// What the modification has done.
struct MassShift {
  double moved = 0.0;         ///< mass taken from contact nodes
  double total = 0.0;         ///< mass before
  double total_error = 0.0;   ///< mass after - mass before, round-off
  Vec3 centre{};              ///< shift of the centre of all masses (length)
  double inertia = 0.0;       ///< |J after - J before| / |J before|, about the centre before (Frobenius norms)
  double largest_gain = 0.0;  ///< largest (m after - m before) / m before of the other nodes
  double largest_loss = 0.0;  ///< largest (m before - m after) / m before of the other nodes
  std::size_t contact_nodes = 0;
};

/// One line each, for the log.
std::vector<std::string> describe(const MassShift& shift);

struct ModifiedMass {
  Mass mass;  ///< lumped
  MassShift shift;
};

/// Nodes of contact surfaces, both sides of pairs, in ascending order: those that may carry contact forces. Carriers of
/// moving obstacles are not among them.
std::vector<Index> contact_nodes(const Model& model);

/// Lumped mass of the solid without inertia on contact nodes (stages hand over the facets of pairs alone that look at
/// each other). A node all of whose components are imposed keeps its mass, which has no part in the motion. Throws
/// std::invalid_argument when a contact patch (layers) or a body (least_squares) has no other node, when the other
/// nodes of a free body lie on a line, or when no masses of at least m_a / 4 keep centre and inertia.
ModifiedMass modify_mass(const Solid& solid, const Model& model, const MassModification& how);

}  // namespace carom
