// Where in a cell a point is.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contact/box_tree.hpp"
#include "model/model.hpp"

namespace carom {

/// A cell of eight nodes; a plane cell stands as a prism about its plane, as thick as it is wide.
using Corners = std::array<Vec3, 8>;

/// Parent coordinates of x in the cell, by Newton's method for sum_a N_a(xi) x_a = x from the centre; nothing far
/// outside and in cells that are turned inside out.
std::optional<Vec3> parent_point(const Corners& corners, const Vec3& x);

/// The cells of the parts that have an inside (HEXA8 and QUAD4), part by part, at positions x of the nodes.
struct PlacedCells {
  std::vector<CellRef> ref;
  std::vector<Index> part;                    ///< Model::parts
  std::vector<std::span<const Index>> nodes;  ///< 8 or 4
  std::vector<Corners> corners;
  std::vector<Bounds> bounds;

  PlacedCells(const Model& model, std::span<const Vec3> x);
  /// The nodes have moved.
  void place(std::span<const Vec3> x);
};

/// X + u of all nodes.
std::vector<Vec3> current_positions(const Mesh& mesh, std::span<const double> u);

}  // namespace carom
