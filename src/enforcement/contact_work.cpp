#include "enforcement/contact_work.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"

namespace carom {

ContactWork multiplier_work(const State& begin, const State& end, double end_weight) {
  ContactWork out;
  double of_bonds = 0.0;
  const auto add = [&](const ContactResponse& response, double weight) {
    const ConstraintRows& rows = *response.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (response.status[r] == RowStatus::open) continue;
      const Vec3 dw = subtract(rows.relative(r, end.q), rows.relative(r, begin.q));
      const Vec3& force = response.force[r];
      const double normal = weight * force[0] * dw[0], tangential = weight * (force[1] * dw[1] + force[2] * dw[2]);
      if (!admissible(rows.law[r]).feeds_impact()) {
        of_bonds += normal + tangential;
        continue;
      }
      out.impact -= normal;
      out.friction -= tangential;
    }
  };
  if (end_weight < 1.0) add(begin.forces.rows, 1.0 - end_weight);
  add(end.forces.rows, end_weight);
  out.total = of_bonds - out.impact - out.friction;
  return out;
}

namespace {

/// Slots and rows of what is in contact, by increasing slot.
class ClosedRows {
 public:
  explicit ClosedRows(const ContactResponse& response) {
    for (std::size_t r = 0; r < response.status.size(); ++r)
      if (response.status[r] != RowStatus::open) rows_.emplace_back(response.rows->slot[r], r);
    std::ranges::sort(rows_);
  }
  /// Nothing where the slot has no closed row.
  std::optional<std::size_t> at(Index slot) const {
    const auto row = std::ranges::lower_bound(rows_, slot, {}, &std::pair<Index, std::size_t>::first);
    return row == rows_.end() || row->first != slot ? std::nullopt : std::optional(row->second);
  }

 private:
  std::vector<std::pair<Index, std::size_t>> rows_;
};

double friction_of(const ContactResponse& response, std::size_t r) {
  return std::hypot(response.force[r][1], response.force[r][2]);
}

bool has_friction(const ContactResponse& response) {
  return std::ranges::any_of(response.rows->law, [](const RowLaw& law) { return law.eps_T > 0.0; });
}

/// How far row r of `rows` slips over the step beyond what its springs give, in its frame.
Vec3 slipped(const ConstraintRows& rows, std::size_t r, const State& begin, const State& end) {
  const auto slot = static_cast<std::size_t>(rows.slot[r]);
  const Vec3 stretched = subtract(end.forces.rows.history[slot].slip, begin.contact[slot].slip);
  return subtract(subtract(rows.relative(r, end.q), rows.relative(r, begin.q)), rows.to_frame(r, stretched));
}

double work_of_friction(const State& begin, const State& end) {
  const ContactResponse &before = begin.forces.rows, &after = end.forces.rows;
  if (!has_friction(before) && !has_friction(after)) return 0.0;
  const ClosedRows closed_before(before), closed_after(after);
  double work = 0.0;
  for (std::size_t r = 0; r < after.status.size(); ++r) {
    if (after.status[r] != RowStatus::slip) continue;
    const Vec3 slip = slipped(*after.rows, r, begin, end);
    const double last = friction_of(after, r);
    const std::optional<std::size_t> was = closed_before.at(after.rows->slot[r]);
    const double first = was ? friction_of(before, *was) : 0.0;
    work += 0.5 * (first + last) * std::hypot(slip[1], slip[2]);
  }
  for (std::size_t r = 0; r < before.status.size(); ++r) {
    if (before.status[r] == RowStatus::open || closed_after.at(before.rows->slot[r])) continue;
    const Vec3 slip = slipped(*before.rows, r, begin, end), &force = before.force[r];
    work += std::max(0.0, -0.5 * (force[1] * slip[1] + force[2] * slip[2]));
  }
  return work;
}

}  // namespace

ContactWork spring_work(const State& begin, const State& end) {
  ContactWork out{.friction = work_of_friction(begin, end)};
  for (const Forces* forces : {&begin.forces, &end.forces}) {
    const ConstraintRows& rows = *forces->rows.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double f = forces->rows.damper[r];
      if (f != 0.0) out.damping -= 0.5 * f * (rows.relative(r, end.q)[0] - rows.relative(r, begin.q)[0]);
    }
  }
  return out;
}

double trapezoidal_work(const State& begin, const State& end) {
  const NodeForces &f0 = begin.forces.contact, &f1 = end.forces.contact;
  return parallel_sum(f0.size(), [&](std::size_t i) { return 0.5 * (f0[i] + f1[i]) * (end.q[i] - begin.q[i]); });
}

}  // namespace carom
