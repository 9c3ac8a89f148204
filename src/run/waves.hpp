// Speeds and impedances of the waves that the parts of a case carry.
#pragma once

#include <span>
#include <vector>

#include "run/simulation.hpp"

namespace carom {

/// Stress over strain of the fastest wave that a part carries: E of bars, E / (1 - nu^2) of plane stress, else the
/// P-wave modulus (K. F. Graff, Wave Motion in Elastic Solids, 1975, sections 2.1, 8.3 and 5.1).
double wave_modulus(const Part& part);

/// The fastest wave of all parts, and the largest modulus.
struct Waves {
  double speed = 0.0, modulus = 0.0;
};
Waves waves(const Simulation& simulation);

/// rho c of the parts at each node, the largest; 0 at nodes of no part. A wall stops a body of speed v with rho c v.
std::vector<double> node_impedances(const Simulation& simulation);
/// Mean over the nodes of facets.
double mean_impedance(std::span<const Facet> facets, std::span<const double> node_impedances);

double smallest_cell(const Simulation& simulation);

}  // namespace carom
