#include "enforcement/contact_work.hpp"

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

ContactWork spring_work(const State& begin, const State& end) {
  ContactWork out{.friction = end.forces.rows.slip_work};
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
