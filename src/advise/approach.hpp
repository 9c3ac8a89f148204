// What the contacts of a case will see first, judged from its start alone.
#pragma once

#include <limits>
#include <vector>

#include "build/simulation.hpp"

namespace carom {

/// Sums and extremes over the rows of one contact in the initial state.
struct Approach {
  double gap = std::numeric_limits<double>::infinity();          ///< smallest
  double speed = 0.0;                                            ///< largest closing speed
  double speed_rounding = 0.0;                                   ///< and what rounding may have made of one
  double first_touch = std::numeric_limits<double>::infinity();  ///< earliest time at which a row closes
  double stiffness = 0.0, measure = 0.0;                         ///< sums over the rows that are no guards
  bool has_guards = false;                                       ///< nodes beside means (face_rows.hpp)
  double frequency_squared = 0.0, rate = 0.0;                    ///< largest stiffness and damping of a row over the
                                                                 ///< mass of its first node
};

/// One per contact of the case. Nodes keep their initial velocity, but for those whose motion is imposed: they follow
/// its function (to 1/512 of the run, which is enough to tell a time), obstacles included.
std::vector<Approach> approaches(const Simulation& simulation, const State& state);

}  // namespace carom
