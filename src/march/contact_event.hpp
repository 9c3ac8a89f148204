// Where within a step rows of contact close.
#pragma once

#include <optional>

#include "rows/response.hpp"
#include "state/state.hpp"

namespace carom {

/// The fraction of a step at which the first of those rows closes that carry a force at `end`, were open by more than
/// round-off at `begin`, and close earlier before the end than `tolerance` (time): regula falsi on the gap,
///   phi = g0 / (g0 - g1),  late by (1 - phi) h,
/// g1 being the gap at the end, or what it would be had the row gone on with the velocity of the beginning where that
/// is less: exact contact leaves no depth to see. Half of the tolerance is added to phi, so that the next try meets it.
/// Gaps at the beginning are those of the rows of the end.
std::optional<double> contact_event(const State& begin, const State& end, const ContactResponse& at_end,
                                    double tolerance);

}  // namespace carom
