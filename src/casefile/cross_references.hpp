// Names in a case that refer to other sections of the same case.
#pragma once

#include "casefile/case.hpp"

namespace carom {

/// Checks that names are unique and that every material, function, part, probe and contact that is named exists. Takes
/// also a case of which some could not be read, where `errors` is not empty.
void check_names(const Case& given, CaseErrors& errors);

/// Checks that checks lie within the run, that nothing needs an [exact] that is not there, and what schemes and
/// contacts ask of each other.
void check_references(const Case& given, CaseErrors& errors);

/// Where all stages are statics that name no enforcement, chooses the augmented Lagrangian: springs alone would take a
/// part of the motion. Contacts that give their stiffness or are to be smooth, and stops, keep springs.
void choose_enforcement(Case& given);
/// The velocities of drop_height. Throws CaseError where there is no gravity.
void find_falls(Case& given);
/// Mass of static stages that say none: that of the next stage with inertia, so that what rests under its weight before
/// it rests in it.
void choose_weights(Case& given);

/// Fills in the methods of pairs that name none: faces, or two_pass where they are to be smooth. Also that they are not
/// smooth, where nothing is said and they cannot be.
void choose_methods(Case& given);

}  // namespace carom
