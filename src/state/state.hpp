// State: everything that evolves, as a value.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace carom {

/// History of one contact slot, as vectors of space, so that they outlive the row's frame.
struct RowHistory {
  Vec3 slip{};        ///< elastic tangential slip of regularised friction (length)
  Vec3 multiplier{};  ///< force on the positive side (augmented Lagrangian; start value of exact enforcements)
  Index facet = -1;   ///< what the row was behind (ConstraintRows::facet); -1: in front, or out of reach
  friend bool operator==(const RowHistory&, const RowHistory&) = default;
};

/// Everything that decides the next step. v and a are always those at time t. Copying a State is a checkpoint.
struct State {
  double t = 0.0;
  std::vector<double> q;            ///< displacement
  std::vector<double> v;            ///< velocity
  std::vector<double> a;            ///< acceleration
  std::vector<RowHistory> contact;  ///< one entry per contact slot (ConstraintRows::slot)
  std::vector<double> memory;       ///< what else a scheme carries from step to step; made by Scheme::start

  friend bool operator==(const State&, const State&) = default;
};

}  // namespace carom
