// Prescribed motions as degrees of freedom.
#pragma once

#include <cstdint>
#include <vector>

#include "model/model.hpp"

namespace carom {

/// One dof whose motion is imposed.
struct PrescribedDof {
  Index dof = 0;
  std::size_t motion = 0;           ///< index in Supports::motions
  double start_velocity = 0.0;      ///< at t = 0, where the acceleration is imposed
  double cosine = 0.0, sine = 0.0;  ///< of a rotation (RotatedPoint)
};

/// All dofs that do not follow M a = force: prescribed ones, and those of nodes that carry no mass.
class Supports {
 public:
  /// A motion that is imposed on one or more dofs.
  struct Motion {
    MotionKind kind = MotionKind::displacement;
    TimeFunction function;
    TimeFunction travel{};  ///< of a rotation: velocity of its centre
  };

  /// has_mass: one flag per node. Throws std::invalid_argument when two supports impose different motions on one dof,
  /// naming both and the node.
  Supports(const Model& model, const std::vector<bool>& has_mass);

  const std::vector<PrescribedDof>& prescribed() const { return prescribed_; }
  const std::vector<Motion>& motions() const { return motions_; }
  /// One flag per dof: prescribed or without mass.
  const std::vector<bool>& fixed() const { return fixed_; }
  /// The flags of a node: bit c is set where component c is fixed.
  unsigned fixed_components(std::size_t node) const { return fixed_components_[node]; }
  const std::vector<std::uint8_t>& fixed_components() const { return fixed_components_; }
  bool is_prescribed(Index dof) const { return prescribed_flag_[static_cast<std::size_t>(dof)]; }

 private:
  std::vector<PrescribedDof> prescribed_;
  std::vector<Motion> motions_;
  std::vector<bool> fixed_, prescribed_flag_;
  std::vector<std::uint8_t> fixed_components_;
};

}  // namespace carom
