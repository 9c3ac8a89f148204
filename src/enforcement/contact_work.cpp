#include "enforcement/contact_work.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/admissible.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

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

/// Friction of a row that slides.
struct Sliding {
  Index slot;
  double friction;  ///< mu p
};

/// By increasing slot.
std::vector<Sliding> sliding_rows(const ContactResponse& response) {
  std::vector<Sliding> out;
  for (std::size_t r = 0; r < response.status.size(); ++r)
    if (response.status[r] == RowStatus::slip)
      out.push_back({response.rows->slot[r], std::hypot(response.force[r][1], response.force[r][2])});
  std::ranges::sort(out, {}, &Sliding::slot);
  return out;
}

/// How far row r has slipped without its springs in a step that it was closed in from the beginning.
double slipped(const State& begin, const State& end, std::size_t r) {
  const ConstraintRows& rows = *end.forces.rows.rows;
  const auto slot = static_cast<std::size_t>(rows.slot[r]);
  const Vec3 stretched = subtract(end.forces.rows.history[slot].slip, begin.contact[slot].slip);
  const Vec3 w = subtract(subtract(rows.relative(r, end.q), rows.relative(r, begin.q)), rows.to_frame(r, stretched));
  return std::hypot(w[1], w[2]);
}

/// What the mean of the friction at both ends of the step does more on the slip than that at its end, of rows that
/// slide at both.
double work_of_changes(const State& begin, const State& end) {
  const ContactResponse& response = end.forces.rows;
  const std::vector<Sliding> before = sliding_rows(begin.forces.rows);
  double work = 0.0;
  for (std::size_t r = 0; !before.empty() && r < response.status.size(); ++r) {
    if (response.status[r] != RowStatus::slip) continue;
    const Index slot = response.rows->slot[r];
    const auto was = std::ranges::lower_bound(before, slot, {}, &Sliding::slot);
    if (was == before.end() || was->slot != slot) continue;
    const double friction = std::hypot(response.force[r][1], response.force[r][2]);
    work += 0.5 * (was->friction - friction) * slipped(begin, end, r);
  }
  return work;
}

}  // namespace

ContactWork spring_work(const State& begin, const State& end) {
  ContactWork out{.friction = end.forces.rows.slip_work + work_of_changes(begin, end)};
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
