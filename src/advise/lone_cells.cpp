#include "advise/lone_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "advise/cell_columns.hpp"
#include "base/types.hpp"
#include "solid/element_table.hpp"

namespace carom {

std::vector<std::string> lone_cell_warnings(const Simulation& s) {
  const auto& parts = s.model().parts;
  const auto is_reduced = [](const Part& part) { return part.formulation == Formulation::reduced; };
  if (std::none_of(parts.begin(), parts.end(), is_reduced)) return {};
  const CellColumns columns(s.mesh(), s.solid());
  std::vector<std::string> out;
  std::size_t k = 0;  // the solid has the cells part after part
  for (const Part& part : parts) {
    std::size_t lone = 0;
    for (const std::size_t end = k + part.cells.size(); k < end; ++k) {
      if (!is_reduced(part)) continue;
      int alone = 0;
      for (int axis = 0; axis < columns.dimension(k); ++axis) alone += columns.column(k, axis).cells == 1 ? 1 : 0;
      if (alone >= 2) ++lone;
    }
    if (lone == 0) continue;
    out.push_back(fmt::format(
        "part \"{}\": {} of its {} {} cells are alone across the body in two directions, where reduced "
        "integration leaves modes without a stiffness: they cost no energy and may grow without bound. Take "
        "two cells across in one of them, or formulation = \"{}\"",
        part.name, lone, part.cells.size(), name(part.type),
        part.section == Section::plane_stress ? "full" : "mean_dilatation"));
  }
  return out;
}

}  // namespace carom
