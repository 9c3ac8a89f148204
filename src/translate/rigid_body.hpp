// A rigid body of a deck.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "deck/statements.hpp"
#include "mesh/deck_mesh.hpp"

namespace carom {

/// A body of faces that belong to no part, which is an obstacle; of cells, which are parts; or of nodes alone.
struct DeckRigidBody {
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
  std::string name;  ///< in messages
  std::set<CellRef> cells;
  std::string group;   ///< of its cells, or of the nodes that it is made of; "" of faces
  std::string joined;  ///< nodes of other bodies that move with it, or ""
  std::string side;    ///< the surface by which general contact meets it
  Space space = Space::solid;
  std::string node;  ///< the reference node as a key of node sets
  Index reference = -1;
  Index turning = -1;                           ///< the node whose displacements are the turns of the body; -1 none
  Vec3 centre{};                                ///< where it stands
  std::array<std::optional<Motion>, 6> motion;  ///< imposed: along the axes, about the axes
  std::optional<double> mass;
  const DeckKeyword* mass_keyword = nullptr;
  std::optional<Inertia> inertia;
  std::optional<Vec3> initial_velocity, initial_rotation;
  int contacts = 0;  ///< that it has

  bool is_obstacle() const { return group.empty(); }
  bool is_of_nodes() const { return cells.empty(); }
  /// Components from `first` up to `end` that are imposed.
  std::size_t count_imposed(std::size_t first, std::size_t end) const {
    std::size_t count = 0;
    for (std::size_t c = first; c < end; ++c) count += motion[c] ? 1U : 0U;
    return count;
  }
  /// Is a body of cells or nodes held as supports of all of its nodes cannot say? Along one axis they also hold the
  /// turns about the two others, along two axes all turns.
  bool is_guided() const {
    const std::size_t along = count_imposed(0, 3), about = count_imposed(3, 6);
    if (along == 0 && about == 0) return false;
    if (along >= 2 && about == 3) return false;
    if (along == 1 && about == 2)
      for (std::size_t c = 0; c < 3; ++c)
        if (motion[c] && !motion[c + 3]) return false;
    return true;
  }
};

}  // namespace carom
