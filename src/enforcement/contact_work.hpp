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

/// Work of multipliers over a step (ContactPort::work), those of each end on its rows: the normal part goes to
/// `impact`, the tangential one to `friction`; that of bonds, whose sides do not part, is rounding and goes nowhere.
ContactWork multiplier_work(const State& begin, const State& end, double end_weight);

/// What springs do not store: the work of friction on the slip, of rows that slide at both ends of the step by the mean
/// of both forces, of those that begin to by the force at its end; and that of dampers, trapezoidal, of the forces at
/// each end of the step on that end's rows. `total` is left to the caller.
ContactWork spring_work(const State& begin, const State& end);

/// Work of the contact forces over the step by the trapezoidal rule.
double trapezoidal_work(const State& begin, const State& end);

}  // namespace carom
