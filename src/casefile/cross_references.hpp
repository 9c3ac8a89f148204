// Names in a case that refer to other sections of the same case.
#pragma once

#include "casefile/case.hpp"

namespace carom {

/// Checks that names are unique and that every material, function, part, probe and contact that is named exists, that
/// checks lie within the run, and that nothing needs an [exact] that is not there. Throws CaseError.
void check_references(const Case& given);

/// Where all stages are statics that name no enforcement, chooses the augmented Lagrangian: springs alone would take a
/// part of the motion. Contacts that give their stiffness or are to be smooth, and stops, keep springs.
void choose_enforcement(Case& given);

/// Fills in the methods of pairs that name none: faces, or two_pass where they are to be smooth. Also that they are not
/// smooth, where nothing is said and they cannot be.
void choose_methods(Case& given);

}  // namespace carom
