// Imposed motions in explicit schemes: the acceleration now that brings a dof where it must be next.
#pragma once

#include <span>

#include "schemes/system.hpp"

namespace carom {

/// How the acceleration at t enters what is imposed next: u(t + displacement_time) = u_without + displacement_weight a,
/// v(t + velocity_time) = v_without + velocity_weight a.
struct ImposedNext {
  double displacement_time, displacement_weight;
  double velocity_time, velocity_weight;
};

/// Sets the accelerations of the prescribed dofs. u_without(i) and v_without(i) are the next displacement and velocity
/// of dof i, its acceleration left out.
template <class Displacement, class Velocity>
void impose_motions(const System& system, double t, const ImposedNext& next, const Displacement& u_without,
                    const Velocity& v_without, std::span<double> a) {
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    switch (p.kind) {
      case MotionKind::displacement:
        a[i] = (p.function(t + next.displacement_time) - u_without(i)) / next.displacement_weight;
        break;
      case MotionKind::velocity:
        a[i] = (p.function(t + next.velocity_time) - v_without(i)) / next.velocity_weight;
        break;
      case MotionKind::acceleration:
        a[i] = p.function(t);
        break;
    }
  }
}

}  // namespace carom
