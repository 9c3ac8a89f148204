// Rigid obstacles as bodies of their own among the fields.
#pragma once

#include <vector>

#include "build/simulation.hpp"
#include "output/frame.hpp"

namespace carom {

/// The obstacles of a case as surfaces: planes as a square and cylinders as a pipe that span the model, spheres and
/// boxes whole, rigid surfaces as they are. Points stand in the reference position and follow by their displacement.
class ObstacleBodies {
 public:
  explicit ObstacleBodies(const Simulation& simulation);

  bool empty() const { return points_.empty(); }
  /// Does one of them move?
  bool moves() const;
  /// With `contact`, the position of each in the case, from 0. The points stay here.
  FrameMesh mesh() const;
  /// `displacement`.
  FieldFrame frame(const State& state) const;

 private:
  struct Body {
    std::size_t contact = 0, first = 0;  ///< in the case; its first point
  };
  void add_grid(std::size_t rows, std::size_t columns, const std::vector<Vec3>& points);
  void add_shape(const Simulation& simulation, const RigidShape& shape);
  void add_surface(const Mesh& mesh, const Surface& surface);

  const Model& model_;
  std::vector<Body> bodies_;
  std::vector<Vec3> points_;
  FrameCells cells_;
  std::vector<Index> contact_;  ///< per cell
};

}  // namespace carom
