// *RIGID BODY: what its reference node does, for the contacts that its surface has.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "deck/statements.hpp"
#include "mesh/deck_mesh.hpp"

namespace carom {

class TableMaker;
struct Translation;

/// A body of faces that belong to no part.
struct RigidBody {
  /// Of its faces: R3D3 and R3D4, R2D2, RAX2.
  enum class Space : std::uint8_t { solid, plane, ring };
  /// A component of the motion of the reference node.
  struct Motion {
    double velocity = 0.0;  ///< times the function
    std::string function;   ///< "" constant 1
    Location where;
  };
  /// About the reference node.
  struct Inertia {
    const DeckKeyword* keyword = nullptr;
    Vec3 moments{}, products{};  ///< xx, yy, zz; xy, yz, zx of the tensor
  };
  const DeckKeyword* keyword = nullptr;
  std::set<CellRef> cells;
  Space space = Space::solid;
  std::string node;  ///< the reference node as a key of node sets
  Index reference = -1;
  Vec3 centre{};                                ///< where it stands
  std::array<std::optional<Motion>, 6> motion;  ///< imposed: along the axes, about the axes
  std::optional<double> mass;
  std::optional<Inertia> inertia;
  std::optional<Vec3> initial_velocity, initial_rotation;
  int contacts = 0;  ///< that it has
};

/// All of the deck. Throws CaseError.
std::vector<RigidBody> rigid_bodies_of(const Translation& t);

/// The bodies whose reference nodes are the nodes of the group; none where it has other nodes too.
std::vector<RigidBody*> referred_to(Translation& t, const std::string& node_group);

/// The body that all cells of the group belong to, or nullptr.
RigidBody* body_of_cells(Translation& t, const std::string& cell_group);

/// Adds what the body does to the contact with its surface.
void add_rigid_motion(Translation& t, RigidBody& body, TableMaker& contact);

}  // namespace carom
