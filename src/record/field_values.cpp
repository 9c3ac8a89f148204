#include "record/field_values.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

#include "parallel/threads.hpp"
#include "record/stress_measures.hpp"
#include "solid/cell_strain.hpp"
#include "solid/cell_values.hpp"

namespace carom {

namespace {

/// `of_stress(stress, values)` writes so many values for each cell.
template <std::size_t values, class OfStress>
FieldValues of_cells(const std::vector<Voigt>& stress, const OfStress& of_stress) {
  std::vector<double> out(values * stress.size());
  parallel_each(stress.size(), [&](std::size_t k) { of_stress(stress[k], &out[values * k]); });
  return FieldValues(std::move(out));
}

FieldValues kept(std::span<const double> values) {
  return FieldValues(values);
}

/// Means over the deformable cells that are there at a node, by their reference volumes; 0 where there is none.
FieldValues at_nodes(const FieldsNow& now, std::size_t count, std::span<const double> of_cells) {
  const Solid& solid = now.simulation.solid();
  const std::span<const std::uint8_t> alive = now.view.state.alive();
  std::vector<double> sums(count * solid.node_count(), 0.0), volumes(solid.node_count(), 0.0);
  std::size_t k = 0;
  for (const Part& part : now.simulation.model().parts)
    for (const std::size_t end = k + part.cells.size(); k < end; ++k) {
      if (part.rigid_body >= 0 || (!alive.empty() && alive[k] == 0)) continue;
      const double volume = solid.cells().volumes[k];
      for (const Index n : solid.cells().nodes_of(k)) {
        volumes[at(n)] += volume;
        for (std::size_t c = 0; c < count; ++c) sums[count * at(n) + c] += volume * of_cells[count * k + c];
      }
    }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (volumes[i / count] > 0.0) sums[i] /= volumes[i / count];
  return FieldValues(std::move(sums));
}

FieldValues energy_densities(const FieldsNow& now) {
  const Solid& solid = now.simulation.solid();
  std::vector<double> density(solid.cells().size(), 0.0), force(solid.dof_count(), 0.0);
  for (std::size_t k = 0; k < density.size(); ++k) {
    SolidEnergies energies;
    const std::array cell{static_cast<Index>(k)};
    solid.add_internal_force_of(cell, now.view.state.q, force, now.view.points(), &energies);
    density[k] = energies.strain / solid.cells().volumes[k];
  }
  return FieldValues(std::move(density));
}

FieldValues contact_forces(const FieldsNow& now) {
  std::vector<double> force = now.view.forces.contact.dense();
  for (const Embedding::Follower& follower : now.simulation.model().embedding.followers())  // theirs stand at no face
    for (const Index carrier : follower.carrier) std::fill_n(force.begin() + 3 * carrier, 3, 0.0);
  return FieldValues(std::move(force));
}

template <class Value>
FieldValues of_contact(FieldsNow& now, const std::vector<Value> NodalContact::*values) {
  const NodalContact& contact = now.contact();
  return FieldValues(contact.at_all(contact.*values, now.simulation.mesh().node_count()));
}

bool touches(const Simulation& s) {
  return !s.given().contacts.empty();
}
bool tears(const Simulation& s) {
  return !s.solid().cohesive().empty();
}
bool remembers(const Simulation& s, std::string_view variable) {
  return std::ranges::any_of(s.model().parts, [&](const Part& part) {
    const std::vector<std::string> names = part.material.history();
    return std::ranges::find(names, variable) != names.end();
  });
}
constexpr std::string_view plastic_strain = "equivalent_plastic_strain";
bool yields(const Simulation& s) {
  return remembers(s, plastic_strain);
}

/// How a field is evaluated.
struct Evaluator {
  std::string_view name;
  FieldValues (*evaluate)(FieldsNow&);
  enum class Needs : std::uint8_t { nothing, stress } needs{};
  bool (*is_there)(const Simulation&) = [](const Simulation&) { return true; };
};

constexpr auto from_stress = Evaluator::Needs::stress;
const Evaluator evaluators[] = {
    {.name = "displacement", .evaluate = [](FieldsNow& now) { return kept(now.view.state.q); }},
    {.name = "velocity", .evaluate = [](FieldsNow& now) { return kept(now.view.state.v); }},
    {.name = "acceleration", .evaluate = [](FieldsNow& now) { return kept(now.view.state.a); }},
    {.name = "stress",
     .evaluate = [](FieldsNow& now) { return kept(FieldValues::entries(now.stress())); },
     .needs = from_stress},
    {.name = "von_mises",
     .evaluate =
         [](FieldsNow& now) {
           return of_cells<1>(now.stress(), [](const Voigt& s, double* out) { *out = von_mises(s); });
         },
     .needs = from_stress},
    {.name = "principal_stress",
     .evaluate =
         [](FieldsNow& now) {
           return of_cells<3>(now.stress(),
                              [](const Voigt& s, double* out) { std::ranges::copy(principal_stress(s), out); });
         },
     .needs = from_stress},
    {.name = "maximum_shear_stress",
     .evaluate =
         [](FieldsNow& now) {
           return of_cells<1>(now.stress(), [](const Voigt& s, double* out) {
             const Vec3 values = principal_stress(s);
             *out = 0.5 * (values[0] - values[2]);
           });
         },
     .needs = from_stress},
    {.name = "pressure",
     .evaluate =
         [](FieldsNow& now) {
           return of_cells<1>(now.stress(), [](const Voigt& s, double* out) { *out = carom::pressure(s); });
         },
     .needs = from_stress},
    {.name = "stress_at_nodes",
     .evaluate = [](FieldsNow& now) { return at_nodes(now, 6, FieldValues::entries(now.stress())); },
     .needs = from_stress},
    {.name = "strain",
     .evaluate = [](FieldsNow& now) { return FieldValues(cell_strain(now.simulation.model(), now.view.state.q)); }},
    {.name = "strain_rate",
     .evaluate =
         [](FieldsNow& now) {
           return FieldValues(cell_strain_rate(now.simulation.model(), now.view.state.q, now.view.state.v));
         }},
    {.name = "strain_energy_density", .evaluate = [](FieldsNow& now) { return energy_densities(now); }},
    {.name = "equivalent_plastic_strain_at_nodes",
     .evaluate = [](FieldsNow& now) { return at_nodes(now, 1, now.evaluate(plastic_strain).values); },
     .is_there = yields},
    {.name = "contact_force", .evaluate = [](FieldsNow& now) { return contact_forces(now); }, .is_there = touches},
    {.name = "contact_pressure",
     .evaluate = [](FieldsNow& now) { return of_contact(now, &NodalContact::pressure); },
     .is_there = touches},
    {.name = "contact_gap",
     .evaluate = [](FieldsNow& now) { return of_contact(now, &NodalContact::gap); },
     .is_there = touches},
    {.name = "contact_slip_rate",
     .evaluate = [](FieldsNow& now) { return of_contact(now, &NodalContact::slip_rate); },
     .is_there = touches},
    {.name = "contact_slip", .evaluate = [](FieldsNow& now) { return kept(now.contact_slip); }, .is_there = touches},
    {.name = "contact_status",
     .evaluate = [](FieldsNow& now) { return of_contact(now, &NodalContact::status); },
     .is_there = touches},
    {.name = "contact_damage",
     .evaluate =
         [](FieldsNow& now) {
           return FieldValues(now.simulation.solid().cohesive().nodal_damage(now.view.points().history,
                                                                             now.simulation.mesh().node_count()));
         },
     .is_there = tears},
};

const Evaluator* find(std::string_view name) {
  const auto* const found = std::ranges::find(evaluators, name, &Evaluator::name);
  return found == std::end(evaluators) ? nullptr : found;
}

}  // namespace

std::optional<FieldKind> field_kind(const Simulation& simulation, std::string_view name) {
  const Quantity* quantity = find_quantity(name);
  if (const Evaluator* found = find(name)) {
    if (!found->is_there(simulation)) return std::nullopt;
    return FieldKind{quantity->place, quantity->form};
  }
  if (remembers(simulation, name)) return FieldKind{};
  return std::nullopt;
}

FieldValues FieldsNow::evaluate(std::string_view name) {
  if (const Evaluator* found = find(name)) return found->evaluate(*this);
  return FieldValues(cell_history(simulation.solid(), name, view.points().history));
}

bool FieldsNow::needs_stress(std::string_view name) {
  const Evaluator* found = find(name);
  return found != nullptr && found->needs == from_stress;
}

const std::vector<Voigt>& FieldsNow::stress() {
  if (stress_.empty()) stress_ = cell_stress(simulation.solid(), view.state.q, view.points(), stressed_);
  return stress_;
}

const NodalContact& FieldsNow::contact() {
  if (!contact_) contact_ = nodal_contact(view.forces.rows, view.state.q, view.state.v);
  return *contact_;
}

std::vector<std::string> fields_of(const Simulation& simulation) {
  std::vector<std::string> names;
  for (const Evaluator& evaluator : evaluators)
    if (evaluator.is_there(simulation)) names.emplace_back(evaluator.name);
  for (const Part& part : simulation.model().parts)
    for (std::string& variable : part.material.history())
      if (std::ranges::find(names, variable) == names.end()) names.push_back(std::move(variable));
  return names;
}

std::vector<std::string_view> evaluated_fields() {
  std::vector<std::string_view> names;
  for (const Evaluator& evaluator : evaluators) names.push_back(evaluator.name);
  return names;
}

}  // namespace carom
