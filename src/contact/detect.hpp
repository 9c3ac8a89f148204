// The geometry step: from contact definitions to constraint rows.
#pragma once

#include <string>
#include <vector>

#include "contact/constraint_rows.hpp"
#include "model/model.hpp"

namespace carom {

/// Rows of all contacts of the model, at small sliding: they are made once, on the reference configuration.
struct DetectedContact {
  ConstraintRows rows;
  std::vector<std::string> notes;  ///< what was turned or noticed, for the log
};

/// - interface cells: four rows per cell at the 2 x 2 Gauss points of the face (weights N_a above, -N_a below; the
///   `above` is the side of the part, and the normal points to it; with parts on both sides or on none the cell's own
///   order says which face is above);
/// - rigid planes: one row per node with the area it stands for (integral of N_a over the faces), or 1 per node;
/// - stops: one row per node, measure 1.
/// Throws std::invalid_argument naming the contact and the cell when an interface cell is not of zero thickness.
DetectedContact detect_contact(const Model& model);

}  // namespace carom
