#include "mesh/structured_block.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "mesh/finish_mesh.hpp"

namespace carom {

namespace {

/// Node and cell numbers of one block whose first node has index `first`.
struct Lattice {
  std::array<Index, 3> n;  ///< divisions
  Index first;

  Index node(Index i, Index j, Index k) const { return first + i + (n[0] + 1) * (j + (n[1] + 1) * k); }
};

std::size_t node_total(const StructuredBlock& block) {
  std::size_t total = 1;
  for (const int n : block.divisions) total *= static_cast<std::size_t>(n) + 1;
  return total;
}

void check(const StructuredBlock& block, std::size_t nodes_before) {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  constexpr int kMostDivisions = 1'000'000;  // keeps the products below within 64 bits
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(block.size[c] > 0) || !std::isfinite(block.size[c]) || !std::isfinite(block.origin[c]))
      throw CaseError(block.where, "block",
                      fmt::format("origin {} and size {} along {}", block.origin[c], block.size[c], axes[c]),
                      "a finite origin and a positive size", "Give the lengths of the edges, all positive.");
    if (block.divisions[c] < 1 || block.divisions[c] > kMostDivisions)
      throw CaseError(block.where, "block", fmt::format("{} divisions along {}", block.divisions[c], axes[c]),
                      fmt::format("1 to {}", kMostDivisions), "Give the number of cells along each axis.");
  }
  if (nodes_before + node_total(block) > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw CaseError(block.where, "block", fmt::format("{} nodes in all", nodes_before + node_total(block)),
                    "at most 2147483647", "Use fewer divisions.");
}

void add_nodes(const StructuredBlock& block, Mesh& mesh) {
  for (int k = 0; k <= block.divisions[2]; ++k)
    for (int j = 0; j <= block.divisions[1]; ++j)
      for (int i = 0; i <= block.divisions[0]; ++i) {
        const std::array<int, 3> at{i, j, k};
        Vec3 x{};
        for (std::size_t c = 0; c < 3; ++c) x[c] = block.origin[c] + block.size[c] * at[c] / block.divisions[c];
        mesh.coordinates.push_back(x);
        mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.coordinates.size()));
      }
}

void add_cells(const StructuredBlock& block, const Lattice& at, Mesh& mesh) {
  CellBlock& hexas = mesh.blocks[0];
  for (Index k = 0; k < at.n[2]; ++k)
    for (Index j = 0; j < at.n[1]; ++j)
      for (Index i = 0; i < at.n[0]; ++i) {
        if (!block.cells_group.empty())
          mesh.cell_groups[block.cells_group].push_back({0, static_cast<Index>(hexas.size())});
        for (Index up = 0; up < 2; ++up) {
          const std::array<Index, 4> ring{at.node(i, j, k + up), at.node(i + 1, j, k + up),
                                          at.node(i + 1, j + 1, k + up), at.node(i, j + 1, k + up)};
          hexas.connectivity.insert(hexas.connectivity.end(), ring.begin(), ring.end());
        }
        hexas.file_numbers.push_back(static_cast<std::int64_t>(hexas.size()) + 1);
      }
}

/// Faces of side s = 2 * axis + (0 at min, 1 at max), outward normals.
void add_faces(const StructuredBlock& block, const Lattice& at, std::size_t s, Mesh& mesh) {
  const std::size_t axis = s / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto node = [&](Index iu, Index iv) {
    std::array<Index, 3> ijk{};
    ijk[axis] = s % 2 == 0 ? 0 : at.n[axis];
    ijk[u] = iu;
    ijk[v] = iv;
    return at.node(ijk[0], ijk[1], ijk[2]);
  };
  CellBlock& quads = mesh.blocks[1];
  for (Index iv = 0; iv < at.n[v]; ++iv)
    for (Index iu = 0; iu < at.n[u]; ++iu) {
      std::array<Index, 4> face{node(iu, iv), node(iu + 1, iv), node(iu + 1, iv + 1), node(iu, iv + 1)};
      if (s % 2 == 0) std::swap(face[1], face[3]);
      mesh.cell_groups[block.face_groups[s]].push_back({1, static_cast<Index>(quads.size())});
      quads.connectivity.insert(quads.connectivity.end(), face.begin(), face.end());
      quads.file_numbers.push_back(static_cast<std::int64_t>(mesh.blocks[0].size() + quads.size()) + 1);
    }
}

void add_point(const StructuredBlock& block, const StructuredBlock::Point& point, const Lattice& at, Mesh& mesh) {
  std::array<Index, 3> ijk{};
  double distance2 = 0, diagonal2 = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double s = (point.position[c] - block.origin[c]) / block.size[c] * at.n[c];
    ijk[c] = static_cast<Index>(std::lround(std::fmax(0.0, std::fmin(s, at.n[c]))));  // fmax(0, NaN) is 0
    const double nearest = block.origin[c] + block.size[c] * ijk[c] / at.n[c];
    distance2 += (point.position[c] - nearest) * (point.position[c] - nearest);
    diagonal2 += block.size[c] * block.size[c];
  }
  const Index node = at.node(ijk[0], ijk[1], ijk[2]);
  if (!(distance2 <= 1e-12 * diagonal2)) {
    const Vec3& x = mesh.coordinates[static_cast<std::size_t>(node)];
    throw CaseError(point.where, "point " + point.name,
                    fmt::format("({}, {}, {}), {:.6g} away from the nearest node", point.position[0], point.position[1],
                                point.position[2], std::sqrt(distance2)),
                    "the position of a node of the block",
                    fmt::format("The nearest node is at ({}, {}, {}).", x[0], x[1], x[2]));
  }
  mesh.node_groups[point.name].push_back(node);
}

}  // namespace

Mesh make_structured_blocks(const std::vector<StructuredBlock>& blocks) {
  Mesh mesh;
  mesh.report.source = "structured block";
  mesh.report.format = "block";
  mesh.blocks = {{CellType::hexa8, {}, {}}, {CellType::quad4, {}, {}}};
  std::vector<Lattice> lattices;
  for (const StructuredBlock& block : blocks) {
    check(block, mesh.node_count());
    lattices.push_back({block.divisions, static_cast<Index>(mesh.node_count())});
    add_nodes(block, mesh);
    add_cells(block, lattices.back(), mesh);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t s = 0; s < 6; ++s)
      if (!blocks[b].face_groups[s].empty()) add_faces(blocks[b], lattices[b], s, mesh);
    for (const StructuredBlock::Point& point : blocks[b].points) add_point(blocks[b], point, lattices[b], mesh);
  }
  std::erase_if(mesh.blocks, [](const CellBlock& cells) { return cells.size() == 0; });
  return finished(std::move(mesh));
}

}  // namespace carom
