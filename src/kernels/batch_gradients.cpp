#include "kernels/batch_gradients.hpp"

#include <algorithm>

#include "math/principal_axes.hpp"

namespace carom {

BatchGradients::BatchGradients(const CellBatches& cells)
    : points_(cells.stages->cell->points),
      lanes_(cells.stages->lanes),
      frame_offset_(cells.stages->cell->frame_offset) {
  cells.stages->cell->prepare(*cells.stages->cell, cells.x, cells.offset, cells.thickness, geometry_);
}

BatchGradients::BatchGradients(const CellBatches& cells, const double* u) : BatchGradients(cells) {
  double q[most_stabilised * most_lanes];
  cells.stages->cell->gradients(geometry_, u, cells.offset, gradient_, q);
}

double BatchGradients::volume(int l) const {
  double sum = 0.0;
  for (int p = 0; p < points_; ++p) sum += weight(p, l);
  return sum;
}

void BatchGradients::gradient(int p, int l, double H[3][3]) const {
  for (int c = 0; c < 9; ++c) H[c / 3][c % 3] = gradient_[(9 * p + c) * lanes_ + l];
}

double BatchGradients::least_stretch_squared(int l) const {
  double H[3][3], C[3][3] = {};
  gradient(0, l, H);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) C[i][j] += ((k == i ? 1.0 : 0.0) + H[k][i]) * ((k == j ? 1.0 : 0.0) + H[k][j]);
  const Vec3 squares = principal_axes({C[0][0], C[1][1], C[2][2]}, {C[0][1], C[1][2], C[2][0]}).values;
  return *std::min_element(squares.begin(), squares.end());
}

void BatchGradients::means(double* H) const {
  double total[most_lanes] = {};
  std::fill_n(H, 9 * lanes_, 0.0);
  for (int p = 0; p < points_; ++p) {
    const double* w = geometry_ + p * lanes_;
    for (int l = 0; l < lanes_; ++l) total[l] += w[l];
    for (int c = 0; c < 9; ++c)
      for (int l = 0; l < lanes_; ++l) H[c * lanes_ + l] += w[l] * gradient_[(9 * p + c) * lanes_ + l];
  }
  for (int c = 0; c < 9; ++c)
    for (int l = 0; l < lanes_; ++l) H[c * lanes_ + l] /= total[l];
}

void BatchGradients::frame(int l, double A[3][3]) const {
  for (int c = 0; c < 9; ++c)
    A[c / 3][c % 3] = frame_offset_ == 0 ? (c % 4 == 0 ? 1.0 : 0.0) : geometry_[frame_offset_ + c * lanes_ + l];
}

}  // namespace carom
