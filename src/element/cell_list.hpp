// The kinds of cells that the solids are made of: one line each.
#pragma once

#include <iterator>

/// X(cell), one line each: CellKind::<cell> and the class <cell>Cell (element/cells.hpp).
#define CAROM_CELLS(X)    \
  X(Hexa8)                \
  X(Hexa8OnePoint)        \
  X(Hexa8Stabilised)      \
  X(Hexa20)               \
  X(Hexa20Reduced)        \
  X(Hexa27)               \
  X(Penta6)               \
  X(Penta15)              \
  X(Pyra5)                \
  X(Pyra13)               \
  X(Tetra4)               \
  X(CompositeTetra)       \
  X(Quad4Plane)           \
  X(Quad4PlaneOnePoint)   \
  X(Quad4PlaneStabilised) \
  X(Quad4Ring)            \
  X(Quad4RingOnePoint)    \
  X(Quad4RingStabilised)  \
  X(Quad8Plane)           \
  X(Quad8PlaneReduced)    \
  X(Quad8Ring)            \
  X(Quad8RingReduced)     \
  X(Tria3Plane)           \
  X(Tria3Ring)            \
  X(Tria6Plane)           \
  X(Tria6Ring)            \
  X(Bar)

namespace carom {

#define CAROM_NAME_CELL(cell) cell,
enum class CellKind : unsigned char { CAROM_CELLS(CAROM_NAME_CELL) };
#undef CAROM_NAME_CELL

#define CAROM_LIST_CELL(cell) CellKind::cell,
inline constexpr CellKind all_cell_kinds[] = {CAROM_CELLS(CAROM_LIST_CELL)};
#undef CAROM_LIST_CELL
inline constexpr auto cell_kinds = static_cast<int>(std::size(all_cell_kinds));

}  // namespace carom
