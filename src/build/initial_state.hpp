// The state in which another run has ended, as the one that a run begins with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casefile/case.hpp"
#include "model/model.hpp"
#include "output/checkpoint_file.hpp"
#include "solid/solid.hpp"

namespace carom {

/// What [initial_state] takes over, beside the displacements and velocities, which stand in Model::initial.
struct TakenState {
  std::string checkpoint, resolved_case;  ///< the files it is from
  CheckpointInfo info;
  std::vector<double> points;  ///< history of the quadrature points, cell by cell until take_points
  std::string note;            ///< what it is, for the log
};

/// Reads the state of the case's [initial_state] and puts its displacements and velocities in front of model.initial,
/// for the nodes of the mesh as it is given: springs' grounds and moving obstacles begin as the case says. Velocities
/// are left where no stage has inertia. Nothing without the section. Throws CaseError where there is no such state,
/// where mesh, parts, materials or units are others, and where an imposed displacement begins elsewhere.
std::optional<TakenState> take_over(const Case& given, Model& model);

/// Lays the history of the points out for the solid. Throws CaseError where it is of another version of the program or
/// of laws that remember other things.
void take_points(const Case& given, const Solid& solid, TakenState& taken);

/// Throws CaseError where [initial_state] names the folder of the results, which a run clears, or one within it.
void refuse_own_folder(const Case& given, const std::string& results);

/// Copies the files of the state into a results folder, so that a run that goes on there needs no other. Throws
/// OutputError.
void keep_state(const TakenState& taken, const std::string& results);

}  // namespace carom
