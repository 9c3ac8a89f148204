// What is seen of the bodies from outside.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// A frame that never comes.
constexpr Index never = std::numeric_limits<Index>::max();

/// A piece of the surface. Nodes and cell are positions in the lists of the SeenSurface. A bar is a triangle whose last
/// two nodes are the same one.
struct SeenTriangle {
  std::array<Index, 3> node{};
  Index cell = 0;
  std::uint8_t edges = 0;  ///< bit e: the side from node e to the next one is an edge of a cell
  Index from = 0;          ///< the first frame in which it is seen
  Index until = never;     ///< the first frame after that in which it is not
};

struct SeenSurface {
  std::vector<Index> nodes;  ///< of the mesh, ascending
  std::vector<Index> cells;  ///< numbers of the cells (CellBlock::file_numbers)
  std::vector<SeenTriangle> triangles;

  /// Are there triangles that come or go?
  bool changes() const;
};

/// The outer faces of solids (outer_facets), all of plane cells, and the axes of bars; and, where cells go, the faces
/// that they lay bare. gone: by number of a cell (CellBlock::file_numbers) the first frame in which it has gone, for
/// good, or never; empty: no cell goes. What is seen in no frame is left out.
SeenSurface seen_surface(const Mesh& mesh, std::span<const Index> gone = {});

/// By node and by cell of a surface the first frame in which nothing of it is seen any more, or never.
struct SurfaceEnds {
  std::vector<Index> of_nodes, of_cells;
};
SurfaceEnds ends_of(const SeenSurface& surface);

/// The surface over at most `most` of its nodes, by vertex clustering (Rossignac and Borrel, "Multi-resolution 3D
/// approximations for rendering complex scenes", 1993): of all nodes of one part in one cube of a grid the one where
/// the surface is bent most stands for all of them, and what has lost its area is gone. It has no edges of cells any
/// more. Nodes that are seen for the last time in different frames do not stand for each other. at, part: per node of
/// the surface.
SeenSurface coarsened(const SeenSurface& surface, std::span<const Vec3> at, std::span<const Index> part,
                      std::size_t most);

}  // namespace carom
