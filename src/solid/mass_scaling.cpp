#include "solid/mass_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solid/cell_values.hpp"
#include "solid/stability.hpp"

namespace carom {

std::vector<double> mass_factors(const Solid& solid, double omega_squared) {
  std::vector<double> factors = cell_frequency_bounds(solid);
  for (double& factor : factors) factor = std::max(1.0, factor / omega_squared);
  return factors;
}

MassGain mass_gain(const Solid& solid, const std::vector<double>& factors) {
  const std::vector<double> masses = cell_masses(solid);
  MassGain gain;
  gain.total = solid.mass(MassKind::lumped).total();
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (factors[k] == 1.0) continue;
    gain.added += (factors[k] - 1.0) * masses[k];
    ++gain.cells;
    gain.worst.push_back({k, factors[k]});
  }
  std::stable_sort(gain.worst.begin(), gain.worst.end(),
                   [](const ScaledCell& a, const ScaledCell& b) { return a.factor > b.factor; });
  gain.worst.resize(std::min<std::size_t>(3, gain.worst.size()));
  return gain;
}

std::string describe(const MassGain& gain, const Solid& solid, const Mesh& mesh) {
  std::string text = fmt::format("{} of {} cells gain a mass of {:.6g}, {:.4g} % of all", gain.cells,
                                 solid.cells().size(), gain.added, 100.0 * gain.share());
  const char* separator = "; the worst: ";
  for (const ScaledCell& one : gain.worst) {
    const CellRef ref = solid.cells()[one.cell];
    Vec3 centre{};
    const std::span<const Index> nodes = solid.cells().nodes_of(one.cell);
    for (const Index n : nodes) {
      for (std::size_t c = 0; c < 3; ++c)
        centre[c] += mesh.coordinates[static_cast<std::size_t>(n)][c] / static_cast<double>(nodes.size());
    }
    text += fmt::format("{}cell {} at ({:.4g}, {:.4g}, {:.4g}) x {:.4g}", separator, mesh.cell_label(ref), centre[0],
                        centre[1], centre[2], one.factor);
    separator = ", ";
  }
  return text;
}

}  // namespace carom
