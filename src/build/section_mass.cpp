#include "build/section_mass.hpp"

#include <algorithm>
#include <map>

#include "solid/cell_values.hpp"

namespace carom {

SectionMass::SectionMass(const Solid& solid, std::span<const Index> nodes, std::span<const Index> cells) {
  std::vector<double> factors(solid.cells().size(), 0.0);
  const Mass at_nodes = solid.lumped_mass(factors);  // point masses and the like, of neither side
  for (const Index k : cells) factors[at(k)] = 1.0;
  const Mass with_cells = solid.lumped_mass(factors);
  for (const Index n : nodes)
    lumped_.push_back({n, with_cells.node_diagonal()[at(n)] - at_nodes.node_diagonal()[at(n)]});

  const std::vector<double> masses = cell_masses(solid);
  std::map<Index, double> sums;
  std::vector<double> plus, minus;
  for (const Index k : cells) {
    const std::span<const Index> of_cell = solid.cells().nodes_of(at(k));
    const std::vector<double> ones(of_cell.size(), 1.0);
    const double density = masses[at(k)] / square_integral(solid, at(k), ones);
    std::vector<double> on;
    for (const Index n : of_cell) on.push_back(std::find(nodes.begin(), nodes.end(), n) != nodes.end() ? 1.0 : 0.0);
    for (std::size_t b = 0; b < of_cell.size(); ++b) {
      plus = minus = on;
      plus[b] += 1.0;
      minus[b] -= 1.0;
      // the integral of N n is (|N + n|^2 - |N - n|^2) / 4
      sums[of_cell[b]] += 0.25 * density * (square_integral(solid, at(k), plus) - square_integral(solid, at(k), minus));
    }
  }
  for (const auto& [node, mass] : sums) consistent_.push_back({node, mass});
}

}  // namespace carom
