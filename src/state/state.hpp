// State: everything that evolves, as a value.
#pragma once

#include <vector>

namespace carom {

/// History of one contact row: the elastic tangential slip in the row's two tangent directions (length).
struct RowHistory {
  double slip_1 = 0.0;
  double slip_2 = 0.0;
  friend bool operator==(const RowHistory&, const RowHistory&) = default;
};

/// Everything that decides the next step. v and a are always those at time t. Copying a State is a checkpoint.
struct State {
  double t = 0.0;
  std::vector<double> q;            ///< displacement
  std::vector<double> v;            ///< velocity
  std::vector<double> a;            ///< acceleration
  std::vector<RowHistory> contact;  ///< one entry per contact row

  friend bool operator==(const State&, const State&) = default;
};

}  // namespace carom
