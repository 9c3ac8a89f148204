#include "enforcement/potential_port.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "rows/bond_springs.hpp"

namespace carom {

namespace {

/// The normal force between the gaps g0 and g1, and its slope -dp/dg1.
struct NormalForce {
  double p = 0.0;
  double slope = 0.0;
};

NormalForce of_linear_spring(double eps_N, double g0, double g1) {
  const double P0 = std::max(0.0, -g0), P1 = std::max(0.0, -g1);
  if (P0 == 0.0 && P1 == 0.0) return {};
  if (P0 > 0.0 && P1 > 0.0) return {0.5 * eps_N * (P0 + P1), 0.5 * eps_N};
  const double closing = g0 - g1;  // at least as large as the penetration: one gap is open
  const double p = 0.5 * eps_N * (P1 - P0) * (P1 + P0) / closing;
  return {p, (eps_N * P1 - p) / closing};
}

/// What the spring has more beyond its linear depth: quotients of E = 1/4 h q^4.
NormalForce of_hardening(const RowLaw& law, double g0, double g1) {
  const double q0 = law.beyond(-g0), q1 = law.beyond(-g1), h = law.hardening();
  if (q0 == 0.0 && q1 == 0.0) return {};
  if (q0 > 0.0 && q1 > 0.0)
    return {0.25 * h * (q0 + q1) * (q0 * q0 + q1 * q1), 0.25 * h * (q0 * q0 + 2.0 * q0 * q1 + 3.0 * q1 * q1)};
  const double closing = g0 - g1;  // at least as large as q0 or q1
  const double p = 0.25 * h * (q1 - q0) * (q1 + q0) * (q0 * q0 + q1 * q1) / closing;
  return {p, (h * q1 * q1 * q1 - p) / closing};
}

NormalForce discrete_derivative(const RowLaw& law, double g0, double g1) {
  const NormalForce linear = of_linear_spring(law.eps_N, g0, g1), more = of_hardening(law, g0, g1);
  return {linear.p + more.p, linear.slope + more.slope};
}

}  // namespace

void PotentialPort::begin(const StageStart& start) {
  PenaltyPort::begin(start);
  h_ = start.r;
}

void PotentialPort::respond(std::span<const double> x, std::span<const double> /*v*/, ContactResponse& response) {
  const std::vector<double>& x0 = begin_->q;
  middle_.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) middle_[i] = 0.5 * (x0[i] + x[i]);
  response.rows = system_.contact.rows_at(x0, middle_, past_of(*begin_));
  const ConstraintRows& rows = *response.rows;
  response.force.assign(rows.size(), {});
  response.damper.assign(rows.size(), 0.0);
  response.status.assign(rows.size(), RowStatus::open);
  response.history.assign(begin_->contact.size(), {});
  response.stored = response.slip_work = 0.0;
  tangents_.assign(rows.size(), {});
  held_.respond(x, response);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const RowLaw& law = rows.law[r];
    if (is_equation(law)) {
      tangents_[r] = held_tangent(rows, r);
      continue;
    }
    const Vec3 w0 = rows.relative(r, x0), w1 = rows.relative(r, x), dw = subtract(w1, w0);
    const double g0 = rows.gap[r] + w0[0], g1 = rows.gap[r] + w1[0], P1 = std::max(0.0, -g1);
    if (is_bond(law)) {  // linear, so that the mean of its forces is the discrete derivative
      const Vec3 end = parted(rows, r, x);
      response.force[r] = scaled(add(parted(rows, r, x0), end), -0.5 * law.eps_N);
      response.status[r] = RowStatus::stick;
      response.stored += bond_energy(law, end);
      tangents_[r] = bond_tangent(0.5 * law.eps_N);
      continue;
    }
    response.stored += law.spring_energy(P1);
    NormalForce normal = discrete_derivative(law, g0, g1);
    const double spring = normal.p;
    if (law.damping > 0.0 && g0 < 0.0 && h_ > 0.0) {
      normal.p -= law.damping * dw[0] / h_;
      normal.slope += law.damping / h_;
      if (law.damper_acts == DamperActs::compression && normal.p <= 0.0) normal = {};
    }
    response.damper[r] = normal.p - spring;
    if (normal.p == 0.0 && spring == 0.0) continue;
    response.status[r] = RowStatus::stick;
    Vec3& force = response.force[r];
    RowTangent& D = tangents_[r];
    force[0] = normal.p;
    D[0] = normal.slope;
    if (law.eps_T == 0.0) continue;
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    const Vec3 s0 = rows.to_frame(r, begin_->contact[slot].slip);
    const double trial[2] = {law.eps_T * (s0[1] + 0.5 * dw[1]), law.eps_T * (s0[2] + 0.5 * dw[2])};
    const double size = std::hypot(trial[0], trial[1]), limit = law.mu * normal.p;
    const double keep = size > limit ? limit / size : 1.0;
    if (keep < 1.0) response.status[r] = RowStatus::slip;
    for (std::size_t i = 0; i < 2; ++i) {
      force[i + 1] = -keep * trial[i];
      for (std::size_t j = 0; j < 2; ++j) {
        const double along = keep < 1.0 ? trial[i] * trial[j] / (size * size) : 0.0;
        D[3 * (i + 1) + j + 1] = 0.5 * keep * law.eps_T * ((i == j ? 1.0 : 0.0) - along);
      }
      if (keep < 1.0) D[3 * (i + 1)] = -law.mu * D[0] * trial[i] / size;
    }
    const Vec3 s1{0.0, 2.0 * keep * trial[0] / law.eps_T - s0[1], 2.0 * keep * trial[1] / law.eps_T - s0[2]};
    // -t . (dw - ds): what of the slip is not elastic
    response.slip_work -= force[1] * (dw[1] - s1[1] + s0[1]) + force[2] * (dw[2] - s1[2] + s0[2]);
    response.stored += 0.5 * law.eps_T * (s1[1] * s1[1] + s1[2] * s1[2]);
    response.history[slot].slip = rows.to_space(r, s1);
  }
}

PortSolve PotentialPort::solve(EffectiveSolver& solver, std::span<const double> /*x*/, std::span<const double> /*v*/,
                               const ContactResponse& response, std::span<const double> residual, double absolute,
                               std::span<double> dy) {
  for (RowTangent& D : tangents_) {
    for (double& d : D) d *= s_;
  }
  return {solver.solve(residual, response.rows, tangents_, absolute, dy), {}};
}

ContactWork PotentialPort::work(const State& begin, const State& end, double /*end_weight*/) const {
  const ContactResponse& response = end.forces.rows;
  const ConstraintRows& rows = *response.rows;
  ContactWork out{.total = 0.0, .friction = response.slip_work};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] == RowStatus::open) continue;
    const Vec3 dw = subtract(rows.relative(r, end.q), rows.relative(r, begin.q));
    out.total += dot(response.force[r], dw);
    out.damping -= response.damper[r] * dw[0];
  }
  return out;
}

}  // namespace carom
