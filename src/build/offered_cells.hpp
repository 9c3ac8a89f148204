// Which types of cells a part may be made of.
#pragma once

#include <span>

#include "model/model.hpp"

namespace carom {

/// The types that the section takes, the usual one first: those of the element table (solid/element_table.hpp).
/// Readers, skins, contact and output know all types.
std::span<const CellType> offered_cells(Section section);

}  // namespace carom
