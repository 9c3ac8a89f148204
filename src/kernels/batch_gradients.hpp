// Weights and displacement gradients at the points of a batch of cells, lane by lane.
#pragma once

#include "kernels/kernels.hpp"

namespace carom {

/// Of the first batch of some cells.
class BatchGradients {
 public:
  /// Weights, and F at rest.
  explicit BatchGradients(const CellBatches& cells);
  /// And the gradients of u.
  BatchGradients(const CellBatches& cells, const double* u);

  int points() const { return points_; }
  int lanes() const { return lanes_; }
  /// Reference volume that point p of the cell in lane l stands for.
  double weight(int p, int l) const { return geometry_[p * lanes_ + l]; }
  double volume(int l) const;
  /// H_ij = du_i/dX_j in the cell's directions; the deformation gradient is frame + H.
  void gradient(int p, int l, double H[3][3]) const;
  /// Of cells of one point in finite strain, the square of the least stretch: that by which waves of a given speed in
  /// the reference gain on it.
  double least_stretch_squared(int l) const;
  /// Its means over the reference volume, H[(3 i + j) lanes + l].
  void means(double* H) const;
  /// F at rest: 1, or (axis, 0, 0) of bars.
  void frame(int l, double A[3][3]) const;

 private:
  int points_, lanes_, frame_offset_;
  alignas(64) double geometry_[most_geometry * most_lanes];
  alignas(64) double gradient_[9 * most_points * most_lanes];
};

}  // namespace carom
