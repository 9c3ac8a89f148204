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

RotatedPoint rotated_point(const ImposedRotation& rotation, const Vec3& X) {
  const Vec3 r = subtract(X, rotation.centre);
  const Vec3 outward = subtract(r, scaled(rotation.axis, dot(rotation.axis, r)));
  return {outward, cross(rotation.axis, outward)};
}

}  // namespace carom
