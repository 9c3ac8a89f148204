// *RIGID BODY: what its reference node does, for the contacts that its surface has.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/statements.hpp"
#include "mesh/deck_mesh.hpp"

namespace carom {

class TableMaker;
struct Translation;

/// A body of faces that belong to no part; it does not turn.
struct RigidBody {
  /// A component of the motion of the reference node.
  struct Motion {
    double velocity = 0.0;  ///< times the function
    std::string function;   ///< "" constant 1
  };
  const DeckKeyword* keyword = nullptr;
  std::set<CellRef> cells;
  Index reference = -1;
  std::array<std::optional<Motion>, 3> motion;  ///< imposed
  std::optional<double> mass;
  std::optional<Vec3> initial_velocity;
  int contacts = 0;  ///< that it has
};

/// All of the deck. Throws CaseError.
std::vector<RigidBody> rigid_bodies_of(const Translation& t);

/// The body whose reference node is the only node of the group, or nullptr.
RigidBody* referred_to(Translation& t, const std::string& node_group);

/// The body that all cells of the group belong to, or nullptr.
RigidBody* body_of_cells(Translation& t, const std::string& cell_group);

/// Adds what the body does to the contact with its surface.
void add_rigid_motion(Translation& t, RigidBody& body, TableMaker& contact);

}  // namespace carom
