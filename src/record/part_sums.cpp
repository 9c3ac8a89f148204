#include "record/part_sums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "math/vec3.hpp"
#include "record/part_extremes.hpp"
#include "solid/solid.hpp"

namespace carom {

namespace {

/// The mass of these parts and of nothing else.
Mass mass_of(const Model& model, std::vector<Part> parts, MassKind kind) {
  Model alone;
  alone.mesh = model.mesh;
  alone.parts = std::move(parts);
  return Solid(alone).mass(kind);
}

/// Four nodes with a quarter of its mass each.
Mass mass_of(const TurningBody& body, std::size_t nodes) {
  std::vector<double> diagonal(nodes, 0.0);
  for (const Index n : body.nodes) diagonal[at(n)] = 0.25 * body.mass;
  return Mass(std::move(diagonal));
}

[[noreturn]] void refuse(const CaseProbe& given, const std::string& found, const std::string& expected) {
  throw CaseError(given.part->where, "probe.part", found, expected);
}

}  // namespace

PartSums::PartSums(const CaseProbe& given, const Simulation& simulation) : simulation_(&simulation) {
  const Model& model = simulation.model();
  std::vector<Part> own;
  Index body = -1, first = 0;
  bool body_has_others = false;
  for (const Part& part : model.parts) {
    const auto end = first + static_cast<Index>(part.cells.size());
    if (part.name == **given.part) {
      own.push_back(part);
      body = part.rigid_body;
      for (Index k = first; k < end; ++k) cells_.push_back(k);
    }
    first = end;
  }
  for (const Part& part : model.parts)
    body_has_others = body_has_others || (body >= 0 && part.rigid_body == body && part.name != **given.part);
  if (body_has_others)
    refuse(given, fmt::format("\"{}\", one of several parts of a rigid body", **given.part),
           "a deformable part, or the only part of a rigid body");
  const bool is_nodal = std::ranges::any_of(own, [](const Part& p) { return p.formulation == Formulation::nodal; });
  if (is_nodal && std::ranges::any_of(given.quantities, [](const auto& q) { return *q == "strain_energy"; }))
    refuse(given, fmt::format("the strain energy of \"{}\", a nodal part", **given.part),
           "a part whose cells have an energy of their own");
  is_rigid_ = body >= 0;
  refuse_extremes(given);
  find_centre();
  for (const auto& stage : simulation.stages()) {
    const MassKind kind = stage->mass().kind();
    if (masses_.contains(kind)) continue;
    masses_.emplace(kind, body < 0 ? mass_of(model, own, kind)
                                   : mass_of(model.turning_bodies[at(body)], simulation.mesh().node_count()));
  }
}

void PartSums::refuse_extremes(const CaseProbe& given) const {
  const auto yields = [&](const Part& part) {
    return part.name == **given.part && std::ranges::count(part.material.history(), "equivalent_plastic_strain") > 0;
  };
  for (const auto& quantity : given.quantities) {
    if (!is_part_extreme(*quantity)) continue;
    if (is_rigid_)
      refuse(given, fmt::format("{} of \"{}\", a rigid part", *quantity, **given.part), "a part that deforms");
    if (!is_extreme_of_stress(*quantity) && std::ranges::none_of(simulation_->model().parts, yields))
      refuse(given, fmt::format("{} of \"{}\", which does not yield", *quantity, **given.part),
             "a part whose law yields");
  }
}

void PartSums::find_centre() {
  const Solid& solid = simulation_->solid();
  double volume = 0.0;
  for (const Index k : cells_) {
    const std::span<const Index> nodes = solid.cells().nodes_of(at(k));
    const double share = solid.cells().volumes[at(k)] / static_cast<double>(nodes.size());
    for (const Index n : nodes) centre_ = add(centre_, scaled(simulation_->mesh().coordinates[at(n)], share));
    volume += solid.cells().volumes[at(k)];
  }
  centre_ = scaled(centre_, 1.0 / volume);
}

double PartSums::strain_energy(const StepView& view) const {
  if (is_rigid_) return 0.0;
  const std::span<const std::uint8_t> alive = view.state.alive();
  std::vector<Index> cells;
  std::ranges::copy_if(cells_, std::back_inserter(cells), [&](Index k) { return alive.empty() || alive[at(k)] != 0; });
  std::vector<double> force(view.state.q.size(), 0.0);
  SolidEnergies energies;
  simulation_->solid().add_internal_force_of(cells, view.state.q, force, view.points(), &energies);
  return energies.strain;
}

void PartSums::append(std::string_view quantity, FieldsNow& now, std::vector<double>& row) const {
  if (is_part_extreme(quantity)) return row.push_back(part_extreme(quantity, cells_, now));
  const StepView& view = now.view;
  const std::vector<double>& v = view.state.v;
  const Mass& mass = this->mass(view);
  Vec3 momentum{};
  double kinetic = 0.0;
  for (std::size_t n = 0; n < v.size() / 3; ++n) {
    const Vec3 p = mass.at_node(n, v);
    momentum = add(momentum, p);
    kinetic += 0.5 * dot(vector_at(v, n), p);
  }
  if (quantity == "mass") row.push_back(mass.total());
  if (quantity == "momentum") row.insert(row.end(), momentum.begin(), momentum.end());
  if (quantity == "kinetic_energy") row.push_back(kinetic);
  if (quantity == "strain_energy") row.push_back(strain_energy(view));
}

}  // namespace carom
