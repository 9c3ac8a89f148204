// Work of contact over a step, for the books.
#pragma once

#include <span>

#include "energy/ledger.hpp"
#include "state/state.hpp"

namespace carom {

/// Work of the contact forces over a step, and where it went.
struct ContactWork {
  double total = 0.0;
  double friction = 0.0, damping = 0.0, impact = 0.0;
};

/// The work of multipliers over a step (ContactPort::work), each on the rows of its end of the step. The normal part
/// goes to `impact`, the tangential one to `friction`. The work of bonds, whose sides do not part, is rounding and goes
/// nowhere.
ContactWork multiplier_work(const State& begin, const State& end, double end_weight);

/// The work of contact springs that they do not store. It is the work of friction on the slip, of rows that slide or
/// are open at the end, by the mean of the forces at both ends (zero where a row is open); and the work of dampers by
/// the trapezoidal rule, each force on the rows of its end of the step. `total` is left to the caller.
ContactWork spring_work(const State& begin, const State& end);

/// Work of the contact forces over the step by the trapezoidal rule.
double trapezoidal_work(const State& begin, const State& end);

}  // namespace carom
