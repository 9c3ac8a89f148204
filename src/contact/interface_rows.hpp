// Rows of interface cells: contact elements of zero thickness.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/row_maker.hpp"

namespace carom {

/// Four rows per cell at the 2 x 2 Gauss points of its face, the same at every displacement. The normal points to the
/// side of the part; with parts on both sides or on none the cell's own order says which face is above. Normals that
/// were turned are told in notes. Throws std::invalid_argument naming the contact and the cell when a cell is not of
/// zero thickness.
std::unique_ptr<RowMaker> interface_rows(const Model& model, const InterfaceContact& contact, Index source,
                                         std::vector<std::string>& notes);

}  // namespace carom
