#include "model/model.hpp"

#include <algorithm>

#include "math/vec3.hpp"

namespace carom {

const Part* Model::part_of(const CellRef& cell) const {
  const CellType type = mesh->blocks[at(cell.block)].type;
  const auto has_it = [&](const Part& part) {
    return part.type == type && std::find(part.cells.begin(), part.cells.end(), cell.cell) != part.cells.end();
  };
  const auto found = std::find_if(parts.begin(), parts.end(), has_it);
  return found == parts.end() ? nullptr : &*found;
}

std::vector<std::vector<Index>> Model::part_of_cells() const {
  std::vector<std::vector<Index>> list;
  for (const CellBlock& block : mesh->blocks) {
    list.emplace_back(block.size(), -1);
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (parts[p].type == block.type)
        for (const Index cell : parts[p].cells) list.back()[at(cell)] = static_cast<Index>(p);
  }
  return list;
}

std::vector<Index> Model::part_numbers() const {
  std::vector<Index> numbers;
  for (std::size_t p = 0; p < parts.size(); ++p)
    numbers.push_back(p == 0 ? 0 : numbers.back() + (parts[p].name == parts[p - 1].name ? 0 : 1));
  return numbers;
}

RotatedPoint rotated_point(const ImposedRotation& rotation, const Vec3& X) {
  const Vec3 r = subtract(X, rotation.centre);
  const Vec3 outward = subtract(r, scaled(rotation.axis, dot(rotation.axis, r)));
  return {outward, cross(rotation.axis, outward)};
}

}  // namespace carom
