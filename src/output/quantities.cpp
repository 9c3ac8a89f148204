#include "output/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace carom {

namespace {

using D = Dimension;
constexpr auto always = Quantity::Written::by_default;
constexpr auto asked = Quantity::Written::if_asked;

constexpr Quantity table[] = {
    {"displacement", Place::nodes, Form::vector, D::length, Colours::range, always, "from the place in the mesh file"},
    {"velocity", Place::nodes, Form::vector, D::velocity, Colours::range, always, "at the end of the step"},
    {"acceleration", Place::nodes, Form::vector, D::acceleration, Colours::range, asked, "at the end of the step"},
    {"stress", Place::cells, Form::tensor, D::stress, Colours::range, always, "Cauchy stress, the mean of the cell"},
    {"von_mises", Place::cells, Form::scalar, D::stress, Colours::from_zero, always,
     "von Mises' equivalent stress of the cell's mean stress", "von Mises stress"},
    {"principal_stress", Place::cells, Form::principal, D::stress, Colours::range, asked,
     "principal values of the cell's mean stress, the largest first"},
    {"maximum_shear_stress", Place::cells, Form::scalar, D::stress, Colours::from_zero, asked,
     "half the difference of the largest and the smallest principal value of the cell's mean stress (Tresca)"},
    {"pressure", Place::cells, Form::scalar, D::stress, Colours::both_signs, asked,
     "minus a third of the trace of the cell's mean stress: positive where it is compressed"},
    {"stress_at_nodes", Place::nodes, Form::tensor, D::stress, Colours::range, asked,
     "mean of the stresses of the cells at the node, weighted by their reference volumes; cells that have gone and "
     "those of rigid bodies do not count"},
    {"strain", Place::cells, Form::tensor, D::none, Colours::range, always,
     "mean of the cell, tensor components; Green-Lagrange's with finite strain; zz of plane cells is 0, bars have the "
     "strain along their axis alone"},
    {"strain_rate", Place::cells, Form::tensor, D::rate, Colours::range, asked,
     "mean of the symmetric gradient of the velocity, tensor components; with finite strain in the configuration where "
     "the cell is now"},
    {"strain_energy_density", Place::cells, Form::scalar, D::stress, Colours::from_zero, asked,
     "stored energy of the cell's law over its reference volume; 0 in cells of nodal parts, which have none of their "
     "own"},
    {"part", Place::mesh, Form::category, D::none, Colours::range, always,
     "position of the part in the case, from 0; in every frame"},
    {"equivalent_plastic_strain", Place::points, Form::scalar, D::none, Colours::from_zero, always,
     "accumulated, the mean of the cell"},
    {"temperature_rise", Place::points, Form::scalar, D::temperature, Colours::from_zero, asked,
     "by plastic work, the mean of the cell"},
    {"damage", Place::points, Form::scalar, D::none, Colours::from_zero, asked,
     "Johnson and Cook's, fracture at 1, the mean of the cell"},
    {"largest_plastic_rate", Place::points, Form::scalar, D::rate, Colours::from_zero, asked,
     "largest rate of the equivalent plastic strain in a step so far, the mean of the cell"},
    {"equivalent_plastic_strain_at_nodes", Place::nodes, Form::scalar, D::none, Colours::from_zero, asked,
     "mean over the cells at the node, as stress_at_nodes"},
    {"contact_force", Place::nodes, Form::vector, D::force, Colours::range, always,
     "force of all contacts on the node"},
    {"contact_pressure", Place::nodes, Form::scalar, D::stress, Colours::from_zero, always, "normal force per area"},
    {"contact_gap", Place::nodes, Form::scalar, D::length, Colours::range, always, "positive where it is open"},
    {"contact_slip_rate", Place::nodes, Form::scalar, D::velocity, Colours::from_zero, asked,
     "how fast the surfaces move along each other where they touch, 0 elsewhere"},
    {"contact_status", Place::nodes, Form::category, D::none, Colours::range, always,
     "0 far from contact, 1 open, 2 sticking or without friction, 3 sliding"},
    {"contact_damage", Place::nodes, Form::scalar, D::none, Colours::range, always,
     "of ties that tear: 0 intact, 1 torn, -1 elsewhere"},
    {"section_force", Place::section, Form::vector, D::force, Colours::range, asked,
     "what the cells on one side pull the nodes with, their share of weight and inertia there included"},
    {"reaction", Place::held, Form::vector, D::force, Colours::range, asked, "force that supports exert on the nodes"},
    {"reaction_moment", Place::held, Form::vector, D::moment, Colours::range, asked,
     "its moment about the mean of the nodes' places in the mesh"},
    {"mass", Place::part, Form::scalar, D::mass, Colours::range, asked, "of the part"},
    {"momentum", Place::part, Form::vector, D::momentum, Colours::range, asked, "sum of mass times velocity"},
    {"kinetic_energy", Place::part, Form::scalar, D::energy, Colours::range, asked, "with the mass of the scheme"},
    {"strain_energy", Place::part, Form::scalar, D::energy, Colours::range, asked,
     "stored by the laws of its cells; 0 of rigid bodies"},
    {"force", Place::contact, Form::vector, D::force, Colours::range, always,
     "resultant on the body of the contact's group"},
    {"impulse", Place::contact, Form::vector, D::impulse, Colours::range, always, "its integral over time"},
    {"moment", Place::contact, Form::vector, D::moment, Colours::range, always,
     "its moment about the contact's moment_point"},
    {"penetration", Place::contact, Form::scalar, D::length, Colours::range, always, "the largest, 0 where it is open"},
    {"closed", Place::contact, Form::scalar, D::none, Colours::range, always, "number of closed rows"},
    {"closings", Place::contact, Form::scalar, D::none, Colours::range, always,
     "how often it went from open to closed"},
    {"angular_velocity", Place::contact, Form::vector, D::angular_velocity, Colours::range, always,
     "of an obstacle that turns"},
    {"time", Place::run, Form::scalar, D::time, Colours::range, always, "end of the step"},
    {"dt", Place::run, Form::scalar, D::time, Colours::range, always, "length of the step"},
    {"angular_momentum", Place::run, Form::vector, D::angular_momentum, Colours::range, always, "about the origin"},
    {"momentum_error", Place::run, Form::scalar, D::momentum, Colours::range, always,
     "what the balance of momentum misses"},
    {"angular_momentum_error", Place::run, Form::scalar, D::angular_momentum, Colours::range, always,
     "what the balance of angular momentum misses"},
    {"imbalance", Place::run, Form::scalar, D::energy, Colours::range, always, "what the balance of energies misses"},
};

struct PlaceRow {
  Place place;
  std::string_view head, words;
};
constexpr PlaceRow places[] = {
    {Place::nodes, "Of nodes", "Fields of the frames, and of [[probe]]s the mean over their nodes."},
    {Place::cells, "Of cells",
     "Fields of the frames, and of [[probe]]s the mean over the cells that touch their nodes."},
    {Place::points, "Of points",
     "As those of cells, where a law of the case knows them; 0 in cells of other laws. These have a unit and a label; "
     "every other variable that a law remembers ([material_laws.md](material_laws.md), or its library) is a field by "
     "its "
     "name, too."},
    {Place::mesh, "With the mesh", "Beside `node_number` and `cell_number`."},
    {Place::held, "Of supports", "Of [[probe]]s whose nodes are held or moved."},
    {Place::section, "Of sections", "Of [[probe]]s with a `side`."},
    {Place::part, "Of parts", "Of [[probe]]s with a `part`."},
    {Place::contact, "Of contacts", "Columns of contact.csv; obstacles that move have displacement and velocity, too."},
    {Place::run, "Of the run", "Columns of energy.csv, beside the energies and the momentum of all."},
};

std::string unit_text(Dimension unit) {
  return unit == Dimension::none ? std::string() : std::string(name(unit));
}

}  // namespace

