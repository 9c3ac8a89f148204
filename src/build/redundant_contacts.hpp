// Contacts that would count twice.
#pragma once

#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

/// Throws CaseError where two contacts of the model make the same rows: facets of both on the same two sides, the same
/// obstacle at the same place for the same facets or nodes, the same interface cells, the same stop. Stiffness would be
/// doubled and multipliers would have no single value.
void refuse_redundant_contacts(const Case& given, const Model& model);

/// Throws CaseError where the faces of a rigid surface are faces of a part that can move: they would stay behind.
void refuse_faces_of_parts(const Case& given, const Model& model);

}  // namespace carom
