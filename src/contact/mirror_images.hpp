// The images of a model beyond its planes of symmetry: contact sees the whole of what is there by a half or a quarter.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "contact/slot_keys.hpp"
#include "model/model.hpp"
#include "rows/constraint_rows.hpp"

namespace carom {

/// By node and component: whether it is held at its place all the time.
std::vector<std::array<bool, 3>> held_nodes(const Model& model);

/// A plane x_component = position, and whether the model is below or above.
struct SymmetryPlane {
  std::size_t component = 0;
  double position = 0.0;
  bool is_high = false;
  double tolerance = 0.0;  ///< to which positions are in it
};

/// The planes of symmetry at which surfaces that may touch each other end. A plane is one of symmetry where all cells
/// stand on one side of it, all nodes in it are held across it all the time, and not all of them are held in it as well
/// (as those of a body that is clamped). Two surfaces of a pair end there, or two bodies of a surface that touches
/// itself: facets have edges in the plane. Of two such planes of one component none counts, of models of revolution
/// that of the axis does not; models with rigid bodies or with cells that may go have none.
std::vector<SymmetryPlane> symmetry_planes(const Model& model);

/// Takes the facets in planes of symmetry out of the surfaces of pairs: they are inside of the whole.
void leave_out_cuts(Model& model);

/// A model with its images, of which pairs of facets have rows, and these rows as rows of the model.
///
/// The energy of the whole is a sum over its rows; 1/2^k of it is that of the model with k planes. Of rows that are
/// images of each other one stands for all: a row counts by its share in the model, 1 inside, 1/2 for each plane that
/// it is in, 0 beyond. A row of a node is where that is at the start; one of two edges, of which either may be an
/// image, is where they meet. Images move as what they are images of, so that the force on an image is one on that,
/// reflected (chain rule).
class MirrorImages {
 public:
  explicit MirrorImages(const Model& model);

  bool empty() const { return planes_.empty(); }
  /// Nodes and cells of the model first, then images of the cells at the surfaces; the model itself where there is no
  /// plane.
  const Model& whole() const { return empty() ? model_ : whole_; }
  /// What the log says of them.
  std::string note() const;
  /// True of contacts whose surfaces the whole has with their images.
  static bool has_images(const ContactDefinition& contact);
  /// From dofs of the model to those of the whole.
  void spread(std::vector<double>& values) const;
  /// The share of a row of these nodes (SlotKeys) at x.
  double share(const NodeKey& nodes, const Vec3& x) const;
  /// The share of springs where all of the whole are given.
  double even_share() const { return share_of_all_; }
  /// Appends row r of the whole as one of the model, by its share; none where that is 0.
  void fold(const ConstraintRows& seen, std::size_t r, double share, ConstraintRows& rows) const;

 private:
  using Planes = std::uint8_t;  ///< one bit each

  Index image(Index node, Planes planes) const;
  Surface with_images(const Surface& surface) const;
  void add_images(Mesh& mesh, const std::vector<bool>& is_on_surface);
  void add_nodes(Mesh& mesh, const std::vector<bool>& has_image);
  void add_cells(Mesh& mesh, std::size_t part, std::span<const Index> cells);

  const Model& model_;
  std::vector<SymmetryPlane> planes_;
  std::vector<Planes> in_;                    ///< by node of the model: the planes that it is in
  std::vector<std::vector<Index>> image_of_;  ///< by planes and node; -1: none
  std::vector<Index> of_;                     ///< by image: the node
  std::vector<Planes> by_;                    ///< and the planes that it is reflected by
  double share_of_all_ = 1.0;
  Model whole_;
};

}  // namespace carom
