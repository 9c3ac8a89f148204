// The step that Courant numbers are multiples of.
#pragma once

#include "casefile/case.hpp"

namespace carom::compare {

/// Time in which the fastest wave crosses the shortest cell: min over solid cells of their length (volume over largest
/// face, BodyCells::lengths), over the largest c_p = sqrt((lambda + 2 G) / rho) of the parts; the Courant number of
/// `carom check` is the step over it. Builds the mesh; throws CaseError.
double element_step(const Case& given);

}  // namespace carom::compare
