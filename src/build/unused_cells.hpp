// Cells of the mesh that nothing of the case takes.
#pragma once

#include "build/parts.hpp"
#include "casefile/case.hpp"

namespace carom {

/// Throws CaseError with their number, types and groups where lines, faces or solids belong to no part, no interface
/// and no rigid surface, are no piece of the boundary of other cells, and the case does not say that this is meant
/// (mesh.unused = "ignore"): a body that was forgotten would be missing without a word.
void refuse_unused_cells(const Case& given, const Mesh& mesh, const Parts& parts);

}  // namespace carom
