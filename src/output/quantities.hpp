// The quantities of results, one row each: the case format, the heads of the tables, frames, view, page and
// docs/quantities.md follow from these rows. How those of bodies are computed says record/field_values.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/units.hpp"

namespace carom {

/// What a value of a quantity belongs to.
enum class Place : std::uint8_t {
  nodes,
  cells,
  points,   ///< remembered by the points of some laws: means over the cells
  mesh,     ///< of cells, with the mesh that all frames share
  held,     ///< nodes that supports hold or move
  turning,  ///< nodes, along axes that turn with the body there
  section,  ///< the cells on one side of some nodes
  part,
  contact,  ///< with what a contact touches
  run       ///< the whole run
};

/// Components: one; x y z; xx yy zz xy yz zx; 1 2 3 in decreasing order; one small whole number.
enum class Form : std::uint8_t { scalar, vector, tensor, principal, category };

/// Which numbers the colours of a view span.
enum class Colours : std::uint8_t {
  range,      ///< from the smallest to the largest, about zero where there are both signs
  from_zero,  ///< from zero to the largest
  both_signs  ///< about zero
};

struct Quantity {
  std::string_view name;
  Place place{};
  Form form{};
  Dimension unit{};
  Colours colours{};
  enum class Written : std::uint8_t { if_asked, by_default } written{};
  std::string_view meaning;
  std::string_view label{};  ///< for people; "": the name with blanks
};

std::span<const Quantity> quantities();
/// Null: none of this name.
const Quantity* find_quantity(std::string_view name);

/// A field of the frames?
bool is_field(const Quantity& quantity);
/// Something that a [[probe]] records?
bool is_probed(const Quantity& quantity);

/// "x", "y", "z"; one empty name where there is one component.
std::span<const std::string_view> component_names(Form form);
std::size_t components(Form form);
/// Heads of a table: "velocity_x", "velocity_y", "velocity_z".
std::vector<std::string> column_names(std::string_view quantity);
/// For people, of any name: "von Mises stress", "contact force".
std::string label_of(std::string_view quantity);

/// docs/quantities.md
std::string quantities_markdown();

}  // namespace carom
