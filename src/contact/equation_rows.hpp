// Rows of linear equations between displacements.
#pragma once

#include <memory>

#include "contact/row_maker.hpp"

namespace carom {

/// One bond per equation of the model, the same at every displacement, with a first component alone:
///   w = sum over the terms of c_k / c_1 u_k.
/// So w is what the dependent displacement (that of the first term) is wrong by, and the force of the row that on its
/// dof; the others bear c_k / c_1 of it.
std::unique_ptr<RowMaker> equation_rows(const Model& model);

}  // namespace carom
