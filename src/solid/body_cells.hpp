// The cells of the bodies.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"

namespace carom {

/// The cells of all bodies, part after part: all results per cell come in their order.
struct BodyCells {
  std::shared_ptr<const Mesh> mesh;
  std::vector<CellRef> refs;
  /// Reference volume of each (axisymmetric: of the ring) and a length: volume over the largest face area of HEXA8,
  /// area over the longest edge of QUAD4, the length of a bar.
  std::vector<double> volumes, lengths;

  std::size_t size() const { return refs.size(); }
  const CellRef& operator[](std::size_t k) const { return refs[k]; }
  auto begin() const { return refs.begin(); }
  auto end() const { return refs.end(); }
  /// Nodes of cell k.
  std::span<const Index> nodes_of(std::size_t k) const { return mesh->blocks[at(refs[k].block)].nodes(refs[k].cell); }
};

}  // namespace carom
