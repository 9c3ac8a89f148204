// An edge that goes through a piece of a skin: where, and how far the two would have to be moved apart.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/skin_pieces.hpp"

namespace carom {

/// The place where an edge pierces a triangle (in the plane: a segment).
struct Piercing {
  Vec3 position{}, normal{};  ///< outward
  Index below = -1;           ///< the end that is behind, in the skin's numbers
  double depth = 0.0;         ///< of that end along the normal
};

/// The edge and the piece at positions x of the skin's nodes; quadrilaterals are four triangles about the mean of their
/// nodes. Touching counts, to 1e-9 of the size: an edge that hangs down from a surface pierces it. Where several
/// triangles are pierced, the one in which the end is deepest.
std::optional<Piercing> pierce(const SkinPieces& skin, std::span<const Vec3> x, Index edge, Index piece);

/// Least translation that undoes a piercing as far as the surroundings of both tell: the least overlap, max w . x of
/// the pierced body less min w . x of the other one, over the directions w that can part two bodies without notches
/// (Gottschalk, Lin and Manocha, Proc. SIGGRAPH 1996, p. 171): normals of the piece and those around it, normals of the
/// two pieces at the edge, and products of edges of the one with edges of the other. Each overlap is taken over what
/// the direction concerns, so that surfaces farther on do not count: of the pierced body over the piece and the pieces
/// that give w, of the other one over the pieces at its edge, or the edge alone where these form a notch. Between
/// convex bodies that overlap by less than a cell this is their overlap. The end's depth is the first of the overlaps.
class CrossingDepth {
 public:
  CrossingDepth(const SkinPieces& skin, std::span<const Vec3> x) : skin_(skin), x_(x) {}

  double operator()(const Piercing& piercing, Index edge, Index piece);

 private:
  void collect(const Piercing& piercing, Index edge, Index piece);
  double least_by_faces(Index piece) const;
  double least_by_edges(Index edge, Index piece) const;
  double least_by_pair(Index mine, Index other, Index piece) const;
  void edges_of(std::span<const Index> of, std::vector<Index>& found) const;
  double highest(const Vec3& w, Index piece) const;
  double lowest(const Vec3& w, std::span<const Index> nodes) const;
  Vec3 normal(Index piece) const;
  Vec3 normals_at(Index edge) const;
  bool is_notch(Index edge) const;

  const SkinPieces& skin_;
  std::span<const Vec3> x_;
  std::vector<Index> ring_, sides_, nodes_, mine_, others_;  ///< work space
};

}  // namespace carom
