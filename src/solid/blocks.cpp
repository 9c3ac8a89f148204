#include "solid/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "element/hexa8.hpp"
#include "solid/colouring.hpp"

namespace carom {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

CaseError part_error(const Mesh& mesh, const Part& part, std::string found, std::string expected, std::string mend) {
  return {Location{mesh.report.source}, "parts." + part.name, std::move(found), std::move(expected), std::move(mend)};
}

void check_part(const Mesh& mesh, const std::vector<Part>& parts, std::size_t p, std::vector<Index>& owner) {
  const Part& part = parts[p];
  const CellBlock* hexas = mesh.block(CellType::hexa8);
  const std::size_t available = hexas == nullptr ? 0 : hexas->size();
  for (const Index cell : part.cells) {
    if (cell < 0 || at(cell) >= available)
      throw part_error(mesh, part, fmt::format("cell index {}", cell),
                       fmt::format("one of the {} HEXA8 cells of the mesh", available),
                       "parts are made of HEXA8 cells: mesh the part with linear hexahedra");
    const std::int64_t number = hexas->file_numbers[at(cell)];
    if (owner[at(cell)] >= 0)
      throw part_error(mesh, part,
                       fmt::format("cell {}, which is in parts.{} already", number, parts[at(owner[at(cell)])].name),
                       "each cell in one part", "take the cell out of one of the two groups");
    owner[at(cell)] = static_cast<Index>(p);
    const double det_J = hexa8::volume(cell_coordinates(mesh, cell)).smallest_det_J;
    if (!(det_J > 0.0))
      throw part_error(mesh, part, fmt::format("Jacobian determinant {:.3g} in cell {}", det_J, number),
                       "a positive Jacobian determinant at every Gauss point",
                       "mend the cell in the mesh: it is flat, folded or too distorted");
  }
}

std::vector<Index> batch_offsets(const Mesh& mesh, const std::vector<Index>& cells, int lanes) {
  const auto n = static_cast<std::size_t>(lanes);
  const std::size_t batches = (cells.size() + n - 1) / n;
  std::vector<Index> offset(batches * 8 * n);
  for (std::size_t c = 0; c < batches * n; ++c) {
    const auto nodes = cell_nodes(mesh, cells[std::min(c, cells.size() - 1)]);
    for (std::size_t a = 0; a < 8; ++a) offset[((c / n) * 8 + a) * n + c % n] = 3 * nodes[a];
  }
  return offset;
}

/// At most about 64 chunks, so that a layer of a cube of cells fits in one and two colours do, but none so small that
/// starting threads would cost more than it saves.
Index chunk_size(std::size_t cells) {
  constexpr Index smallest = 512, chunks = 64, multiple = 8;
  const auto size = static_cast<Index>((cells + chunks - 1) / chunks);
  return std::max(smallest, (size + multiple - 1) / multiple * multiple);
}

void cut_and_colour(const Mesh& mesh, SolidCells& solid) {
  std::vector<Chunk> chunks;
  std::vector<std::vector<Index>> chunk_nodes;
  const Index size = chunk_size(solid.cells.size());
  for (std::size_t b = 0; b < solid.blocks.size(); ++b) {
    const Block& block = solid.blocks[b];
    for (Index first = 0; first < block.cells; first += size) {
      chunks.push_back({static_cast<Index>(b), first, std::min(size, block.cells - first)});
      std::vector<Index>& nodes = chunk_nodes.emplace_back();
      for (Index c = 0; c < chunks.back().cells; ++c)
        for (const Index n : cell_nodes(mesh, solid.cells[at(block.first + first + c)])) nodes.push_back(n);
    }
  }
  const std::vector<int> colour = colour_chunks(mesh.node_count(), chunk_nodes);
  solid.colour_begin.assign(1, 0);
  const int last = colour.empty() ? -1 : *std::max_element(colour.begin(), colour.end());
  for (int k = 0; k <= last; ++k) {
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (colour[c] == k) solid.chunks.push_back(chunks[c]);
    if (solid.chunks.size() > solid.colour_begin.back()) solid.colour_begin.push_back(solid.chunks.size());
  }
}

}  // namespace

std::array<Index, 8> cell_nodes(const Mesh& mesh, Index cell) {
  std::array<Index, 8> nodes{};
  const auto first = mesh.block(CellType::hexa8)->connectivity.begin() + 8 * static_cast<std::ptrdiff_t>(cell);
  std::copy(first, first + 8, nodes.begin());
  return nodes;
}

std::array<Vec3, 8> cell_coordinates(const Mesh& mesh, Index cell) {
  std::array<Vec3, 8> x{};
  const auto nodes = cell_nodes(mesh, cell);
  for (std::size_t a = 0; a < 8; ++a) x[a] = mesh.coordinates[at(nodes[a])];
  return x;
}

SolidCells make_solid_cells(const Model& model, int lanes) {
  const Mesh& mesh = *model.mesh;
  const CellBlock* hexas = mesh.block(CellType::hexa8);
  std::vector<Index> owner(hexas == nullptr ? 0 : hexas->size(), -1);
  SolidCells solid;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    check_part(mesh, model.parts, p, owner);
    const Part& part = model.parts[p];
    if (part.cells.empty()) continue;
    const auto& material = std::get<LinearElastic>(part.material);
    solid.blocks.push_back({.first = static_cast<Index>(solid.cells.size()),
                            .cells = static_cast<Index>(part.cells.size()),
                            .material = material,
                            .lame = {material.lame_lambda(), material.shear_modulus()},
                            .offset = batch_offsets(mesh, part.cells, lanes)});
    solid.cells.insert(solid.cells.end(), part.cells.begin(), part.cells.end());
  }
  cut_and_colour(mesh, solid);
  return solid;
}

}  // namespace carom
