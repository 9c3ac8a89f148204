// Distortion control: corners of cells resist before they fold.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "mesh/corner_shapes.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// Energy of a corner per volume and modulus, a function of its volume J over that at rest, with its derivatives. Below
/// the limit J_c:
///   w = J_c ln(J_c / J) - (J_c - J),   w' = 1 - J_c / J,   w'' = J_c / J^2,
/// and below J_c / 10, so that nothing is infinite where a step or an iteration goes through, the parabola that goes on
/// from there. The pressure -w' is 1 at half of the limit, 9 at a tenth and 19 where the corner is flat.
struct CornerEnergy {
  double energy, slope, stiffness;

  CornerEnergy(double J, double limit);
};

/// Of the cells of one part:
///   W = sum over corners with J < J_c of V / n M w(J),
/// V the reference volume of the cell, n the number of its corners, M = lambda + 2 G of the law at rest. Corners above
/// the limit have no force at all. J is the triple product of three edges (mesh/corner_shapes.hpp), over that at rest:
/// W is objective, a function of the displacement alone, with a continuous force. Plane cells have areas. Feeds the
/// ledger's `distortion`. Nothing here allocates but the constructor and frequency_bound.
class DistortionControl {
 public:
  /// None.
  DistortionControl() = default;
  /// Of cells of one type: their nodes, one cell after the other, and their reference volumes.
  DistortionControl(std::shared_ptr<const Mesh> mesh, CellType type, std::vector<Index> nodes,
                    std::span<const double> volumes, double limit, double modulus);

  bool empty() const { return limit_ == 0.0; }

  // `cell` is a position among the cells.

  /// f += dW/du; returns W.
  double add_force(std::size_t cell, std::span<const double> u, std::span<double> f) const;
  /// y += d2W/du2 x
  void add_tangent_action(std::size_t cell, std::span<const double> u, std::span<const double> x,
                          std::span<double> y) const;
  /// K += d2W/du2 of the cell, row 3 a + i being component i of its node a. False where no corner resists.
  bool add_stiffness(std::size_t cell, std::span<const double> u, std::span<double> K) const;
  /// Upper bound of omega^2 of d2W/du2 with these masses of the nodes: the Frobenius norm of M^-1/2 K M^-1/2, which of
  /// a single corner at its limit is omega^2 itself.
  double frequency_bound(std::size_t cell, std::span<const double> u, std::span<const double> mass) const;

 private:
  template <class Visit>
  void for_each_flat_corner(std::size_t cell, std::span<const double> u, const Visit& visit) const;

  std::span<const Index> nodes_of(std::size_t cell) const {
    const std::size_t n = nodes_.size() / scale_.size();
    return std::span<const Index>(nodes_).subspan(n * cell, n);
  }

  std::shared_ptr<const Mesh> mesh_;
  std::span<const CornerFrame> corners_;
  std::vector<Index> nodes_;     ///< of the cells
  std::vector<double> scale_;    ///< V / n M of the cells
  std::vector<double> inverse_;  ///< of the volume at rest of each corner of each cell; 0 where it has none
  double limit_ = 0.0;
};

}  // namespace carom
