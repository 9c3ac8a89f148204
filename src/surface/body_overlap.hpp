// Do bodies overlap? A test by geometry alone, that knows nothing of rows.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// The place where a node of a skin is deepest inside a body that it should be outside of.
struct Overlap {
  double depth = 0.0;  ///< in cells; without what it was at the start
  Index node = -1;     ///< -1: nowhere
  Vec3 position{};
  CellRef cell{-1, -1};  ///< the cell that it is inside of, or
  Index contact = -1;    ///< the contact with the obstacle
};

template <class A>
void fields(A& archive, Overlap& x) {
  archive("depth", x.depth);
  archive("node", x.node);
  archive("position", x.position);
  archive("cell_block", x.cell.block);
  archive("cell", x.cell.cell);
  archive("contact", x.contact);
}

/// Looks for nodes of the skins of solids and plane bodies
/// - inside of cells that are neither their own nor neighbours of those: of other bodies, or of a fold of their own.
///   The depth is that under the nearest of the skin's facets at the cell's nodes, whether they are the cell's own or
///   not; a cell without nodes on the skin counts with its length;
/// - inside of rigid obstacles or behind their planes and surfaces, for the nodes that a contact names and all of the
/// bars that they belong
///   to.
/// Depths are taken over the smaller of the reference lengths of the cells at the node and of the cell it is inside of.
/// An overlap at the start is taken to be on purpose, so that only its growth counts. Bars have no inside.
class BodyOverlap {
 public:
  /// u: displacement at the start. The model must outlive the object.
  BodyOverlap(const Model& model, std::span<const double> u);
  ~BodyOverlap();
  BodyOverlap(BodyOverlap&&) noexcept;

  /// The deepest node at displacement u. Costs about as much as a few explicit steps. Each rank looks at cells of its
  /// own, so that all of them call it; it needs to know the displacements of all nodes of the skin and of obstacles.
  Overlap deepest(std::span<const double> u);

  /// Calls visit(node, depth in cells) for the nodes that are inside of cells at the start.
  void each_at_start(const std::function<void(Index, double)>& visit) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace carom
