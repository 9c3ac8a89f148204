#include "build/offered_cells.hpp"

#include <algorithm>
#include <array>

#include "solid/element_table.hpp"

namespace carom {

namespace {

/// The types of the section in the element table, each once.
std::vector<CellType> types_in_table(Section section) {
  std::vector<CellType> types;
  for (const Element& element : elements())
    if (element.section == section && std::find(types.begin(), types.end(), element.type) == types.end())
      types.push_back(element.type);
  return types;
}

}  // namespace

std::span<const CellType> offered_cells(Section section) {
  static const std::array<std::vector<CellType>, 5> types{
      types_in_table(Section::solid), types_in_table(Section::plane_strain), types_in_table(Section::plane_stress),
      types_in_table(Section::axisymmetric), types_in_table(Section::bar)};
  return types.at(static_cast<std::size_t>(section));
}

}  // namespace carom
