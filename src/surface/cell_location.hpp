// The place of a point within a cell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/cell_topology.hpp"
#include "model/model.hpp"
#include "surface/box_tree.hpp"

namespace carom {

/// One value or position per corner of a linear solid.
using Corners = std::array<Vec3, 8>;
using CornerValues = std::array<double, 8>;

/// Values at x of the shape functions of a TETRA4, PYRA5, PENTA6 or HEXA8, by Newton's method for sum_a N_a(xi) x_a = x
/// from the centre (one step for a tetrahedron); nothing far outside and in cells that are turned inside out. Those of
/// the pyramid are those of the hexahedron whose upper face is its apex.
std::optional<CornerValues> shape_at(CellType linear, const Corners& corners, const Vec3& x);

/// Which cells are looked at: all, or on several ranks those whose first node is the calling rank's own, so that it
/// holds the displacements of all of their nodes and each cell is looked at by one of them.
enum class CellsOf : std::uint8_t { all, rank };

/// The cells of the parts that have an inside (solids and plane cells), part by part, where the nodes are displaced by
/// u. Quadratic ones are taken by their corners. A plane cell stands as a prism about its plane, as thick as it is
/// wide.
class PlacedCells {
 public:
  /// Places the cells of a model at the displacement u (a dof vector, or empty: none). Model and u must outlive the
  /// object.
  PlacedCells(const Model& model, std::span<const double> u, CellsOf which);
  /// Moves the cells to the displacement u, in threads. u must outlive the calls that follow.
  void place(std::span<const double> u);

  std::size_t size() const { return size_; }
  CellRef ref(std::size_t k) const {
    const Run& run = run_of(k);
    return {run.block, model_->parts[static_cast<std::size_t>(run.part)].cells[k - run.first]};
  }
  Index part(std::size_t k) const { return run_of(k).part; }  ///< Model::parts
  CellType type(std::size_t k) const { return block(k).type; }
  std::span<const Index> nodes(std::size_t k) const { return block(k).nodes(ref(k).cell); }  ///< the corners first
  Vec3 position(Index node) const;

  /// The corners of the solid or of the prism.
  Corners corners(std::size_t k) const;
  /// cell_length at these positions.
  double length(std::size_t k) const;

  /// Those of the cells that are looked at, increasing, in whose bounds (rounded outward) x is.
  void find(const Vec3& x, std::vector<Index>& found) const;
  /// Values at x of the linear shape functions of the corners of cell k (of a plane cell: of both sides of the prism
  /// together), if x is inside by more than `margin`: every face's depth is.
  std::optional<CornerValues> inside(std::size_t k, const Vec3& x, double margin = 0.0) const;
  /// The depth under a face of cell k (its number in cell_faces), as a share of the way to the cell's other corners: 1
  /// less the sum of the values of the face's corners. 0 on the face, 1 at the other corners; (1 -+ xi) / 2 of a HEXA8.
  double depth_under(std::size_t k, std::size_t face, const CornerValues& N) const;

 private:
  /// A box in 255ths of the sides of its cluster's box, rounded outward.
  struct Box {
    std::array<std::uint8_t, 3> low, high;
  };
  /// Cells in a leaf of the tree.
  static constexpr std::size_t cluster = 16;
  using Boxes = std::array<Box, cluster>;
  /// Cells that follow each other: their bounds, and their boxes.
  struct Placed {
    Index first = 0, count = 0;
    Bounds bounds;
    Boxes boxes{};
  };
  /// The cells of a part.
  struct Run {
    std::size_t first;
    Index part, block;
  };
  const Run& run_of(std::size_t k) const;
  const CellBlock& block(std::size_t k) const {
    return model_->mesh->blocks[static_cast<std::size_t>(run_of(k).block)];
  }
  void bound();
  void bound(Placed& placed) const;

  const Model* model_;
  std::span<const double> u_;
  std::vector<Run> runs_;
  std::size_t size_ = 0;
  std::vector<Placed> clusters_;
  std::vector<Bounds> leaves_;  ///< their bounds
  BoxTree tree_;
};

/// X + u of all nodes.
std::vector<Vec3> current_positions(const Mesh& mesh, std::span<const double> u);

}  // namespace carom
