#include "output/frame.hpp"

#include <cassert>

#include "mesh/cell_topology.hpp"

namespace carom {

void FrameCells::add(std::span<const Index> points, CellType type) {
  assert(points.size() == static_cast<std::size_t>(node_count(type)));
  const VtkCellType vtk = vtk_cell_type(type);
  for (std::size_t a = 0; a < points.size(); ++a) connectivity.push_back(points[vtk.order.empty() ? a : vtk.order[a]]);
  ends.push_back(static_cast<Index>(connectivity.size()));
  types.push_back(vtk.number);
}

}  // namespace carom
