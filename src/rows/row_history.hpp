// The memory of a contact slot from step to step.
#pragma once

#include "base/types.hpp"

namespace carom {

/// History of one contact slot, as vectors of space, so that they outlive the row's frame.
struct RowHistory {
  Vec3 slip{};          ///< elastic tangential slip of regularised friction (length)
  Vec3 multiplier{};    ///< force on the positive side (augmented Lagrangian; start value of exact enforcements)
  Index facet = -1;     ///< what the row was behind (ConstraintRows::facet); -1: in front, or out of reach
  double offset = 0.0;  ///< <= 0: taken from the gap, since the row began so deep when cells had gone
  friend bool operator==(const RowHistory&, const RowHistory&) = default;
};

template <class A>
void fields(A& archive, RowHistory& x) {
  archive("slip", x.slip);
  archive("multiplier", x.multiplier);
  archive("facet", x.facet);
  archive("offset", x.offset);
}

}  // namespace carom
