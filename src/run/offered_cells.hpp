// Which types of cells a part may be made of.
#pragma once

#include <span>

#include "model/model.hpp"

namespace carom {

/// The types that the section takes, the usual one first. The only place that says so: readers, skins, contact and
/// output know all types.
std::span<const CellType> offered_cells(Section section);

bool is_offered(CellType type, Section section);

}  // namespace carom
