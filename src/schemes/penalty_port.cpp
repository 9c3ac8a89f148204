#include "schemes/penalty_port.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/vec3.hpp"
#include "schemes/books.hpp"

namespace carom {

void PenaltyPort::begin(const StageStart& start) {
  begin_ = start.begin;
  s_ = start.s;
  dv_dx_ = start.r / start.s;
}

void PenaltyPort::respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) {
  penalty_response(system_.contact.rows_at(begin_->q, x), begin_->q, x, v, begin_->contact, response);
}

ContactError PenaltyPort::error(std::span<const double> /*x*/, std::span<const double> /*v*/,
                                const ContactResponse& /*response*/) const {
  return {};  // the forces are a function of the state
}

PortSolve PenaltyPort::solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                             const ContactResponse& response, std::span<const double> residual, double absolute,
                             std::span<double> dy) {
  const ConstraintRows& rows = *response.rows;
  tangents_.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    tangents_[r] = penalty_tangent(rows, r, begin_->q, x, v, begin_->contact, dv_dx_);
    for (double& d : tangents_[r]) d *= s_;
  }
  return {solver.solve(residual, response.rows, tangents_, absolute, dy), {}};
}

bool PenaltyPort::settle(std::span<const double> /*x*/, const ContactResponse& /*response*/) {
  return true;
}

void PenaltyPort::add_stiffness_diagonal(std::span<double> d) const {
  const std::vector<double> zero(d.size(), 0.0);
  add_closed_diagonal(*system_.contact.rows_at(zero, zero), d);
}

ContactWork PenaltyPort::work(const State& begin, const Forces& f0, const State& end, const Forces& f1,
                              double /*end_weight*/) const {
  ContactWork out{.total = trapezoidal_work(begin, f0.contact, end, f1.contact), .friction = f1.rows.slip_work};
  out.damping = damping_work(begin, f0, end, f1);
  return out;
}

/// Tangential springs are stiffened less: with stiff ones Newton's method jumps between opposite directions of slip.
static constexpr double tangential_share = 0.1;

AugmentedLagrangianPort::AugmentedLagrangianPort(const System& system, double penetration)
    : PenaltyPort(system), penetration_(penetration) {
  diagonal_ = system.solid.tangent_diagonal(std::vector<double>(system.solid.dof_count(), 0.0));
}

void AugmentedLagrangianPort::begin(const StageStart& start) {
  PenaltyPort::begin(start);
  m_ = start.m;
  c_ = start.c;
  multiplier_.resize(begin_->contact.size());
  for (std::size_t i = 0; i < multiplier_.size(); ++i) multiplier_[i] = begin_->contact[i].multiplier;
}

/// Factor on the springs of row r: eps_N W is about 10 at least, with W = s G diag(m M + c K)^-1 G^T.
double AugmentedLagrangianPort::stiffening(const ConstraintRows& rows, std::size_t r) const {
  double compliance = 0.0;
  for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
    const auto n = static_cast<std::size_t>(rows.node[k]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * n + c;
      if (system_.supports.fixed()[i]) continue;
      const double b = rows.block[k][0][c];
      compliance += s_ * b * b / (m_ * system_.mass.node_diagonal()[n] + c_ * diagonal_[i]);
    }
  }
  return compliance > 0.0 ? std::max(1.0, 10.0 / (compliance * rows.law[r].eps_N)) : 1.0;
}

