#include "contact/surface_pieces.hpp"

#include <algorithm>
#include <numeric>

namespace carom {

std::vector<Index> surface_pieces(std::span<const Facet> facets) {
  Index last = -1;
  for (const Facet& facet : facets) last = std::max(last, *std::max_element(facet.begin(), facet.end()));
  std::vector<Index> parent(static_cast<std::size_t>(last) + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  for (const Facet& facet : facets)
    for (const Index n : facet) parent[root(n)] = root(facet[0]);
  std::vector<Index> piece;
  for (const Facet& facet : facets) piece.push_back(root(facet[0]));
  return piece;
}

}  // namespace carom
