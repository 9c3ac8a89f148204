#include "record/contact_at_nodes.hpp"

#include <map>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "solid/cohesive_zones.hpp"

namespace carom {

namespace {

using ByNode = std::map<Index, Vec3>;

void add_to(ByNode& forces, Index node, const Vec3& force) {
  Vec3& sum = forces[node];
  sum = add(sum, force);
}

}  // namespace

NodalForces contact_at_nodes(const Simulation& simulation, const StepView& view, std::size_t contact) {
  ByNode forces;
  const ContactResponse& response = view.forces.rows;
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] == RowStatus::open || rows.source[r] < 0 || at(rows.source[r]) != contact) continue;
    const Vec3& f = response.force[r];
    for (std::size_t k = at(rows.begin[r]); k < at(rows.begin[r + 1]); ++k) {
      const RowBlock& b = rows.block[k];
      add_to(forces, rows.node[k], add(scaled(b[0], f[0]), add(scaled(b[1], f[1]), scaled(b[2], f[2]))));
    }
  }
  simulation.solid().cohesive().for_each_force(
      view.state.q, view.points().history, [&](std::size_t of, const CohesiveRow& row, const Vec3& force) {
        if (of != contact) return;
        for (const auto* side : {&row.slave, &row.master})  // weights of the master are negative
          for (const auto& [node, weight] : *side) add_to(forces, node, scaled(force, weight));
      });
  NodalForces out;
  for (const auto& [node, force] : forces) {
    out.nodes.push_back(node);
    out.force.push_back(force);
  }
  return out;
}

}  // namespace carom