void AugmentedLagrangianPort::respond(std::span<const double> x, std::span<const double> /*v*/,
                                      ContactResponse& response) {
  response.rows = system_.contact.rows_at(begin_->q, x);
  const ConstraintRows& rows = *response.rows;
  response.force.assign(rows.size(), {});
  response.damper.assign(rows.size(), 0.0);
  response.status.assign(rows.size(), RowStatus::open);
  response.history.assign(multiplier_.size(), {});
  response.stored = response.slip_work = 0.0;
  tangents_.assign(rows.size(), {});
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    const Vec3 lambda = rows.to_frame(r, multiplier_[slot]), w = rows.relative(r, x);
    const double factor = stiffening(rows, r), eps_N = factor * rows.law[r].eps_N;
    const double eps_T = std::max(1.0, tangential_share * factor) * rows.law[r].eps_T;
    Vec3& force = response.force[r];
    RowTangent& D = tangents_[r];
    force[0] = std::max(0.0, lambda[0] - eps_N * (rows.gap[r] + w[0]));
    // Friction keeps its limit until the multipliers change, on rows that open as well: its force must not jump.
    const double limit = rows.law[r].mu * std::max(0.0, lambda[0]);
    if (force[0] == 0.0 && limit == 0.0) continue;
    if (force[0] > 0.0) D[0] = s_ * eps_N;
    response.status[r] = RowStatus::stick;
    if (rows.law[r].mu > 0.0) {
      const Vec3 w_begin = rows.relative(r, begin_->q);
      const std::array<double, 2> trial{lambda[1] - eps_T * (w[1] - w_begin[1]),
                                        lambda[2] - eps_T * (w[2] - w_begin[2])};
      const double size = std::hypot(trial[0], trial[1]), keep = size > limit ? limit / size : 1.0;
      if (keep < 1.0) response.status[r] = RowStatus::slip;
      for (std::size_t i = 0; i < 2; ++i) {
        force[i + 1] = keep * trial[i];
        for (std::size_t j = 0; j < 2; ++j) {
          const double along = keep < 1.0 ? trial[i] * trial[j] / (size * size) : 0.0;
          D[3 * (i + 1) + j + 1] = s_ * keep * eps_T * ((i == j ? 1.0 : 0.0) - along);
        }
      }
    }
    response.history[slot].multiplier = rows.to_space(r, force);
  }
}

PortSolve AugmentedLagrangianPort::solve(EffectiveSolver& solver, std::span<const double> /*x*/,
                                         std::span<const double> /*v*/, const ContactResponse& response,
                                         std::span<const double> residual, double absolute, std::span<double> dy) {
  return {solver.solve(residual, response.rows, tangents_, absolute, dy), {}};
}

bool AugmentedLagrangianPort::settle(std::span<const double> x, const ContactResponse& response) {
  const ConstraintRows& rows = *response.rows;
  double worst = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3 w = rows.relative(r, x);
    const double gap = rows.gap[r] + w[0];
    if (response.force[r][0] == 0.0 && response.status[r] != RowStatus::open) {
      worst = std::numeric_limits<double>::infinity();
    }
    worst = std::max(worst, response.force[r][0] > 0.0 ? std::abs(gap) : -gap);
    if (response.status[r] != RowStatus::stick || rows.law[r].mu == 0.0) continue;
    const Vec3 w_begin = rows.relative(r, begin_->q);
    worst = std::max(worst, std::hypot(w[1] - w_begin[1], w[2] - w_begin[2]));
  }
  if (worst <= penetration_) return true;
  for (std::size_t i = 0; i < multiplier_.size(); ++i) multiplier_[i] = response.history[i].multiplier;
  return false;
}

ContactWork AugmentedLagrangianPort::work(const State& begin, const Forces& f0, const State& end, const Forces& f1,
                                          double end_weight) const {
  return multiplier_work(begin, f0, end, f1, end_weight);
}

ContactWork multiplier_work(const State& begin, const Forces& f0, const State& end, const Forces& f1,
                            double end_weight) {
  ContactWork out;
  const auto add = [&](const ContactResponse& response, double weight) {
    const ConstraintRows& rows = *response.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (response.status[r] == RowStatus::open) continue;
      const Vec3 dw = subtract(rows.relative(r, end.q), rows.relative(r, begin.q));
      const Vec3& force = response.force[r];
      out.impact -= weight * force[0] * dw[0];
      out.friction -= weight * (force[1] * dw[1] + force[2] * dw[2]);
    }
  };
  if (end_weight < 1.0) add(f0.rows, 1.0 - end_weight);
  add(f1.rows, end_weight);
  out.total = -out.impact - out.friction;
  return out;
}

}  // namespace carom
