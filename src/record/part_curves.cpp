#include "record/part_curves.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "math/vec3.hpp"
#include "output/quantities.hpp"
#include "solid/cell_values.hpp"
#include "solid/node_shares.hpp"

namespace carom {

namespace {

struct PartEnergy {
  std::string_view quantity;
  double EnergyTerms::*term;
  bool (*is_possible)(const Simulation& s);
};

template <class Is>
bool any_part(const Simulation& s, const Is& is) {
  return std::ranges::any_of(s.model().parts, is);
}
bool any_remembers(const Simulation& s) {
  return any_part(s, [](const Part& part) { return !part.material.law->history.empty(); });
}

constexpr PartEnergy part_energies[] = {
    {"strain_energy", &EnergyTerms::strain, [](const Simulation&) { return true; }},
    {"hourglass_energy", &EnergyTerms::hourglass, [](const Simulation& s) { return has_hourglass(s.solid()); }},
    {"distortion_energy", &EnergyTerms::distortion,
     [](const Simulation& s) { return any_part(s, [](const Part& part) { return part.distortion_control > 0.0; }); }},
    {"plastic_energy", &EnergyTerms::plastic, any_remembers},
    {"hourglass_loss", &EnergyTerms::hourglass_loss,
     [](const Simulation& s) { return has_hourglass(s.solid()) && any_remembers(s); }},
    {"viscous_loss", &EnergyTerms::viscous,
     [](const Simulation& s) { return any_part(s, [](const Part& part) { return part.viscosity.is_any(); }); }},
};

}  // namespace

PartCurves::PartCurves(const Simulation& simulation) {
  std::vector<std::string_view> quantities{"kinetic_energy"};
  for (const PartEnergy& energy : part_energies) {
    if (!energy.is_possible(simulation)) continue;
    quantities.push_back(energy.quantity);
    terms_.push_back(energy.term);
  }
  quantities.emplace_back("momentum");
  table_.columns = {"time"};
  const Model& model = simulation.model();
  const std::vector<Index> numbers = model.part_numbers();
  std::size_t count = 0;
  for (std::size_t p = 0; p < numbers.size(); ++p) {
    if (at(numbers[p]) < count) continue;  // cells of another type of the part before
    ++count;
    for (const std::string_view quantity : quantities)
      for (const std::string& head : column_names(quantity)) table_.columns.push_back(model.parts[p].name + "." + head);
  }
  nodes_ = GroupSums(simulation.mesh().node_count(), count, node_shares(simulation.solid(), model));
}

void PartCurves::sample(const StepView& view) {
  const Mass& mass = view.stage.mass();
  const std::vector<double>& v = view.state.v;
  const auto sums = nodes_.sums<4>(view.shared.is_partial(), [&](std::size_t node) {
    const Vec3 p = mass.at_node(node, v);
    return std::array{0.5 * dot(vector_at(v, node), p), p[0], p[1], p[2]};
  });
  table_.row = {view.state.t};
  for (std::size_t part = 0; part < sums.size(); ++part) {
    table_.row.push_back(sums[part][0]);
    for (double EnergyTerms::*const term : terms_) table_.row.push_back(view.forces.of_parts[part].*term);
    table_.row.insert(table_.row.end(), sums[part].begin() + 1, sums[part].end());
  }
}

}  // namespace carom
