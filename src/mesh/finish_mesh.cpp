#include "mesh/finish_mesh.hpp"

#include <algorithm>
#include <utility>

#include "mesh/orientation.hpp"
#include "mesh/renumber.hpp"

namespace carom {

namespace {

template <class T>
void sort_unique(std::vector<T>& entries) {
  std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace

Mesh finished(Mesh mesh) {
  for (auto& [name, nodes] : mesh.node_groups) sort_unique(nodes);
  for (auto& [name, cells] : mesh.cell_groups) sort_unique(cells);
  orient_cells(mesh);
  return renumbered(std::move(mesh));
}

}  // namespace carom
