#include "run/offered_cells.hpp"

#include <algorithm>
#include <array>

namespace carom {

std::span<const CellType> offered_cells(Section section) {
  static constexpr std::array solid{CellType::hexa8};
  static constexpr std::array plane{CellType::quad4};
  static constexpr std::array bar{CellType::line2};
  if (section == Section::solid) return solid;
  if (section == Section::bar) return bar;
  return plane;
}

bool is_offered(CellType type, Section section) {
  const std::span<const CellType> types = offered_cells(section);
  return std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace carom
