#include "model/node_lengths.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "element/cell_shapes.hpp"
#include "mesh/cell_topology.hpp"

namespace carom {

std::vector<double> node_lengths(const Model& model) {
  const Mesh& mesh = *model.mesh;
  std::vector<double> length(mesh.node_count(), std::numeric_limits<double>::infinity());
  for (const Part& part : model.parts) {
    const auto size = static_cast<std::size_t>(node_count(part.type));
    for (const Index cell : part.cells) {
      const std::span<const Index> nodes =
          std::span(mesh.block(part.type)->connectivity).subspan(size * static_cast<std::size_t>(cell), size);
      std::array<Vec3, 8> x{};
      for (std::size_t a = 0; a < size; ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(nodes[a])];
      const double of_cell = cell_length(std::span(x).first(size));
      for (const Index n : nodes)
        length[static_cast<std::size_t>(n)] = std::min(length[static_cast<std::size_t>(n)], of_cell);
    }
  }
  return length;
}

}  // namespace carom
