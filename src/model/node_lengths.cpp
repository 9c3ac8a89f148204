#include "model/node_lengths.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "mesh/cell_size.hpp"
#include "parallel/threads.hpp"

namespace carom {

std::shared_ptr<const std::vector<double>> node_lengths(const Model& model) {
  if (model.node_lengths) return model.node_lengths;
  const Mesh& mesh = *model.mesh;
  std::vector<double> length(mesh.node_count(), std::numeric_limits<double>::infinity());
  for (const Part& part : model.parts) {
    if (part.cells.empty()) continue;
    const CellBlock& block = *mesh.block(part.type);
    std::vector<double> of_cell(part.cells.size());
    parallel_each(of_cell.size(), [&](std::size_t k) {
      std::array<Vec3, most_nodes> x;
      const std::span<const Index> nodes = block.nodes(part.cells[k]);
      for (std::size_t a = 0; a < nodes.size(); ++a) x[a] = mesh.coordinates[static_cast<std::size_t>(nodes[a])];
      of_cell[k] = cell_length(part.type, std::span(x).first(nodes.size()));
    });
    for (std::size_t k = 0; k < of_cell.size(); ++k) {
      for (const Index n : block.nodes(part.cells[k]))
        length[static_cast<std::size_t>(n)] = std::min(length[static_cast<std::size_t>(n)], of_cell[k]);
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
