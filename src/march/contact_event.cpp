#include "march/contact_event.hpp"

#include <algorithm>

#include "rows/admissible.hpp"

namespace carom {

std::optional<double> contact_event(const State& begin, const State& end, const ContactResponse& at_end,
                                    double tolerance) {
  const ConstraintRows& rows = *at_end.rows;
  const double h = end.t - begin.t;
  std::optional<double> first;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (at_end.status[r] == RowStatus::open || is_bond(rows.law[r]) || rows.is_closed(r, begin.q)) continue;
    const double before = rows.gap_at(r, begin.q);
    const double after = std::min(rows.gap_at(r, end.q), before + h * rows.relative(r, begin.v)[0]);
    if (after >= 0.0 || before <= 0.0) continue;
    const double touch = before / (before - after);
    if ((1.0 - touch) * h <= tolerance) continue;
    const double wanted = touch + 0.5 * tolerance / h;
    first = std::min(wanted, first.value_or(wanted));
  }
  return first;
}

}  // namespace carom
