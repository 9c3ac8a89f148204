#include "run/crossings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/types.hpp"
#include "model/node_lengths.hpp"
#include "model/wave_modulus.hpp"

namespace carom {

namespace {

/// The least time at each node; infinity where no deformable cell is.
std::vector<double> crossings_of_nodes(const Model& model) {
  const auto lengths = node_lengths(model);
  std::vector<double> times(lengths->size(), std::numeric_limits<double>::infinity());
  for (const Part& part : model.parts) {
    if (part.rigid_body >= 0) continue;
    const double speed = std::sqrt(wave_modulus(part) / part.material.rho);
    for (const Index cell : part.cells)
      for (const Index n : model.mesh->block(part.type)->nodes(cell))
        times[at(n)] = std::min(times[at(n)], (*lengths)[at(n)] / speed);
  }
  return times;
}

}  // namespace

std::vector<NamedValue> crossing_times(const Simulation& simulation) {
  const Model& model = simulation.model();
  std::vector<NamedValue> out;
  if (model.contacts.empty()) return out;
  const std::vector<double> of_nodes = crossings_of_nodes(model);
  for (const ContactDefinition& contact : model.contacts) {
    const ContactParts parts = parts_of(contact);
    if (parts.nature == ContactNature::bonds) continue;
    double sum = 0.0, count = 0.0;
    for (const Index n : nodes_of(parts, *model.mesh)) {
      if (!std::isfinite(of_nodes[at(n)])) continue;
      sum += of_nodes[at(n)];
      ++count;
    }
    if (count > 0.0) out.push_back({name_of(contact), sum / count});
  }
  return out;
}

}  // namespace carom
