// The element types of Abaqus and CalculiX and what they are here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "mesh/cell_topology.hpp"
#include "mesh/mesh.hpp"

namespace carom {

struct DeckElementType {
  enum class Kind : std::uint8_t {
    cell,
    mass,           ///< a point mass at its node
    inertia,        ///< a rotary inertia at its node
    spring,         ///< between two nodes, along the line between them
    ground_spring,  ///< from a node to the ground
    unknown         ///< Carom has none such
  };
  std::string_view name;  ///< "C3D8R"
  Kind kind = Kind::cell;
  CellType type{};
  int nodes = 0;                       ///< in the deck, per element
  std::span<const LocalNode> order{};  ///< entry i: the place in the deck of our node i; empty where they are the same
  std::string_view section{};          ///< of a part: "solid", "plane_strain", ...; "" where it can be none
  std::string_view formulation{};      ///< of a part; "" where Carom's own default holds
  std::string_view remark{};           ///< what is not as in the other program; may be empty
};

std::span<const DeckElementType> deck_element_types();

/// By its name in upper case; nullptr where Carom has no such element.
const DeckElementType* deck_element_type(std::string_view name);

/// What elements of no known type are while the rest of the deck is looked at.
const DeckElementType& unknown_element_type();

}  // namespace carom
