#include "view/seen_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>

#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/skin.hpp"

namespace carom {

namespace {

using Side = std::pair<Index, Index>;

Side side_of(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

/// From this frame on something is seen, until this one.
struct Life {
  Index from = 0, until = never;
};

/// Adds faces that are given as linear pieces: sides between two pieces of one face are no edges of the cell.
class SurfaceBuilder {
 public:
  void add(std::span<const Facet> pieces, std::int64_t cell, const Life& life) {
    if (life.until <= life.from) return;
    sides_.clear();
    for (const Facet& piece : pieces)
      for (int a = 0; a < piece.size; ++a) ++sides_[side(piece, a)];
    for (const Facet& piece : pieces) add(piece, static_cast<Index>(cell), life);
  }

  SeenSurface finish() {
    for (SeenTriangle& t : surface_.triangles) {
      surface_.nodes.insert(surface_.nodes.end(), t.node.begin(), t.node.end());
      surface_.cells.push_back(t.cell);
    }
    for (std::vector<Index>* list : {&surface_.nodes, &surface_.cells}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    const auto place = [](const std::vector<Index>& list, Index i) {
      return static_cast<Index>(std::lower_bound(list.begin(), list.end(), i) - list.begin());
    };
    for (SeenTriangle& t : surface_.triangles) {
      for (Index& n : t.node) n = place(surface_.nodes, n);
      t.cell = place(surface_.cells, t.cell);
    }
    return std::move(surface_);
  }

 private:
  static Side side(const Facet& piece, int a) {
    const auto i = static_cast<std::size_t>(a);
    return side_of(piece[i], piece[(i + 1) % static_cast<std::size_t>(piece.size)]);
  }
  std::uint8_t edge(const Facet& piece, int a) const { return sides_.at(side(piece, a)) == 1 ? 1 : 0; }

  void add(const Facet& piece, Index cell, const Life& life) {
    const auto push = [&](const std::array<Index, 3>& nodes, unsigned edges) {
      surface_.triangles.push_back({nodes, cell, static_cast<std::uint8_t>(edges), life.from, life.until});
    };
    if (piece.size == 2) push({piece[0], piece[1], piece[1]}, 1);
    if (piece.size < 3) return;
    const bool is_quad = piece.size == 4;
    const auto bit = [&](int a, int place) { return static_cast<unsigned>(edge(piece, a)) << place; };
    push({piece[0], piece[1], piece[2]}, bit(0, 0) | bit(1, 1) | (is_quad ? 0U : bit(2, 2)));
    if (is_quad) push({piece[0], piece[2], piece[3]}, bit(2, 1) | bit(3, 2));
  }

  std::map<Side, int> sides_;
  SeenSurface surface_;
};

/// A face or bar over its own nodes as linear pieces.
std::vector<Facet> pieces_of(CellType type, std::span<const Index> nodes) {
  std::vector<Facet> pieces;
  for (const FacePiece& p : face_pieces(type)) {
    Facet facet;
    facet.size = p.size;
    for (int a = 0; a < p.size; ++a) {
      const auto i = static_cast<std::size_t>(a);
      facet.node[i] = nodes[p.node[i]];
    }
    pieces.push_back(facet);
  }
  return pieces;
}

Vec3 area_of(const SeenTriangle& t, std::span<const Vec3> at) {
  const auto point = [&](std::size_t a) { return at[static_cast<std::size_t>(t.node[a])]; };
  return cross(subtract(point(1), point(0)), subtract(point(2), point(0)));
}

/// Per node the length of the mean of the unit normals around it: 1 where the surface is flat, less where it is bent.
std::vector<double> flatness(const SeenSurface& surface, std::span<const Vec3> at) {
  std::vector<Vec3> sum(at.size());
  std::vector<double> count(at.size());
  for (const SeenTriangle& t : surface.triangles) {
    const Vec3 area = area_of(t, at);
    const double size = norm(area);
    if (size == 0.0) continue;
    for (const Index n : t.node) {
      Vec3& s = sum[static_cast<std::size_t>(n)];
      s = add(s, scaled(area, 1.0 / size));
      count[static_cast<std::size_t>(n)] += 1.0;
    }
  }
  std::vector<double> flat(at.size(), 1.0);
  for (std::size_t n = 0; n < flat.size(); ++n)
    if (count[n] > 0.0) flat[n] = norm(sum[n]) / count[n];
  return flat;
}

/// By node the number of its cluster, over cubes of this size.
std::pair<std::vector<Index>, std::size_t> clusters(std::span<const Vec3> at, std::span<const Index> part,
                                                    const Vec3& lower, double size) {
  std::unordered_map<std::uint64_t, Index> number;
  std::vector<Index> cluster(at.size());
  for (std::size_t n = 0; n < at.size(); ++n) {
    auto key = static_cast<std::uint64_t>(part[n]);
    for (std::size_t c = 0; c < 3; ++c)
      key = key << 16U | static_cast<std::uint64_t>(std::min((at[n][c] - lower[c]) / size, 65535.0));
    cluster[n] = number.try_emplace(key, static_cast<Index>(number.size())).first->second;
  }
  return {std::move(cluster), number.size()};
}

/// By node a number that two nodes share where they are of one part and seen for the last time in one frame.
std::vector<Index> parts_and_ends(const SeenSurface& surface, std::span<const Index> part) {
  const std::vector<Index> ends = ends_of(surface).of_nodes;
  std::map<std::pair<Index, Index>, Index> number;
  std::vector<Index> numbers;
  for (std::size_t n = 0; n < part.size(); ++n)
    numbers.push_back(number.try_emplace({part[n], ends[n]}, static_cast<Index>(number.size())).first->second);
  return numbers;
}

}  // namespace

bool SeenSurface::changes() const {
  return std::ranges::any_of(triangles, [](const SeenTriangle& t) { return t.from > 0 || t.until < never; });
}

SeenSurface seen_surface(const Mesh& mesh, std::span<const Index> gone) {
  const auto number_of = [&](const CellRef& cell) { return mesh.blocks[at(cell.block)].file_numbers[at(cell.cell)]; };
  const auto end_of = [&](const CellRef& cell) {
    return gone.empty() ? never : gone[static_cast<std::size_t>(number_of(cell))];
  };
  SurfaceBuilder builder;
  const std::vector<OuterFacet> outer = outer_facets(mesh);
  std::vector<Facet> pieces;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    if (dimension(mesh.blocks[at(outer[i].cell.block)].type) < 3) continue;
    pieces.push_back(outer[i].facet);
    const bool goes_on =
        i + 1 < outer.size() && outer[i + 1].cell == outer[i].cell && outer[i + 1].face == outer[i].face;
    if (goes_on) continue;
    builder.add(pieces, number_of(outer[i].cell), {0, end_of(outer[i].cell)});
    pieces.clear();
  }
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    if (dimension(block.type) == 3) continue;
    for (Index k = 0; k < static_cast<Index>(block.size()); ++k) {
      const CellRef cell{static_cast<Index>(b), k};
      builder.add(pieces_of(block.type, block.nodes(k)), number_of(cell), {0, end_of(cell)});
    }
  }
  if (gone.empty()) return builder.finish();
  for (const SharedFace& shared : shared_faces(mesh, [&](const CellRef& cell) { return end_of(cell) < never; })) {
    if (dimension(mesh.blocks[at(shared.other.block)].type) < 3) continue;
    std::vector<OuterFacet> bare;
    append_facets(mesh, shared.other, shared.other_face, bare);
    pieces.clear();
    for (const OuterFacet& facet : bare) pieces.push_back(facet.facet);
    builder.add(pieces, number_of(shared.other), {end_of(shared.cell), end_of(shared.other)});
  }
  return builder.finish();
}

SurfaceEnds ends_of(const SeenSurface& surface) {
  SurfaceEnds ends{std::vector<Index>(surface.nodes.size(), 0), std::vector<Index>(surface.cells.size(), 0)};
  for (const SeenTriangle& t : surface.triangles) {
    for (const Index n : t.node) ends.of_nodes[at(n)] = std::max(ends.of_nodes[at(n)], t.until);
    ends.of_cells[at(t.cell)] = std::max(ends.of_cells[at(t.cell)], t.until);
  }
  return ends;
}

SeenSurface coarsened(const SeenSurface& surface, std::span<const Vec3> at, std::span<const Index> part,
                      std::size_t most) {
  Vec3 lower = at[0], upper = at[0];
  for (const Vec3& x : at)
    for (std::size_t c = 0; c < 3; ++c) lower[c] = std::min(lower[c], x[c]), upper[c] = std::max(upper[c], x[c]);
  const std::vector<Index> kind = parts_and_ends(surface, part);
  const double reach = norm(subtract(upper, lower));
  double size = reach / std::sqrt(static_cast<double>(most));
  auto [cluster, count] = clusters(at, kind, lower, size);
  constexpr double growth = 1.1;
  while (count > most && size < reach) std::tie(cluster, count) = clusters(at, kind, lower, size *= growth);

  const std::vector<double> flat = flatness(surface, at);
  std::vector<Index> chosen(count, -1);
  for (std::size_t n = 0; n < at.size(); ++n) {
    Index& best = chosen[static_cast<std::size_t>(cluster[n])];
    if (best < 0 || flat[n] < flat[static_cast<std::size_t>(best)]) best = static_cast<Index>(n);
  }
  SeenSurface coarse;
  for (const Index n : chosen) coarse.nodes.push_back(n);
  std::sort(coarse.nodes.begin(), coarse.nodes.end());
  std::vector<Index> place(at.size());
  for (std::size_t i = 0; i < coarse.nodes.size(); ++i)
    place[static_cast<std::size_t>(coarse.nodes[i])] = static_cast<Index>(i);
  std::vector<Index> cell_place(surface.cells.size(), -1);
  for (SeenTriangle t : surface.triangles) {
    const bool is_bar = t.node[1] == t.node[2];
    for (Index& n : t.node)
      n = place[static_cast<std::size_t>(chosen[static_cast<std::size_t>(cluster[static_cast<std::size_t>(n)])])];
    if (t.node[0] == t.node[1] || (!is_bar && (t.node[1] == t.node[2] || t.node[2] == t.node[0]))) continue;
    t.edges = is_bar ? 1 : 0;
    Index& cell = cell_place[static_cast<std::size_t>(t.cell)];
    if (cell < 0) {
      cell = static_cast<Index>(coarse.cells.size());
      coarse.cells.push_back(surface.cells[static_cast<std::size_t>(t.cell)]);
    }
    t.cell = cell;
    coarse.triangles.push_back(t);
  }
  for (Index& n : coarse.nodes) n = surface.nodes[static_cast<std::size_t>(n)];
  return coarse;
}

}  // namespace carom
