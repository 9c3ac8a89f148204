#include "model/bodies.hpp"

#include <map>
#include <numeric>
#include <span>

namespace carom {

std::vector<Index> bodies_of_nodes(const Model& model) {
  const Mesh& mesh = *model.mesh;
  std::vector<Index> parent(mesh.node_count());
  std::iota(parent.begin(), parent.end(), 0);
  const auto at = [](Index i) { return static_cast<std::size_t>(i); };
  const auto root = [&](Index n) {
    while (parent[at(n)] != n) n = parent[at(n)] = parent[at(parent[at(n)])];
    return n;
  };
  std::vector<bool> is_held(mesh.node_count());
  for (const Part& part : model.parts) {
    const CellBlock* block = mesh.block(part.type);
    for (const Index cell : part.cells) {
      const std::span<const Index> nodes = block->nodes(cell);
      for (const Index n : nodes) {
        is_held[at(n)] = true;
        parent[at(root(n))] = root(nodes[0]);
      }
    }
  }
  std::map<Index, Index> first_of;  // parts of one rigid body are one
  for (const Embedding::Follower& follower : model.embedding.followers()) {
    const Index first = first_of.emplace(follower.body, follower.node).first->second;
    parent[at(root(follower.node))] = root(first);
  }
  std::vector<Index> body(mesh.node_count(), -1);
  for (std::size_t n = 0; n < body.size(); ++n)
    if (is_held[n]) body[n] = root(static_cast<Index>(n));
  return body;
}

}  // namespace carom
