#include "output/mesh_file.hpp"

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "mesh/write_deck.hpp"
#include "mesh/write_gmsh.hpp"
#include "output/file_writer.hpp"
#include "output/med_file.hpp"
#include "output/vtu.hpp"

namespace carom {

namespace {

void write_vtu_mesh(const std::string& path, const Mesh& mesh) {
  FrameCells cells;
  std::vector<std::size_t> first;  // cell of each block
  std::vector<std::int64_t> numbers;
  for (const CellBlock& block : mesh.blocks) {
    first.push_back(numbers.size());
    for (std::size_t c = 0; c < block.size(); ++c) cells.add(block.nodes(static_cast<Index>(c)), block.type);
    numbers.insert(numbers.end(), block.file_numbers.begin(), block.file_numbers.end());
  }
  std::vector<FrameField> of_points{{"node_number", 1, mesh.node_numbers}}, of_cells{{"cell_number", 1, numbers}};
  for (const auto& [name, nodes] : mesh.node_groups) {
    std::vector<std::uint8_t> is_in(mesh.node_count());
    for (const Index n : nodes) is_in[at(n)] = 1;
    of_points.push_back({name, 1, std::move(is_in)});
  }
  for (const auto& [name, members] : mesh.cell_groups) {
    std::vector<std::uint8_t> is_in(numbers.size());
    for (const CellRef& cell : members) is_in[first[at(cell.block)] + at(cell.cell)] = 1;
    of_cells.push_back({name, 1, std::move(is_in)});
  }
  write_vtu(path, {mesh.coordinates, std::move(cells), std::move(of_points), std::move(of_cells)});
}

}  // namespace

void write_mesh(const std::string& path, const Mesh& mesh) {
  const std::string end = std::filesystem::path(path).extension().string();
  if (end == ".msh") return write_file(path, gmsh_text(mesh));
  if (end == ".inp") return write_file(path, deck_text(mesh));
  if (end == ".med") return write_med(path, mesh);
  if (end == ".vtu") return write_vtu_mesh(path, mesh);
  throw CaseError({path, 0, 0}, "", end.empty() ? "a name without an ending" : "the ending " + end,
                  ".msh, .med, .inp or .vtu", "The ending names the format.");
}

}  // namespace carom
