#include "output/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace carom {

namespace {

using D = Dimension;
constexpr auto always = Quantity::Written::by_default;

constexpr Quantity table[] = {
    {.name = "displacement",
     .place = Place::nodes,
     .form = Form::vector,
     .unit = D::length,
     .written = always,
     .meaning = "from the place in the mesh file"},
    {.name = "velocity",
     .place = Place::nodes,
     .form = Form::vector,
     .unit = D::velocity,
     .written = always,
     .meaning = "at the end of the step"},
    {.name = "acceleration",
     .place = Place::nodes,
     .form = Form::vector,
     .unit = D::acceleration,
     .meaning = "at the end of the step"},
    {.name = "stress",
     .place = Place::cells,
     .form = Form::tensor,
     .unit = D::stress,
     .written = always,
     .meaning = "Cauchy stress, the mean of the cell"},
    {.name = "von_mises",
     .place = Place::cells,
     .unit = D::stress,
     .colours = Colours::from_zero,
     .written = always,
     .meaning = "von Mises' equivalent stress of the cell's mean stress",
     .label = "von Mises stress"},
    {.name = "principal_stress",
     .place = Place::cells,
     .form = Form::principal,
     .unit = D::stress,
     .meaning = "principal values of the cell's mean stress, the largest first"},
    {.name = "maximum_shear_stress",
     .place = Place::cells,
     .unit = D::stress,
     .colours = Colours::from_zero,
     .meaning =
         "half the difference of the largest and the smallest principal value of the cell's mean stress (Tresca)"},
    {.name = "pressure",
     .place = Place::cells,
     .unit = D::stress,
     .colours = Colours::both_signs,
     .meaning = "minus a third of the trace of the cell's mean stress: positive where it is compressed"},
    {.name = "stress_at_nodes",
     .place = Place::nodes,
     .form = Form::tensor,
     .unit = D::stress,
     .meaning =
         "mean of the stresses of the cells at the node, weighted by their reference volumes; cells that have gone and "
         "those of rigid bodies do not count"},
    {.name = "strain",
     .place = Place::cells,
     .form = Form::tensor,
     .written = always,
     .meaning =
         "mean of the cell, tensor components; Green-Lagrange's with finite strain; zz of plane cells is 0, bars have the "
         "strain along their axis alone"},
    {.name = "strain_rate",
     .place = Place::cells,
     .form = Form::tensor,
     .unit = D::rate,
     .meaning =
         "mean of the symmetric gradient of the velocity, tensor components; with finite strain in the configuration where "
         "the cell is now"},
    {.name = "strain_energy_density",
     .place = Place::cells,
     .unit = D::stress,
     .colours = Colours::from_zero,
     .meaning =
         "stored energy of the cell's law over its reference volume; 0 in cells of nodal parts, which have none of their "
         "own"},
    {.name = "part",
     .place = Place::mesh,
     .form = Form::category,
     .written = always,
     .meaning = "position of the part in the case, from 0; in every frame"},
    {.name = "equivalent_plastic_strain",
     .place = Place::points,
     .colours = Colours::from_zero,
     .written = always,
     .meaning = "accumulated, the mean of the cell"},
    {.name = "temperature_rise",
     .place = Place::points,
     .unit = D::temperature,
     .colours = Colours::from_zero,
     .meaning = "by plastic work, the mean of the cell"},
    {.name = "damage",
     .place = Place::points,
     .colours = Colours::from_zero,
     .meaning = "Johnson and Cook's, fracture at 1, the mean of the cell"},
    {.name = "largest_plastic_rate",
     .place = Place::points,
     .unit = D::rate,
     .colours = Colours::from_zero,
     .meaning = "largest rate of the equivalent plastic strain in a step so far, the mean of the cell"},
    {.name = "equivalent_plastic_strain_at_nodes",
     .place = Place::nodes,
     .colours = Colours::from_zero,
     .meaning = "mean over the cells at the node, as stress_at_nodes"},
    {.name = "contact_force",
     .place = Place::nodes,
     .form = Form::vector,
     .unit = D::force,
     .written = always,
     .meaning = "force of all contacts on the node"},
    {.name = "contact_pressure",
     .place = Place::nodes,
     .unit = D::stress,
     .colours = Colours::from_zero,
     .written = always,
     .meaning = "normal force per area"},
    {.name = "contact_gap",
     .place = Place::nodes,
     .unit = D::length,
     .written = always,
     .meaning = "positive where it is open"},
    {.name = "contact_slip_rate",
     .place = Place::nodes,
     .unit = D::velocity,
     .colours = Colours::from_zero,
     .meaning = "how fast the surfaces move along each other where they touch, 0 elsewhere"},
    {.name = "contact_slip",
     .place = Place::nodes,
     .unit = D::length,
     .colours = Colours::from_zero,
     .meaning =
         "how far the surfaces have slid along each other while they touched: the integral of contact_slip_rate over time; it grows whichever way they slide"},
    {.name = "contact_status",
     .place = Place::nodes,
     .form = Form::category,
     .written = always,
     .meaning = "0 far from contact, 1 open, 2 sticking or without friction, 3 sliding"},
    {.name = "contact_damage",
     .place = Place::nodes,
     .written = always,
     .meaning = "of ties that tear: 0 intact, 1 torn, -1 elsewhere"},
    {.name = "section_force",
     .place = Place::section,
     .form = Form::vector,
     .unit = D::force,
     .meaning = "what the cells on one side pull the nodes with, their share of weight and inertia there included"},
    {.name = "reaction",
     .place = Place::held,
     .form = Form::vector,
     .unit = D::force,
     .meaning = "force that supports exert on the nodes"},
    {.name = "reaction_moment",
     .place = Place::held,
     .form = Form::vector,
     .unit = D::moment,
     .meaning = "its moment about the mean of the nodes' places in the mesh"},
    {.name = "local_acceleration",
     .place = Place::turning,
     .form = Form::vector,
     .unit = D::acceleration,
     .meaning =
         "as an accelerometer that is fixed to the body has it, but without gravity: along axes that turn with the body and are x, y and z in the mesh file"},
    {.name = "mass", .place = Place::part, .unit = D::mass, .meaning = "of the part"},
    {.name = "momentum",
     .place = Place::part,
     .form = Form::vector,
     .unit = D::momentum,
     .meaning = "sum of mass times velocity"},
    {.name = "kinetic_energy",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "1/2 v.(M v) of its nodes, with the mass of the scheme"},
    {.name = "strain_energy",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "stored by the laws of its cells; 0 of rigid bodies"},
    {.name = "hourglass_energy",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "stored by the stabilisation of its cells with one point"},
    {.name = "distortion_energy",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "stored by the corners of its cells with distortion control"},
    {.name = "plastic_energy",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "what its points have dissipated so far"},
    {.name = "hourglass_loss",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "what the stabilisation of its yielding cells has dissipated so far"},
    {.name = "viscous_loss",
     .place = Place::part,
     .unit = D::energy,
     .meaning = "what bulk viscosity and that of hourglass modes have dissipated in it so far"},
    {.name = "largest_von_mises", .place = Place::part, .unit = D::stress, .meaning = "over its cells, of their means"},
    {.name = "largest_principal_stress",
     .place = Place::part,
     .unit = D::stress,
     .meaning = "over its cells: what breaks glass and ceramics"},
    {.name = "smallest_principal_stress", .place = Place::part, .unit = D::stress, .meaning = "over its cells"},
    {.name = "largest_pressure", .place = Place::part, .unit = D::stress, .meaning = "over its cells"},
    {.name = "largest_plastic_strain",
     .place = Place::part,
     .meaning = "equivalent plastic strain, over its cells, of their means"},
    {.name = "force",
     .place = Place::contact,
     .form = Form::vector,
     .unit = D::force,
     .written = always,
     .meaning = "resultant on the body of the contact's group"},
    {.name = "impulse",
     .place = Place::contact,
     .form = Form::vector,
     .unit = D::impulse,
     .written = always,
     .meaning = "its integral over time"},
    {.name = "moment",
     .place = Place::contact,
     .form = Form::vector,
     .unit = D::moment,
     .written = always,
     .meaning = "its moment about the contact's moment_point"},
    {.name = "penetration",
     .place = Place::contact,
     .unit = D::length,
     .written = always,
     .meaning = "the largest, 0 where it is open"},
    {.name = "closed", .place = Place::contact, .written = always, .meaning = "number of closed rows"},
    {.name = "closings",
     .place = Place::contact,
     .written = always,
     .meaning = "how often it went from open to closed"},
    {.name = "angular_velocity",
     .place = Place::contact,
     .form = Form::vector,
     .unit = D::angular_velocity,
     .written = always,
     .meaning = "of an obstacle that turns"},
    {.name = "time", .place = Place::run, .unit = D::time, .written = always, .meaning = "end of the step"},
    {.name = "dt", .place = Place::run, .unit = D::time, .written = always, .meaning = "length of the step"},
    {.name = "angular_momentum",
     .place = Place::run,
     .form = Form::vector,
     .unit = D::angular_momentum,
     .written = always,
     .meaning = "about the origin"},
    {.name = "momentum_error",
     .place = Place::run,
     .unit = D::momentum,
     .written = always,
     .meaning = "what the balance of momentum misses"},
    {.name = "angular_momentum_error",
     .place = Place::run,
     .unit = D::angular_momentum,
     .written = always,
     .meaning = "what the balance of angular momentum misses"},
    {.name = "imbalance",
     .place = Place::run,
     .unit = D::energy,
     .written = always,
     .meaning = "what the balance of energies misses"},
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
    {Place::turning, "Along axes that turn",
     "Of [[probe]]s at nodes: those of rigid bodies have the axes of their body, others those of the cells at the probe."},
    {Place::section, "Of sections", "Of [[probe]]s with a `side`."},
    {Place::part, "Of parts",
     "Of [[probe]]s with a `part`; momentum and energies are columns of parts.csv, too, as far as a case can have them."},
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
