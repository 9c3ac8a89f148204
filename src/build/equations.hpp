// Linear equations between displacements, from the groups that the case names.
#pragma once

#include "build/groups.hpp"
#include "build/parts.hpp"
#include "casefile/case.hpp"
#include "model/model.hpp"

namespace carom {

/// Adds the equations of the case to the model, whose motions and point masses are complete. Groups of several nodes
/// are matched by their places about the mean of each group. Throws CaseError for nodes without mass, for groups that
/// do not match, for an equation that has a term twice, for dependent displacements that are imposed or are the
/// dependent ones of two equations, and for an equation that follows from others or contradicts them.
void add_equations(const Case& given, const Mesh& mesh, const Groups& groups, const Parts& parts, Model& model);

}  // namespace carom
