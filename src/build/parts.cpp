#include "build/parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/types.hpp"
#include "build/eroding_parts.hpp"
#include "build/offered_cells.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"
#include "solid/element_table.hpp"
#include "solid/node_patches.hpp"

namespace carom {

namespace {

std::string names(std::span<const CellType> types) {
  std::vector<std::string_view> list;
  for (const CellType type : types) list.push_back(carom::name(type));
  return fmt::format("{}", fmt::join(list, ", "));
}

/// The type that the case names, if it does.
std::optional<CellType> wanted_type(const CasePart& wanted, Section section) {
  if (!wanted.type) return std::nullopt;
  const std::span<const CellType> types = offered_cells(section);
  const auto found =
      std::find_if(types.begin(), types.end(), [&](CellType type) { return carom::name(type) == **wanted.type; });
  if (found != types.end()) return *found;
  throw CaseError(wanted.type->where, "part.type",
                  fmt::format("\"{}\" with section = \"{}\"", **wanted.type, name(section)), names(types));
}

/// Where the body yields or is nearly incompressible.
bool keeps_volume(const Part& part) {
  constexpr double incompressible = 0.4;
  return !part.material.law->history.empty() || part.material.at_rest().nu > incompressible;
}

/// Cells of second order lock a little where volume is kept: those with a linear function for their volume take it
/// there (docs/cells.md).
bool takes_linear_volume(const Part& part) {
  const Element* element = find_element(part.type, part.section, Formulation::mean_dilatation);
  return keeps_volume(part) && element != nullptr && *element->dilatation != VolumeField::mean;
}

/// Cells of one strain each have too few freedoms to keep their volume, their nodes have enough (docs/cells.md).
bool takes_nodes(const Part& part, const Mesh& mesh) {
  return keeps_volume(part) && part.section != Section::plane_stress &&
         find_element(part.type, part.section, Formulation::nodal) != nullptr &&
         largest_valence(mesh, part.type, part.cells).is_within_patch();
}

/// The formulation of that name, if the element table has it for the cells.
std::optional<Formulation> named_formulation(const Part& part, const std::string& wanted) {
  for (const Element& row : elements())
    if (row.type == part.type && row.section == part.section && carom::name(row.formulation) == wanted)
      return row.formulation;
  return std::nullopt;
}

/// That of a part for which the case names none; empty: the first of the element table. may_go: its cells erode.
std::optional<Formulation> own_formulation(const Part& part, const Mesh& mesh, bool may_go) {
  if (takes_linear_volume(part)) return Formulation::mean_dilatation;
  return !may_go && takes_nodes(part, mesh) ? std::optional(Formulation::nodal) : std::nullopt;
}

Formulation formulation_of(const Part& part) {
  return find_element(part.type, part.section, part.formulation)->formulation;
}

/// Of cells that hourglass modes have a stiffness of.
bool takes_hourglass(const Part& part) {
  const Formulation own = formulation_of(part);
  return own == Formulation::one_point || own == Formulation::stabilised || own == Formulation::nodal;
}

/// Takes the coefficients of stabilisation and viscosity: those of modes where the cells have some.
void choose_coefficients(const CasePart& wanted, std::span<Part> of_types) {
  const auto of_modes = [&](const std::optional<Located<double>>& given, const char* key, const auto& is_taken,
                            const char* expected, const auto& take) {
    if (!given || **given == 0.0) return;
    if (std::none_of(of_types.begin(), of_types.end(), is_taken))
      throw CaseError(given->where, key,
                      fmt::format("formulation \"{}\"{}", carom::name(formulation_of(of_types.front())),
                                  wanted.formulation ? "" : ", which these cells have without the key"),
                      expected, fmt::format("leave out {} or give the part that formulation", key));
    for (Part& part : of_types)
      if (is_taken(part)) take(part, **given);
  };
  of_modes(wanted.hourglass, "part.hourglass", takes_hourglass,
           "formulation = \"one_point\", \"stabilised\" or \"nodal\"",
           [](Part& part, double value) { part.hourglass = value; });
  of_modes(
      wanted.hourglass_viscosity, "part.hourglass_viscosity",
      [](const Part& part) { return formulation_of(part) == Formulation::one_point; }, "formulation = \"one_point\"",
      [](Part& part, double value) { part.viscosity.hourglass = value; });
}

/// Corners resist in the direction in which they stand, where small strain knows the one at rest alone.
void choose_distortion_control(const CasePart& wanted, Part& part) {
  if (!wanted.distortion_control) return;
  const auto refuse = [&](const std::string& found, const std::string& expected, const std::string& mend) {
    throw CaseError(wanted.distortion_control->where, "part.distortion_control", found, expected, mend);
  };
  if (part.section == Section::bar)
    refuse("section = \"bar\"", "cells with corners", "Leave it out: bars cannot fold.");
  const Law& law = *part.material.law;
  if (law.measure == Measure::small_strain)
    refuse(fmt::format("law = \"{}\" of small strain, which a cell that nearly folds means nothing to", law.name),
           fmt::format("law = {}", law.when_turning), "Take that law, or leave distortion_control out.");
  part.distortion_control = **wanted.distortion_control;
}

/// Where a lateral stress vanishes, Newton's method finds its strain.
void refuse_without_tangent(const CasePart& wanted, const Part& part) {
  const Law& law = *part.material.law;
  if (law.has_tangent || free_directions(part.section) == 0) return;
  throw CaseError(wanted.where, "part.section",
                  fmt::format("\"{}\" with the law \"{}\", which gives no tangent", name(part.section), law.name),
                  "a section without free lateral directions: solid, plane_strain or axisymmetric",
                  "Or give the law a tangent (docs/user_laws.md).");
}

std::string describe(const Part& part) {
  if (part.section == Section::solid || part.section == Section::axisymmetric)
    return fmt::format("\"{}\" ({})", part.name, name(part.section));
  return fmt::format("\"{}\" ({}, {} {:g})", part.name, name(part.section),
                     part.section == Section::bar ? "area" : "thickness", part.thickness);
}

}  // namespace

std::string_view name(Section section) {
  static constexpr std::array<std::string_view, 5> names{"solid", "plane_strain", "plane_stress", "axisymmetric",
                                                         "bar"};
  return names.at(static_cast<std::size_t>(section));
}

Parts::Parts(const Case& given, const Mesh& mesh, const Groups& groups)
    : mesh_(mesh), holds_node_(mesh.node_count(), Hold::none) {
  for (const CellBlock& block : mesh.blocks) part_of_cell_.emplace_back(block.size(), -1);
  for (const CasePart& part : given.parts) add(given, part, groups);
}

void Parts::add(const Case& given, const CasePart& wanted, const Groups& groups) {
  const auto material = std::find_if(given.materials.begin(), given.materials.end(),
                                     [&](const CaseMaterial& m) { return m.name == *wanted.material; });
  Part part;
  part.name = *wanted.name;
  part.material = material->made();
  part.section = wanted.section;
  part.thickness = part.section == Section::bar ? wanted.area : wanted.thickness;
  part.viscosity.linear = wanted.linear_bulk_viscosity;
  part.viscosity.quadratic = wanted.quadratic_bulk_viscosity;
  choose_distortion_control(wanted, part);
  refuse_without_tangent(wanted, part);
  const std::span<const CellType> types = offered_cells(part.section);
  Groups::CellsByType found =
      groups.cells(wanted.cells, "part.cells", types,
                   fmt::format("{} cells, since section = \"{}\" (plane cells take plane_strain, plane_stress or "
                               "axisymmetric, lines take bar)",
                               names(types), name(part.section)),
                   wanted_type(wanted, part.section));
  std::vector<Part> of_types;
  for (auto& [type, cells] : found) {
    part.type = type;
    part.cells = std::move(cells);
    of_types.push_back(part);
  }
  choose_formulations(wanted, of_types, erodes(given, *wanted.name));
  choose_coefficients(wanted, of_types);
  for (Part& each : of_types) add(wanted, std::move(each));
}

/// Takes the formulation that the case names for the cells that have it; the others keep their own.
void Parts::choose_formulations(const CasePart& wanted, std::span<Part> of_types, bool may_go) {
  std::vector<std::string> without, expected, own;
  for (Part& part : of_types) {
    std::optional<Formulation> named;
    if (wanted.formulation) named = named_formulation(part, **wanted.formulation);
    part.formulation = named ? named : own_formulation(part, mesh_, may_go);
    if (named) continue;
    const std::string_view type = carom::name(part.type);
    without.emplace_back(type);
    expected.push_back(formulations_of(part.type, part.section) +
                       (of_types.size() > 1 ? fmt::format(" of {}", type) : ""));
    own.push_back(fmt::format("{} \"{}\"", type, carom::name(formulation_of(part))));
  }
  if (!wanted.formulation || without.empty()) return;
  if (without.size() == of_types.size())
    throw CaseError(wanted.formulation->where, "part.formulation",
                    fmt::format("\"{}\" of {} cells with section = \"{}\"", **wanted.formulation,
                                fmt::join(without, " and "), name(of_types.front().section)),
                    fmt::format("{}", fmt::join(expected, "; ")));
  notes_.push_back(fmt::format("part \"{}\": not all of its cells have formulation = \"{}\"; {} instead", *wanted.name,
                               **wanted.formulation, fmt::join(own, ", ")));
}

void Parts::add(const CasePart& wanted, Part part) {
  const auto block = static_cast<std::size_t>(mesh_.block(part.type) - mesh_.blocks.data());
  for (const Index cell : part.cells) {
    Index& owner = part_of_cell_[block][at(cell)];
    if (owner >= 0)
      throw CaseError(
          wanted.cells.where, "part.cells",
          fmt::format("cell {} in part \"{}\" and in part \"{}\"",
                      mesh_.cell_label(mesh_.blocks[block].file_numbers[at(cell)]), parts_[at(owner)].name, part.name),
          "every cell in one part only");
    owner = static_cast<Index>(parts_.size());
    const Hold hold = dimension(part.type) == 3 ? Hold::solid : Hold::plane_or_bar;
    for (const Index n : nodes_of_cell(part, cell)) holds_node_[at(n)] = std::max(holds_node_[at(n)], hold);
  }
  if (dimension(part.type) == 2) check_plane(part, wanted.cells);
  if (part.section == Section::axisymmetric) check_axis(part, wanted.cells);
  if (part.section == Section::bar) check_bars(part, wanted.cells);
  parts_.push_back(std::move(part));
}

void Parts::refuse_cell(const Part& part, Index cell, const Located<std::string>& group, const std::string& found,
                        const std::string& expected) const {
  throw CaseError(group.where, "part.cells",
                  fmt::format("cell {} ({}) {}", mesh_.cell_label(mesh_.block(part.type)->file_numbers[at(cell)]),
                              carom::name(part.type), found),
                  expected);
}

void Parts::check_plane(const Part& part, const Located<std::string>& group) const {
  constexpr double flatness = 1e-9;  // of the cell's diagonal: above the round-off of any writer
  const auto corners = static_cast<std::size_t>(corner_count(part.type));
  for (const Index cell : part.cells) {
    const std::span<const Index> nodes = nodes_of_cell(part, cell);
    const auto x = [&](std::size_t a) { return mesh_.coordinates[at(nodes[a])]; };
    double size = 0.0;
    for (std::size_t a = 0; a < corners; ++a) size = std::max(size, norm(subtract(x(a), x((a + 2) % corners))));
    for (std::size_t a = 1; a < nodes.size(); ++a)
      if (std::abs(x(a)[2] - x(0)[2]) > flatness * size)
        refuse_cell(part, cell, group, "outside of the x-y plane",
                    fmt::format("cells in a plane z = const, since section = \"{}\"", name(part.section)));
    if (plane_turn(mesh_, nodes.first(corners)) != 1)
      refuse_cell(part, cell, group, "numbered clockwise or folded",
                  "counter-clockwise cells (in a mesh without solids they are turned on reading)");
  }
}

void Parts::check_axis(const Part& part, const Located<std::string>& group) const {
  double tolerance = 0.0;
  for (const Index cell : part.cells) tolerance = std::max(tolerance, axis_tolerance(nodes_of_cell(part, cell)));
  for (const Index cell : part.cells)
    for (const Index n : nodes_of_cell(part, cell))
      if (mesh_.coordinates[at(n)][0] < -tolerance)
        refuse_cell(part, cell, group,
                    fmt::format("with node {} at x = {:.6g}", mesh_.node_label(n), mesh_.coordinates[at(n)][0]),
                    "x >= 0, since section = \"axisymmetric\" turns about the y axis");
}

void Parts::check_bars(const Part& part, const Located<std::string>& group) const {
  for (const Index cell : part.cells) {
    const std::span<const Index> nodes = nodes_of_cell(part, cell);
    if (mesh_.coordinates[at(nodes[0])] == mesh_.coordinates[at(nodes[1])])
      refuse_cell(part, cell, group, "without length", "bars whose ends are apart");
  }
}

/// What is at most this far from the axis lies on it: 1e-9 of the largest radius, above the round-off of any writer.
double Parts::axis_tolerance(std::span<const Index> nodes) const {
  double largest = 0.0;
  for (const Index n : nodes) largest = std::max(largest, std::abs(mesh_.coordinates[at(n)][0]));
  return 1e-9 * largest;
}

std::span<const Index> Parts::nodes_of_cell(const Part& part, Index cell) const {
  const auto n = static_cast<std::size_t>(node_count(part.type));
  return {&mesh_.block(part.type)->connectivity[n * at(cell)], n};
}

const Part* Parts::part_of(const CellRef& cell) const {
  const Index part = part_of_cell_[at(cell.block)][at(cell.cell)];
  return part < 0 ? nullptr : &parts_[at(part)];
}

std::vector<Index> Parts::nodes_of(const std::string& name) const {
  std::vector<char> is_member(mesh_.node_count(), 0);
  for (const Part& part : parts_) {
    if (part.name != name) continue;
    for (const Index cell : part.cells)
      for (const Index n : nodes_of_cell(part, cell)) is_member[at(n)] = 1;
  }
  std::vector<Index> nodes;
  for (std::size_t n = 0; n < is_member.size(); ++n)
    if (is_member[n] != 0) nodes.push_back(static_cast<Index>(n));
  return nodes;
}

std::vector<PrescribedMotion> Parts::held() const {
  std::vector<PrescribedMotion> motions;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    if (dimension(part.type) != 2 || (p > 0 && part.name == parts_[p - 1].name)) continue;
    const std::string label = fmt::format("part \"{}\", which is {}", part.name, name(part.section));
    std::vector<Index> nodes = nodes_of(part.name), on_axis;
    const double tolerance = axis_tolerance(nodes);
    std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(on_axis),
                 [&](Index n) { return mesh_.coordinates[at(n)][0] <= tolerance; });
    std::erase_if(nodes, [&](Index n) { return holds_node_[at(n)] == Hold::solid; });
    if (!nodes.empty()) motions.push_back({label, std::move(nodes), 2, MotionKind::velocity, {{0.0}, {0.0}}});
    if (part.section == Section::axisymmetric && !on_axis.empty())
      motions.push_back({label, std::move(on_axis), 0, MotionKind::velocity, {{0.0}, {0.0}}});
  }
  return motions;
}

Surface Parts::surface(const std::vector<OuterFacet>& facets, const Location& where, const std::string& key) const {
  Surface surface;
  const Part* first = nullptr;
  for (const OuterFacet& outer : facets) {
    surface.facets.push_back(outer.facet);
    const Part* part = part_of(outer.cell);
    if (part == nullptr) {
      const CellBlock& block = mesh_.blocks[at(outer.cell.block)];
      if (dimension(block.type) == 3) continue;
      throw CaseError(where, key,
                      fmt::format("the boundary of cell {} ({}), which belongs to no part",
                                  mesh_.cell_label(outer.cell), carom::name(block.type)),
                      "faces, edges or ends of parts");
    }
    if (first == nullptr) first = part;
    if (part->section == first->section && (part->section == Section::solid || part->thickness == first->thickness))
      continue;
    throw CaseError(where, key, fmt::format("pieces of part {} and of part {}", describe(*first), describe(*part)),
                    "a surface of one section and thickness", "Make one group for each of them.");
  }
  if (first != nullptr) {
    surface.section = first->section;
    surface.thickness = first->thickness;
  }
  return surface;
}

}  // namespace carom
