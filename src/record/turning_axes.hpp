// Axes that turn with a body.
#pragma once

#include <span>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/case.hpp"
#include "math/nearest_rotation.hpp"

namespace carom {

/// Axes that are x, y and z in the mesh and turn with what is at some nodes: with a rigid body that all of them follow,
/// else with the cells at them, that is by the rotation in the polar decomposition of the deformation gradient that
/// fits the places of the cells' nodes best (least squares; the gradient itself where it is the same in all cells).
/// Cells that have gone do not count while others are there. Of nodes in one plane, the normal turns with the plane.
class TurningAxes {
 public:
  TurningAxes() = default;
  /// Throws CaseError, naming the probe, where all nodes of the cells stand on one line: nobody knows how it turns
  /// about itself.
  TurningAxes(const CaseProbe& given, std::span<const Index> nodes, const Simulation& simulation);

  /// Where the axes are at the displacements u of the nodes; alive: State::alive().
  Columns3 at(std::span<const double> u, std::span<const std::uint8_t> alive) const;

 private:
  Columns3 of_body(std::span<const double> u) const;
  Columns3 of_cells(std::span<const double> u, const std::vector<Index>& cells) const;

  const Simulation* simulation_ = nullptr;
  const TurningBody* body_ = nullptr;  ///< null: the cells say how they turn
  std::vector<Index> cells_;           ///< positions in Solid::cells()
};

/// Components of a vector along axes.
Vec3 along(const Columns3& axes, const Vec3& v);

}  // namespace carom
