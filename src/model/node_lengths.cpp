#include "model/node_lengths.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mesh/cell_size.hpp"

namespace carom {

std::shared_ptr<const std::vector<double>> node_lengths(const Model& model) {
  if (model.node_lengths) return model.node_lengths;
  const Mesh& mesh = *model.mesh;
  std::vector<double> length(mesh.node_count(), std::numeric_limits<double>::infinity());
  for (const Part& part : model.parts) {
    if (part.cells.empty()) continue;
    const auto size = static_cast<std::size_t>(node_count(part.type));
    const std::span<const Index> connectivity = mesh.block(part.type)->connectivity;
    std::vector<Vec3> x(size);
    for (const Index cell : part.cells) {
      const std::span<const Index> nodes = connectivity.subspan(size * static_cast<std::size_t>(cell), size);
      for (std::size_t a = 0; a < size; ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(nodes[a])];
      const double of_cell = cell_length(part.type, x);
      for (const Index n : nodes)
        length[static_cast<std::size_t>(n)] = std::min(length[static_cast<std::size_t>(n)], of_cell);
    }
  }
  return std::make_shared<const std::vector<double>>(std::move(length));
}

double least_length(std::span<const double> node_lengths, std::span<const Index> nodes) {
  double least = std::numeric_limits<double>::infinity();
  for (const Index n : nodes) least = std::min(least, node_lengths[static_cast<std::size_t>(n)]);
  return least;
}

}  // namespace carom
