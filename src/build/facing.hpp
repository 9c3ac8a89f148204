// How the surfaces of a contact stand to each other at the start.
#pragma once

#include <optional>

#include "model/model.hpp"
#include "rows/constraint_rows.hpp"
#include "state/state.hpp"

namespace carom {

/// Speed at which the middles of two surfaces approach each other; without a value where that says nothing.
std::optional<double> middle_approach(const Model& model, std::size_t contact, const State& state);

/// True when a rigid surface shows its back: the facet nearest to the middle of the touching surface looks the same way
/// as that does and lies before it.
bool shows_its_back(const Model& model, std::size_t contact, const State& state);

/// True when, moreover, the touching surface begins with a velocity towards it: it passes through from behind.
bool goes_through_its_back(const Model& model, std::size_t contact, const State& state);

/// True when, with the rows of that state, no facet of the contact's surface looks at the obstacle, or no facets of a
/// pair look at each other: what would touch first is not in the contact.
bool faces_away(const Model& model, const ConstraintRows& rows, std::size_t contact, const State& state);

/// True when the boxes around the two surfaces of a pair, each grown by a facet, do not meet before the end at the mean
/// velocities of the surfaces.
bool passes_by(const Model& model, std::size_t contact, const State& state, double end);

/// Of a contact of all bodies with each other: true when there are several and the boxes around no two of them, each
/// grown by a facet, meet before the end at the mean velocities of their skins.
bool all_stay_apart(const Model& model, std::size_t contact, const State& state, double end);

}  // namespace carom
