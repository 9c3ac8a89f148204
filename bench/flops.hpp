// The work of the sweeps over the cells, counted.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// Internal force with energies and history, or the action of the tangent.
enum class Sweep : std::uint8_t { force, tangent };

/// Additions, subtractions, multiplications, divisions and square roots of a cell, the mean over (at most) the first
/// thousand of each part, at u from the body at rest: counted at run time by a number type that the kernels' templates
/// are compiled for, so that what they do in plain double is left out (the sums of energies).
double flops_per_cell(const Model& model, const std::vector<double>& u, Sweep sweep);

}  // namespace carom
