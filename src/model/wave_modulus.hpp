// The stiffness that waves in a part meet.
#pragma once

#include "model/model.hpp"

namespace carom {

/// Stress over strain of the fastest wave that a part carries at rest: E of bars, E / (1 - nu^2) of plane stress, else
/// the P-wave modulus (K. F. Graff, Wave Motion in Elastic Solids, 1975, sections 2.1, 8.3 and 5.1). Also that of a
/// cell that is compressed between a facet and its opposite one.
double wave_modulus(const Part& part);

}  // namespace carom
