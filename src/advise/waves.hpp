// Speeds and impedances of the waves that the parts of a case carry.
#pragma once

#include <span>
#include <vector>

#include "build/simulation.hpp"
#include "model/wave_modulus.hpp"

namespace carom {

/// The fastest wave of all parts, and the largest modulus.
struct Waves {
  double speed = 0.0, modulus = 0.0;
};
Waves waves(const Simulation& simulation);

/// rho c of the parts at each node, the largest; 0 at nodes of no part. A wall stops a body of speed v with rho c v.
std::vector<double> node_impedances(const Simulation& simulation);
/// Mean over the nodes of facets.
double mean_impedance(std::span<const Facet> facets, std::span<const double> node_impedances);

}  // namespace carom
