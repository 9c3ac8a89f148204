// Springs that hold dofs.
#pragma once

#include <cstddef>

namespace carom {

/// A spring between a dof and the ground.
struct DofSpring {
  std::size_t dof = 0;
  double stiffness = 0.0;
};

}  // namespace carom
