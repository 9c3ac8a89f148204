// Curves of all variants over time, beside the reference.
#pragma once

#include <vector>

#include "compare/tables.hpp"
#include "report/charts.hpp"

namespace carom::compare {

/// One chart for each compared column of contact force and velocity, and one of the mechanical energy. The eight
/// variants of smallest error (there are eight colours) are drawn, the best on top; the others are hidden until their
/// name is clicked.
std::vector<Chart> make_histories(const Comparison& comparison);

}  // namespace carom::compare
