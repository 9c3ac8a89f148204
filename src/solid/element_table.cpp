#include "solid/element_table.hpp"

#include <algorithm>
#include <array>

namespace carom {

namespace {

using enum CellType;
using enum Section;
using enum Formulation;
using enum VolumeField;

constexpr Element all_elements[] = {
    {hexa8, solid, stabilised, CellKind::Hexa8Stabilised},
    {hexa8, solid, full, CellKind::Hexa8},
    {hexa8, solid, mean_dilatation, CellKind::Hexa8, mean},
    {hexa8, solid, one_point, CellKind::Hexa8OnePoint},
    {tetra4, solid, full, CellKind::Tetra4},
    {tetra4, solid, nodal, CellKind::Tetra4},
    {tetra10, solid, mean_dilatation, CellKind::CompositeTetra, mean},
    {tetra10, solid, full, CellKind::CompositeTetra},
    {penta6, solid, full, CellKind::Penta6},
    {pyra5, solid, full, CellKind::Pyra5},
    {hexa20, solid, full, CellKind::Hexa20},
    {hexa20, solid, mean_dilatation, CellKind::Hexa20, linear_cube},
    {hexa20, solid, reduced, CellKind::Hexa20Reduced},
    {hexa27, solid, full, CellKind::Hexa27},
    {hexa27, solid, mean_dilatation, CellKind::Hexa27, linear_cube},
    {penta15, solid, full, CellKind::Penta15},
    {penta15, solid, mean_dilatation, CellKind::Penta15, linear_wedge},
    {pyra13, solid, full, CellKind::Pyra13},
    {pyra13, solid, mean_dilatation, CellKind::Pyra13, linear_pyramid},
    {quad4, plane_strain, stabilised, CellKind::Quad4PlaneStabilised},
    {quad4, plane_strain, full, CellKind::Quad4Plane},
    {quad4, plane_strain, mean_dilatation, CellKind::Quad4Plane, mean},
    {quad4, plane_strain, one_point, CellKind::Quad4PlaneOnePoint},
    {quad4, plane_stress, stabilised, CellKind::Quad4PlaneStabilised},
    {quad4, plane_stress, full, CellKind::Quad4Plane},
    {quad4, plane_stress, one_point, CellKind::Quad4PlaneOnePoint},
    {quad4, axisymmetric, stabilised, CellKind::Quad4RingStabilised},
    {quad4, axisymmetric, full, CellKind::Quad4Ring},
    {quad4, axisymmetric, mean_dilatation, CellKind::Quad4Ring, mean},
    {quad4, axisymmetric, one_point, CellKind::Quad4RingOnePoint},
    {tria3, plane_strain, full, CellKind::Tria3Plane},
    {tria3, plane_strain, nodal, CellKind::Tria3Plane},
    {tria3, plane_stress, full, CellKind::Tria3Plane},
    {tria3, plane_stress, nodal, CellKind::Tria3Plane},
    {tria3, axisymmetric, full, CellKind::Tria3Ring},
    {tria3, axisymmetric, nodal, CellKind::Tria3Ring},
    {quad8, plane_strain, full, CellKind::Quad8Plane},
    {quad8, plane_strain, mean_dilatation, CellKind::Quad8Plane, linear_square},
    {quad8, plane_strain, reduced, CellKind::Quad8PlaneReduced},
    {quad8, plane_stress, full, CellKind::Quad8Plane},
    {quad8, plane_stress, reduced, CellKind::Quad8PlaneReduced},
    {quad8, axisymmetric, full, CellKind::Quad8Ring},
    {quad8, axisymmetric, mean_dilatation, CellKind::Quad8Ring, linear_square},
    {quad8, axisymmetric, reduced, CellKind::Quad8RingReduced},
    {tria6, plane_strain, full, CellKind::Tria6Plane},
    {tria6, plane_strain, mean_dilatation, CellKind::Tria6Plane, mean},
    {tria6, plane_stress, full, CellKind::Tria6Plane},
    {tria6, axisymmetric, full, CellKind::Tria6Ring},
    {tria6, axisymmetric, mean_dilatation, CellKind::Tria6Ring, mean},
    {line2, bar, full, CellKind::Bar},
};

/// The names of the elements that match, each once: "HEXA8, TETRA4 or TETRA10".
template <class Match, class Name>
std::string list(const Match& match, const Name& name_of) {
  std::vector<std::string> names;
  for (const Element& row : all_elements)
    if (match(row) && std::find(names.begin(), names.end(), name_of(row)) == names.end())
      names.emplace_back(name_of(row));
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 < names.size() ? ", " : " or ") + names[k];
  return text;
}

}  // namespace

std::span<const Element> elements() {
  return all_elements;
}

const Element* find_element(CellType type, Section section, std::optional<Formulation> formulation) {
  const auto* row = std::find_if(std::begin(all_elements), std::end(all_elements), [&](const Element& e) {
    return e.type == type && e.section == section && e.formulation == formulation.value_or(e.formulation);
  });
  return row == std::end(all_elements) ? nullptr : row;
}

std::string_view name(Formulation formulation) {
  constexpr std::array<std::string_view, 6> names{"full",       "mean_dilatation", "one_point",
                                                  "stabilised", "reduced",         "nodal"};
  return names[static_cast<std::size_t>(formulation)];
}

std::string types_of(Section section) {
  return list([&](const Element& e) { return e.section == section; },
              [](const Element& e) { return std::string(name(e.type)); });
}

std::string formulations_of(CellType type, Section section) {
  return list([&](const Element& e) { return e.type == type && e.section == section; },
              [](const Element& e) { return std::string(name(e.formulation)); });
}

}  // namespace carom
