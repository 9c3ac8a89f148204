#include "mesh/finish_mesh.hpp"

#include <algorithm>
#include <utility>

#include "base/errors.hpp"
#include "mesh/orientation.hpp"
#include "mesh/renumber.hpp"

namespace carom {

namespace {

template <class T>
void sort_unique(std::vector<T>& entries) {
  if (!std::is_sorted(entries.begin(), entries.end())) std::sort(entries.begin(), entries.end());
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace

Mesh finished(Mesh mesh) {
  if (mesh.blocks.empty())
    throw CaseError({mesh.report.source, 0, 0}, "", "a mesh without cells", "at least one cell",
                    "Save the mesh after meshing, with all its cells.");
  for (auto& [name, nodes] : mesh.node_groups) sort_unique(nodes);
  for (auto& [name, cells] : mesh.cell_groups) {
    sort_unique(cells);
    cells.shrink_to_fit();  // they may be millions
  }
  orient_cells(mesh);
  return renumbered(std::move(mesh));
}

}  // namespace carom
