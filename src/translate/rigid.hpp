// *RIGID BODY and *COUPLING: what their reference nodes do, for the contacts of obstacles and the sections of the
// others.
#pragma once

#include <string>
#include <vector>

#include "translate/translation.hpp"

namespace carom {

class TableMaker;

/// All of the deck. Throws CaseError.
std::vector<DeckRigidBody> rigid_bodies_of(const Translation& t);

/// The bodies whose reference nodes are among the nodes of the group. Beside other nodes those of cells are as these:
/// what acts on them acts on the body.
struct Referred {
  std::vector<DeckRigidBody*> bodies;
  bool has_others = true;  ///< the group has other nodes, too
};
Referred referred_to(Translation& t, const std::string& node_group);

/// The body whose turns are the displacements of the one node of the group, or nullptr.
DeckRigidBody* turned_by(Translation& t, const std::string& node_group);

/// The body that all cells of the group belong to, or nullptr.
DeckRigidBody* body_of_cells(Translation& t, const std::string& cell_group);

/// Adds what holds a body that is free otherwise, at its reference node. Throws CaseError for turns that are held about
/// one axis alone.
void add_guide(const DeckRigidBody& body, TableMaker& section);
/// The moments of inertia that a body held so needs: about its one axis alone, where it has one.
Vec3 moments_in_guide(const DeckRigidBody& body);

/// Adds what the body does to the contact with its surface.
void add_rigid_motion(Translation& t, DeckRigidBody& body, TableMaker& contact);

}  // namespace carom
