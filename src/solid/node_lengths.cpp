#include "solid/node_lengths.hpp"

#include <algorithm>
#include <limits>

namespace carom {

std::vector<double> node_lengths(const Solid& solid) {
  std::vector<double> length(solid.node_count(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < solid.cell_count(); ++k) {
    for (const Index node : solid.nodes_of_cell(k)) {
      const auto n = static_cast<std::size_t>(node);
      length[n] = std::min(length[n], solid.cell_lengths()[k]);
    }
  }
  return length;
}

}  // namespace carom
