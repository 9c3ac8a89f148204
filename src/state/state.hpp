// State: everything that evolves, as a value.
#pragma once

#include <variant>
#include <vector>

#include "base/types.hpp"
#include "energy/ledger.hpp"

namespace carom {

/// History of one contact slot, as vectors of space, so that they outlive the row's frame.
struct RowHistory {
  Vec3 slip{};        ///< elastic tangential slip of regularised friction (length)
  Vec3 multiplier{};  ///< force on the positive side (augmented Lagrangian; start value of exact enforcements)
  Index facet = -1;   ///< what the row was behind (ConstraintRows::facet); -1: in front, or out of reach
  friend bool operator==(const RowHistory&, const RowHistory&) = default;
};

/// What the generalised-alpha family carries from step to step.
struct GeneralizedAlphaMemory {
  Momentum force;  ///< resultant of the forces, filtered like the accelerations
  friend bool operator==(const GeneralizedAlphaMemory&, const GeneralizedAlphaMemory&) = default;
};

/// What Hulbert and Chung's scheme carries.
struct HulbertChungMemory {
  std::vector<double> e;  ///< the scheme's accelerations
  Momentum force;         ///< resultant of the forces, filtered like them
  friend bool operator==(const HulbertChungMemory&, const HulbertChungMemory&) = default;
};

/// What the nonsmooth generalised-alpha scheme carries.
struct NonsmoothMemory {
  struct Acceleration {
    std::vector<double> value;
    Momentum force;  ///< resultant of M times it, as a force
    friend bool operator==(const Acceleration&, const Acceleration&) = default;
  };
  Acceleration a;  ///< algorithmic
  Acceleration z;  ///< smooth
  friend bool operator==(const NonsmoothMemory&, const NonsmoothMemory&) = default;
};

/// Made by Scheme::start.
using SchemeMemory = std::variant<std::monostate, GeneralizedAlphaMemory, HulbertChungMemory, NonsmoothMemory>;

/// Everything that decides the next step. v and a are always those at time t. Copying a State is a checkpoint.
struct State {
  double t = 0.0;
  std::vector<double> q;            ///< displacement
  std::vector<double> v;            ///< velocity
  std::vector<double> a;            ///< acceleration
  std::vector<RowHistory> contact;  ///< one entry per contact slot (ConstraintRows::slot)
  SchemeMemory memory;              ///< what else the scheme carries

  friend bool operator==(const State&, const State&) = default;
};

}  // namespace carom
