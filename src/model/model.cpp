#include "model/model.hpp"

#include <algorithm>

namespace carom {

const Part* Model::part_of(const CellRef& cell) const {
  const CellType type = mesh->blocks[at(cell.block)].type;
  const auto has_it = [&](const Part& part) {
    return part.type == type && std::find(part.cells.begin(), part.cells.end(), cell.cell) != part.cells.end();
  };
  const auto found = std::find_if(parts.begin(), parts.end(), has_it);
  return found == parts.end() ? nullptr : &*found;
}

}  // namespace carom
