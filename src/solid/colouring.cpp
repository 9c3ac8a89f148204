#include "solid/colouring.hpp"

#include <bit>
#include <cstdint>

namespace carom {

std::vector<int> colour_chunks(std::size_t node_count, std::span<const std::vector<Index>> chunk_nodes) {
  constexpr int shared_colours = 64;
  std::vector<std::uint64_t> taken(node_count, 0);  // bit k: a chunk of colour k has this node
  std::vector<int> colour;
  int next_single = shared_colours;
  for (const std::vector<Index>& nodes : chunk_nodes) {
    std::uint64_t forbidden = 0;
    for (const Index n : nodes) forbidden |= taken[static_cast<std::size_t>(n)];
    const int lowest = std::countr_one(forbidden);
    if (lowest == shared_colours) {  // no colour left to share: the chunk runs alone
      colour.push_back(next_single++);
      continue;
    }
    for (const Index n : nodes) taken[static_cast<std::size_t>(n)] |= std::uint64_t{1} << lowest;
    colour.push_back(lowest);
  }
  return colour;
}

}  // namespace carom
