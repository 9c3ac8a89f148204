#include "mesh/structured_block.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <span>

#include "math/vec3.hpp"
#include "mesh/finish_mesh.hpp"

namespace carom {

namespace {

using Kind = StructuredBlock::Kind;

std::size_t dimension(const StructuredBlock& block) {
  return block.kind == Kind::hexa ? 3 : (block.kind == Kind::quad ? 2 : 1);
}

/// Node numbers of one block whose first node has index `first`; directions that the block does not have count 0 cells.
struct Lattice {
  std::array<Index, 3> n;  ///< divisions
  Index first;

  Index node(Index i, Index j, Index k) const { return first + i + (n[0] + 1) * (j + (n[1] + 1) * k); }
};

Lattice lattice_of(const StructuredBlock& block, Index first) {
  Lattice at{{0, 0, 0}, first};
  for (std::size_t c = 0; c < dimension(block); ++c) at.n[c] = block.divisions[c];
  return at;
}

/// From the first corner to the opposite one, or from end to end.
Vec3 extent(const StructuredBlock& block) {
  if (block.kind == Kind::bar) return subtract(block.end, block.origin);
  return {block.size[0], block.size[1], block.kind == Kind::hexa ? block.size[2] : 0.0};
}

Vec3 position(const StructuredBlock& block, const std::array<Index, 3>& ijk) {
  Vec3 x = block.origin;
  if (block.kind == Kind::bar) {
    const double s = static_cast<double>(ijk[0]) / block.divisions[0];
    for (std::size_t c = 0; c < 3; ++c) x[c] = (1.0 - s) * block.origin[c] + s * block.end[c];  // exact at both ends
    return x;
  }
  for (std::size_t c = 0; c < dimension(block); ++c) x[c] += block.size[c] * ijk[c] / block.divisions[c];
  return x;
}

std::size_t node_total(const StructuredBlock& block) {
  std::size_t total = 1;
  for (std::size_t c = 0; c < dimension(block); ++c) total *= static_cast<std::size_t>(block.divisions[c]) + 1;
  return total;
}

void check_size(const StructuredBlock& block) {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  const Vec3 size = extent(block);
  for (std::size_t c = 0; c < 3; ++c) {
    const bool must_be_positive = block.kind != Kind::bar && c < dimension(block);
    if (std::isfinite(block.origin[c]) && std::isfinite(size[c]) && (size[c] > 0 || !must_be_positive)) continue;
    throw CaseError(block.where, "block",
                    fmt::format("origin {} and size {} along {}", block.origin[c], size[c], axes[c]),
                    "a finite origin and a positive size", "Give the lengths of the edges, all positive.");
  }
  if (!(norm(size) > 0))
    throw CaseError(block.where, "block", "a bar whose ends coincide", "two ends apart from each other");
}

void check(const StructuredBlock& block, std::size_t nodes_before) {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  constexpr int kMostDivisions = 1'000'000;  // keeps the products below within 64 bits
  check_size(block);
  for (std::size_t c = 0; c < dimension(block); ++c)
    if (block.divisions[c] < 1 || block.divisions[c] > kMostDivisions)
      throw CaseError(block.where, "block", fmt::format("{} divisions along {}", block.divisions[c], axes[c]),
                      fmt::format("1 to {}", kMostDivisions), "Give the number of cells along each axis.");
  if (nodes_before + node_total(block) > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw CaseError(block.where, "block", fmt::format("{} nodes in all", nodes_before + node_total(block)),
                    "at most 2147483647", "Use fewer divisions.");
}

/// The blocks of the mesh while it grows: HEXA8, QUAD4, LINE2.
constexpr Index kHexas = 0, kQuads = 1, kLines = 2;

void add_cell(Index block, std::span<const Index> nodes, const std::string& group, Mesh& mesh) {
  std::size_t before = 0;
  for (const CellBlock& cells : mesh.blocks) before += cells.size();
  CellBlock& cells = mesh.blocks[static_cast<std::size_t>(block)];
  if (!group.empty()) mesh.cell_groups[group].push_back({block, static_cast<Index>(cells.size())});
  cells.connectivity.insert(cells.connectivity.end(), nodes.begin(), nodes.end());
  cells.file_numbers.push_back(static_cast<std::int64_t>(before) + 1);
}

void add_nodes(const StructuredBlock& block, const Lattice& at, Mesh& mesh) {
  for (Index k = 0; k <= at.n[2]; ++k)
    for (Index j = 0; j <= at.n[1]; ++j)
      for (Index i = 0; i <= at.n[0]; ++i) {
        mesh.coordinates.push_back(position(block, {i, j, k}));
        mesh.node_numbers.push_back(static_cast<std::int64_t>(mesh.coordinates.size()));
      }
}

void add_hexas(const StructuredBlock& block, const Lattice& at, Mesh& mesh) {
  for (Index k = 0; k < at.n[2]; ++k)
    for (Index j = 0; j < at.n[1]; ++j)
      for (Index i = 0; i < at.n[0]; ++i) {
        const std::array<Index, 8> nodes{
            at.node(i, j, k),     at.node(i + 1, j, k),     at.node(i + 1, j + 1, k),     at.node(i, j + 1, k),
            at.node(i, j, k + 1), at.node(i + 1, j, k + 1), at.node(i + 1, j + 1, k + 1), at.node(i, j + 1, k + 1)};
        add_cell(kHexas, nodes, block.cells_group, mesh);
      }
}

void add_cells(const StructuredBlock& block, const Lattice& at, Mesh& mesh) {
  switch (block.kind) {
    case Kind::hexa:
      add_hexas(block, at, mesh);
      break;
    case Kind::quad:
      for (Index j = 0; j < at.n[1]; ++j)
        for (Index i = 0; i < at.n[0]; ++i)
          add_cell(kQuads,
                   std::array{at.node(i, j, 0), at.node(i + 1, j, 0), at.node(i + 1, j + 1, 0), at.node(i, j + 1, 0)},
                   block.cells_group, mesh);
      break;
    case Kind::bar:
      for (Index i = 0; i < at.n[0]; ++i)
        add_cell(kLines, std::array{at.node(i, 0, 0), at.node(i + 1, 0, 0)}, block.cells_group, mesh);
      break;
  }
}

/// Faces of side s = 2 * axis + (0 at min, 1 at max), outward normals.
void add_faces(const std::string& group, const Lattice& at, std::size_t s, Mesh& mesh) {
  const std::size_t axis = s / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto node = [&](Index iu, Index iv) {
    std::array<Index, 3> ijk{};
    ijk[axis] = s % 2 == 0 ? 0 : at.n[axis];
    ijk[u] = iu;
    ijk[v] = iv;
    return at.node(ijk[0], ijk[1], ijk[2]);
  };
  for (Index iv = 0; iv < at.n[v]; ++iv)
    for (Index iu = 0; iu < at.n[u]; ++iu) {
      std::array<Index, 4> face{node(iu, iv), node(iu + 1, iv), node(iu + 1, iv + 1), node(iu, iv + 1)};
      if (s % 2 == 0) std::swap(face[1], face[3]);
      add_cell(kQuads, face, group, mesh);
    }
}

/// Edges of side s = 2 * axis + (0 at min, 1 at max), the body on their left.
void add_edges(const std::string& group, const Lattice& at, std::size_t s, Mesh& mesh) {
  const std::size_t axis = s / 2, u = 1 - axis;
  const auto node = [&](Index iu) {
    const Index side = s % 2 == 0 ? 0 : at.n[axis];
    return axis == 0 ? at.node(side, iu, 0) : at.node(iu, side, 0);
  };
  for (Index iu = 0; iu < at.n[u]; ++iu) {
    std::array<Index, 2> edge{node(iu), node(iu + 1)};
    if (s == 0 || s == 3) std::swap(edge[0], edge[1]);  // down along xmin, back along ymax
    add_cell(kLines, edge, group, mesh);
  }
}

void add_boundaries(const StructuredBlock& block, const Lattice& at, Mesh& mesh) {
  for (std::size_t s = 0; s < 2 * dimension(block); ++s) {
    const std::string& group = block.kind == Kind::bar ? block.end_groups[s] : block.face_groups[s];
    if (group.empty()) continue;
    if (block.kind == Kind::hexa) add_faces(group, at, s, mesh);
    if (block.kind == Kind::quad) add_edges(group, at, s, mesh);
    if (block.kind == Kind::bar) mesh.node_groups[group].push_back(at.node(s == 0 ? 0 : at.n[0], 0, 0));
  }
}

void add_point(const StructuredBlock& block, const StructuredBlock::Point& point, const Lattice& at, Mesh& mesh) {
  const Vec3 from_origin = subtract(point.position, block.origin), size = extent(block);
  std::array<Index, 3> ijk{};
  for (std::size_t c = 0; c < dimension(block); ++c) {
    const double s = block.kind == Kind::bar ? dot(from_origin, size) / dot(size, size) : from_origin[c] / size[c];
    ijk[c] = static_cast<Index>(std::lround(std::fmax(0.0, std::fmin(s * at.n[c], at.n[c]))));  // neither keeps NaN
  }
  const double distance = norm(subtract(point.position, position(block, ijk)));
  const Index node = at.node(ijk[0], ijk[1], ijk[2]);
  if (!(distance <= 1e-6 * norm(size))) {
    const Vec3& x = mesh.coordinates[static_cast<std::size_t>(node)];
    throw CaseError(point.where, "point " + point.name,
                    fmt::format("({}, {}, {}), {:.6g} away from the nearest node", point.position[0], point.position[1],
                                point.position[2], distance),
                    "the position of a node of the block",
                    fmt::format("The nearest node is at ({}, {}, {}).", x[0], x[1], x[2]));
  }
  mesh.node_groups[point.name].push_back(node);
}

void drop_empty_blocks(Mesh& mesh) {
  std::array<Index, 3> place{};
  Index kept = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    place[b] = kept;
    if (mesh.blocks[b].size() > 0) ++kept;
  }
  for (auto& [name, cells] : mesh.cell_groups)
    for (CellRef& ref : cells) ref.block = place[static_cast<std::size_t>(ref.block)];
  std::erase_if(mesh.blocks, [](const CellBlock& cells) { return cells.size() == 0; });
}

}  // namespace

Mesh make_structured_blocks(const std::vector<StructuredBlock>& blocks) {
  Mesh mesh;
  mesh.report.source = "structured block";
  mesh.report.format = "block";
  mesh.blocks = {{CellType::hexa8, {}, {}}, {CellType::quad4, {}, {}}, {CellType::line2, {}, {}}};
  std::vector<Lattice> lattices;
  for (const StructuredBlock& block : blocks) {
    check(block, mesh.node_count());
    lattices.push_back(lattice_of(block, static_cast<Index>(mesh.node_count())));
    add_nodes(block, lattices.back(), mesh);
    add_cells(block, lattices.back(), mesh);
  }
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    add_boundaries(blocks[b], lattices[b], mesh);
    for (const StructuredBlock::Point& point : blocks[b].points) add_point(blocks[b], point, lattices[b], mesh);
  }
  drop_empty_blocks(mesh);
  return finished(std::move(mesh));
}

}  // namespace carom