std::span<const Quantity> quantities() {
  return table;
}

const Quantity* find_quantity(std::string_view name) {
  const auto* const found = std::ranges::find(table, name, &Quantity::name);
  return found == std::end(table) ? nullptr : found;
}

bool is_field(const Quantity& quantity) {
  return quantity.place <= Place::mesh;
}

bool is_probed(const Quantity& quantity) {
  return quantity.place <= Place::part && quantity.form != Form::category;
}

std::span<const std::string_view> component_names(Form form) {
  static constexpr std::string_view none[]{""}, axes[]{"x", "y", "z"}, pairs[]{"xx", "yy", "zz", "xy", "yz", "zx"},
      ranks[]{"1", "2", "3"};
  switch (form) {
    case Form::vector:
      return axes;
    case Form::tensor:
      return pairs;
    case Form::principal:
      return ranks;
    case Form::scalar:
    case Form::category:
      break;
  }
  return none;
}

std::size_t components(Form form) {
  return component_names(form).size();
}

std::vector<std::string> column_names(std::string_view quantity) {
  const Quantity* found = find_quantity(quantity);
  std::vector<std::string> names;
  for (const std::string_view component : component_names(found == nullptr ? Form::scalar : found->form))
    names.push_back(fmt::format("{}{}{}", quantity, component.empty() ? "" : "_", component));
  return names;
}

std::string label_of(std::string_view quantity) {
  const Quantity* found = find_quantity(quantity);
  if (found != nullptr && !found->label.empty()) return std::string(found->label);
  std::string label(quantity);
  std::ranges::replace(label, '_', ' ');
  return label;
}

std::string quantities_markdown() {
  std::string text =
      "# Quantities\n\n<!-- Written from the table in src/output/quantities.cpp; do not edit. -->\n\n"
      "What a run can write: fields of the frames (`[output] fields`, those with a star by default) and columns of the "
      "tables.\nHow they are meant in detail says [results.md](results.md). Fields of contact are there where the case "
      "has one.\n";
  for (const PlaceRow& place : places) {
    fmt::format_to(std::back_inserter(text),
                   "\n## {}\n\n{}\n\n| name | components | unit | meaning |\n|---|---|---|---|\n", place.head,
                   place.words);
    for (const Quantity& q : table) {
      if (q.place != place.place) continue;
      const bool is_starred = is_field(q) && q.written == always;
      fmt::format_to(std::back_inserter(text), "| `{}`{} | {} | {} | {} |\n", q.name, is_starred ? " *" : "",
                     fmt::join(component_names(q.form), " "), unit_text(q.unit), q.meaning);
    }
  }
  return text;
}

}  // namespace carom
