// What the errors of a run are judged by.
#pragma once

#include "march/verdict.hpp"
#include "mesh/mesh.hpp"
#include "model/model.hpp"
#include "solid/solid.hpp"

namespace carom {

/// Rings have no momentum across their axis y, and none about it that their cells would show.
RunMonitor::Momenta momenta_of(const Model& model);

/// Largest distance of a node from the origin.
double reach(const Mesh& mesh);

/// 1/2 (1e-10 reach)^2 times the sum of the diagonal of K(0): the energy that displacements of 1e-10 of the bodies'
/// reach would store. Less is rounding of positions, to the verdict's 1e-10 of it.
double rest_energy(const Solid& solid, double reach);

}  // namespace carom
