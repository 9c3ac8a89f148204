#include "advise/waves.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

Waves waves(const Simulation& s) {
  Waves w;
  for (const Part& part : s.model().parts) {
    w.modulus = std::max(w.modulus, wave_modulus(part));
    w.speed = std::max(w.speed, std::sqrt(wave_modulus(part) / part.material.rho));
  }
  return w;
}

std::vector<double> node_impedances(const Simulation& s) {
  std::vector<double> z(s.mesh().node_count(), 0.0);
  for (const Part& part : s.model().parts) {
    const double own = std::sqrt(wave_modulus(part) * part.material.rho);
    const std::vector<Index>& connectivity = s.mesh().block(part.type)->connectivity;
    const auto n = static_cast<std::size_t>(node_count(part.type));
    for (const Index cell : part.cells)
      for (std::size_t a = 0; a < n; ++a) {
        double& at_node = z[static_cast<std::size_t>(connectivity[n * static_cast<std::size_t>(cell) + a])];
        at_node = std::max(at_node, own);
      }
  }
  return z;
}

double mean_impedance(std::span<const Facet> facets, std::span<const double> node_impedances) {
  double sum = 0.0, count = 0.0;
  for (const Facet& facet : facets)
    for (const Index n : facet) {
      sum += node_impedances[static_cast<std::size_t>(n)];
      ++count;
    }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace carom
