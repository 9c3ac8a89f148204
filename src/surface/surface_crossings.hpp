// Do surfaces cross? What nodes inside of cells cannot tell: faces and edges that go through each other.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/model.hpp"
#include "surface/box_tree.hpp"
#include "surface/crossing_depth.hpp"
#include "surface/skin_pieces.hpp"

namespace carom {

/// The place where an edge of a skin, or a bar, goes through a facet of a skin.
struct SurfaceCrossing {
  double depth = 0.0;  ///< in cells; without what it was at the start
  Vec3 position{};
  CellRef edge_cell{-1, -1};  ///< a cell at the edge; block -1: nothing crosses
  CellRef cell{-1, -1};       ///< whose face is pierced
};

template <class A>
void fields(A& archive, SurfaceCrossing& x) {
  archive("depth", x.depth);
  archive("position", x.position);
  archive("edge_block", x.edge_cell.block);
  archive("edge_cell", x.edge_cell.cell);
  archive("cell_block", x.cell.block);
  archive("cell", x.cell.cell);
}

/// Whether a look takes the folds of a body with itself, which needs all of its skin.
enum class Folds : std::uint8_t { left_out, seen };

/// Looks for edges of skins, and bars, that pierce facets of skins, of another body or of a fold of their own. The
/// depth is CrossingDepth; of an edge that goes into a body once and out once what undoes one of the two ways undoes
/// the other, so that the least of both counts, and of how far the edge is from where the planes of both sides meet. It
/// is taken over the smallest of the reference lengths of the cells at both. Facets whose cells share nodes with cells
/// at the edge are neighbours and do not count. What crosses at the start does so on purpose: at its nodes growth
/// counts. Of bodies whose boxes are apart nothing but nodes is looked at.
class SurfaceCrossings {
 public:
  /// u: displacement at the start. The model must outlive the object.
  SurfaceCrossings(const Model& model, std::span<const double> u);

  /// Says that at this node of the mesh so much, in cells, was inside already at the start.
  void add_start(Index node, double depth);

  /// The deepest at displacement u; the same bits for any number of threads. Nothing where u is not finite.
  SurfaceCrossing deepest(std::span<const double> u, Folds folds);

  const SkinPieces& skin() const { return skin_; }

 private:
  struct Found {
    double depth;  ///< in cells
    Index edge, piece;
    double length;  ///< of a cell there
    Piercing piercing;
  };
  bool place(std::span<const double> u);
  void choose(Folds folds);
  std::vector<Found> find(std::span<const double> u, Folds folds);
  void join_ways(std::vector<Found>& all) const;
  void meet(Index mine, Index other, Folds folds, std::vector<Found>& found) const;
  bool are_neighbours(Index edge, Index piece) const;
  double at_start(const Found& found) const;

  const Model& model_;
  SkinPieces skin_;
  std::vector<Index> number_;     ///< in the skin, by node of the mesh
  std::vector<double> start_;     ///< by node of the skin: the deepest crossing at it
  std::vector<Vec3> x_;           ///< by node of the skin
  std::vector<Bounds> body_box_;  ///< by body
  std::vector<Index> chosen_;     ///< pieces that may meet others
  std::vector<Bounds> chosen_box_;
  BoxTree tree_;  ///< of the chosen
};

}  // namespace carom
