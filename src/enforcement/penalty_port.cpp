#include "enforcement/penalty_port.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "contact/row_maker.hpp"
#include "enforcement/contact_work.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "rows/bond_springs.hpp"
#include "solid/smallest_cell.hpp"

namespace carom {

PenaltyPort::PenaltyPort(const System& system) : system_(system), held_(system) {
  reach_ = 0.01 * smallest_cell(system.solid);
}

void PenaltyPort::begin(const StageStart& start) {
  begin_ = start.begin;
  free_ = start.free;
  force_parts_ = start.force_parts;
  s_ = start.s;
  dv_dx_ = start.r / start.s;
  held_.begin(start);
  slip_ = start.m == 0.0 ? CountedSlip::whole_step : CountedSlip::after_touch;
}

void PenaltyPort::respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) {
  penalty_response(system_.contact.rows_at(begin_->q, x, past_of(*begin_)), begin_->q, x, v, begin_->contact, response,
                   slip_);
  add_bond_springs(x, response);
  held_.respond(x, response);
}

double PenaltyPort::work_of(std::span<const double> rounding, std::span<const double> x) const {
  double moved = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) moved += (x[i] - begin_->q[i]) * (x[i] - begin_->q[i]);
  return std::sqrt(moved * dot(rounding, rounding));
}

/// The forces of springs are a function of the state.
ContactError PenaltyPort::error(std::span<const double> x, std::span<const double> /*v*/,
                                const ContactResponse& response) const {
  if (!held_.any()) return {};
  std::vector<double> rounding(x.size(), 0.0);
  held_.add_rounding(x, response, rounding);
  return {0.0, work_of(rounding, x)};
}

PortSolve PenaltyPort::solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                             const ContactResponse& response, std::span<const double> residual, double absolute,
                             std::span<double> dy) {
  const ConstraintRows& rows = *response.rows;
  tangents_.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    tangents_[r] = is_equation(rows.law[r]) ? held_tangent(rows, r)
                   : is_bond(rows.law[r])   ? bond_tangent(rows.law[r].eps_N)
                                            : penalty_tangent(rows, r, begin_->q, x, v, begin_->contact, dv_dx_, slip_);
    for (double& d : tangents_[r]) d *= s_;
  }
  return solve_with_tangents(solver, x, response, residual, absolute, dy);
}

void PenaltyPort::relieve(std::span<const double> x, const ContactResponse& response,
                          std::span<double> residual) const {
  if (free_ == nullptr || free_->empty() || tangents_.size() != response.rows->size()) return;
  std::vector<double> relieved(residual.begin(), residual.end());
  if (free_->are_loads(free_->relieve(*response.rows, tangents_, x, relieved), x, force_parts_)) return;
  std::copy(relieved.begin(), relieved.end(), residual.begin());
}

bool PenaltyPort::settle(std::span<const double> x, const ContactResponse& response) {
  return held_.settle(x, response);
}

PenaltyPort::ClosedSpring PenaltyPort::closed_spring(const ConstraintRows& rows, std::size_t r,
                                                     std::span<const double> x) const {
  const RowLaw& law = rows.law[r];
  const double slope = law.spring_slope(std::max(0.0, -rows.gap_at(r, x)));
  return {{s_ * slope, 0.0, 0.0, 0.0, s_ * law.eps_T, 0.0, 0.0, 0.0, s_ * law.eps_T}, -law.eps_N * rows.gap_at(r, x)};
}

/// Closes the open rows that the motion reaches first. False when it reaches none.
bool PenaltyPort::close_reached(const ConstraintRows& rows, std::span<const double> x, std::span<const double> motion) {
  std::vector<std::pair<std::size_t, double>> reached;  // rows, and how far the motion closes them
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (tangents_[r][0] != 0.0) continue;
    const double closing = -free_->relative(rows, r, motion, x)[0];
    if (!(closing > 1e-9 * norm(free_->relative(rows, r, motion, x)))) continue;
    reached.emplace_back(r, closing);
    first = std::min(first, std::max(0.0, rows.gap_at(r, x)) / closing);
  }
  for (const auto& [r, closing] : reached) {
    if (rows.gap_at(r, x) - first * closing > reach_) continue;
    const ClosedSpring spring = closed_spring(rows, r, x);
    tangents_[r] = spring.tangent;
    rows.scatter(r, {spring.force, 0.0, 0.0}, load_);
  }
  return !reached.empty();
}

/// Gives sliding rows the tangent of sticking ones. False when there are none.
bool PenaltyPort::stick_sliding(const ContactResponse& response, std::span<const double> x) {
  const ConstraintRows& rows = *response.rows;
  bool is_any = false;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (response.status[r] != RowStatus::slip) continue;
    const RowTangent stick = closed_spring(rows, r, x).tangent;
    is_any = is_any || tangents_[r] != stick;
    tangents_[r] = stick;
  }
  return is_any;
}

/// Why nothing can hold a body, "" where all are held.
std::string PenaltyPort::hold_bodies(const ContactResponse& response, std::span<const double> x,
                                     std::span<const double> residual) {
  for (;;) {
    const std::vector<double> motion = free_->unheld(*response.rows, tangents_, x, residual, force_parts_);
    if (is_zero(motion)) return {};
    if (close_reached(*response.rows, x, motion) || stick_sliding(response, x)) continue;
    return "no support and no contact holds " + free_->describe(motion) + ", where the loads push it";
  }
}

PenaltyPort::Stiffness PenaltyPort::stiffness_of(const ContactResponse& response) const {
  const ConstraintRows beside = system_.contact.stiffness_rows();
  if (beside.size() == 0) return {response.rows, tangents_};
  const auto rows = std::make_shared<ConstraintRows>(*response.rows);
  append_rows(*rows, beside);
  Stiffness out{rows, tangents_};
  for (const RowLaw& law : beside.law) out.tangents.push_back({s_ * law.eps_N, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  return out;
}

PortSolve PenaltyPort::solve_with_tangents(EffectiveSolver& solver, std::span<const double> x,
                                           const ContactResponse& response, std::span<const double> residual,
                                           double absolute, std::span<double> dy) {
  if (free_ == nullptr || free_->empty()) {
    const Stiffness stiffness = stiffness_of(response);
    return {solver.solve(residual, stiffness.rows, stiffness.tangents, absolute, dy), {}};
  }
  load_.assign(residual.begin(), residual.end());
  std::string failure = hold_bodies(response, x, residual);
  if (!failure.empty()) return {{}, std::move(failure)};
  const std::vector<bool>& fixed = system_.supports.fixed();
  for (std::size_t i = 0; i < load_.size(); ++i) {
    if (fixed[i]) load_[i] = 0.0;
  }
  const std::vector<double> weak = free_->relieve(*response.rows, tangents_, x, load_);
  const Stiffness stiffness = stiffness_of(response);  // after hold_bodies, which closes rows
  PortSolve out{solver.solve(load_, stiffness.rows, stiffness.tangents, absolute, dy), {}};
  release_held(solver, stiffness, x, response, out.linear, dy);
  free_->move_weakly(*response.rows, tangents_, x, weak, dy);
  return out;
}

/// dy becomes (A - P N P^T)^-1 of the load, N = FreeModes::needless and P the pins, from A^-1 of it (Woodbury):
///   dy + Z (1 - N P^T Z)^-1 N P^T dy,  Z = A^-1 P.
void PenaltyPort::release_held(EffectiveSolver& solver, const Stiffness& stiffness, std::span<const double> x,
                               const ContactResponse& response, LinearSolveReport& linear, std::span<double> dy) {
  const std::vector<double> N = free_->needless(*response.rows, tangents_, x);
  if (N.empty()) return;
  const std::vector<DofSpring> pins = free_->pins();
  const std::size_t d = pins.size(), n = dy.size();
  std::vector<double> Z(d * n), unit(n, 0.0), matrix(d * d, 0.0), c(d, 0.0);
  for (std::size_t k = 0; k < d; ++k) {
    unit[pins[k].dof] = 1.0;
    const LinearSolveReport one =
        solver.solve(unit, stiffness.rows, stiffness.tangents, 0.0, std::span(Z).subspan(k * n, n));
    unit[pins[k].dof] = 0.0;
    linear.converged = linear.converged && one.converged;
    linear.iterations += one.iterations;
  }
  for (std::size_t i = 0; i < d; ++i) {
    matrix[i * d + i] = 1.0;
    for (std::size_t j = 0; j < d; ++j) {
      c[i] += N[i * d + j] * dy[pins[j].dof];
      for (std::size_t k = 0; k < d; ++k) matrix[i * d + k] -= N[i * d + j] * Z[k * n + pins[j].dof];
    }
  }
  DenseLu(std::move(matrix), static_cast<int>(d)).solve(c);
  for (std::size_t k = 0; k < d; ++k)
    for (std::size_t i = 0; i < n; ++i) dy[i] += c[k] * Z[k * n + i];
}

void PenaltyPort::add_stiffness_diagonal(std::span<double> d) const {
  const std::vector<double> zero(d.size(), 0.0);
  add_closed_diagonal(*system_.contact.rows_at(zero, zero), d);
}

ContactWork PenaltyPort::work(const State& begin, const State& end, double /*end_weight*/) const {
  ContactWork out = spring_work(begin, end);
  out.total = trapezoidal_work(begin, end);
  return out;
}

/// Multipliers have settled when their update changes no node's acceleration by more than this share of the largest:
/// forces that are carried on from step to step are then right to 1 % (a bar on a wall against exact multipliers: 1.5 %
/// at 0.01). Statics, whose steps are few, goes on to where the patch test is off by 2e-6 of the pressure.
static constexpr double settled = 0.003, settled_in_statics = 1e-6;

/// Share of an update of the multipliers at which a residual is small enough for the update to be made.
static constexpr double near_equilibrium = 0.1;

AugmentedLagrangianPort::AugmentedLagrangianPort(const System& system, double penetration)
    : PenaltyPort(system), penetration_(penetration) {
  diagonal_ = system.solid.diagonal_at_rest();
}

void AugmentedLagrangianPort::begin(const StageStart& start) {
  PenaltyPort::begin(start);
  m_ = start.m;
  c_ = start.c;
  contact_ = begin_->contact;
}

/// lambda of row r, in its frame.
Vec3 AugmentedLagrangianPort::multiplier(const ConstraintRows& rows, std::size_t r) const {
  return rows.to_frame(r, contact_[static_cast<std::size_t>(rows.slot[r])].multiplier);
}

/// Factor on the springs of row r: eps_N W is about 10 at least, with W = s G diag(m M + c K)^-1 G^T: an
/// update leaves a tenth of the gap. In statics it is 100, so that two or three updates settle the multipliers.
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
  return compliance > 0.0 ? std::max(1.0, (is_static() ? 100.0 : 10.0) / (compliance * rows.law[r].eps_N)) : 1.0;
}

void AugmentedLagrangianPort::respond(std::span<const double> x, std::span<const double> /*v*/,
                                      ContactResponse& response) {
  ContactPast past = past_of(*begin_);
  past.history = contact_;
  response.rows = system_.contact.rows_at(begin_->q, x, past);
  const ConstraintRows& rows = *response.rows;
  response.force.assign(rows.size(), {});
  response.damper.assign(rows.size(), 0.0);
  response.status.assign(rows.size(), RowStatus::open);
  response.history.assign(contact_.size(), {});
  response.stored = response.slip_work = 0.0;
  tangents_.assign(rows.size(), {});
  held_.respond(x, response);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_equation(rows.law[r])) {
      tangents_[r] = held_tangent(rows, r);
      tangents_[r][0] *= s_;
      continue;
    }
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    const Vec3 lambda = multiplier(rows, r), w = rows.relative(r, x);
    const double factor = stiffening(rows, r), eps_N = factor * rows.law[r].eps_N;
    const double eps_T = factor * rows.law[r].eps_T;
    Vec3& force = response.force[r];
    RowTangent& D = tangents_[r];
    if (is_bond(rows.law[r])) {
      force = subtract(lambda, scaled(parted(rows, r, x), eps_N));
      D = bond_tangent(s_ * eps_N);
      response.status[r] = RowStatus::stick;
      response.history[slot].multiplier = rows.to_space(r, force);
      continue;
    }
    force[0] = std::max(0.0, lambda[0] - eps_N * (rows.gap[r] + w[0]));
    if (force[0] == 0.0) continue;
    D[0] = s_ * eps_N;
    response.status[r] = RowStatus::stick;
    if (rows.law[r].mu > 0.0) {
      const Vec3 w_begin = rows.relative(r, begin_->q);
      const std::array<double, 2> trial{lambda[1] - eps_T * (w[1] - w_begin[1]),
                                        lambda[2] - eps_T * (w[2] - w_begin[2])};
      const double limit = rows.law[r].mu * force[0];
      const double size = std::hypot(trial[0], trial[1]), keep = size > limit ? limit / size : 1.0;
      if (keep < 1.0) response.status[r] = RowStatus::slip;
      for (std::size_t i = 0; i < 2; ++i) {
        force[i + 1] = keep * trial[i];
        if (keep < 1.0) D[3 * (i + 1)] = s_ * rows.law[r].mu * eps_N * trial[i] / size;
        for (std::size_t j = 0; j < 2; ++j) {
          const double along = keep < 1.0 ? trial[i] * trial[j] / (size * size) : 0.0;
          D[3 * (i + 1) + j + 1] = s_ * keep * eps_T * ((i == j ? 1.0 : 0.0) - along);
        }
      }
    }
    response.history[slot].multiplier = rows.to_space(r, force);
  }
}

PortSolve AugmentedLagrangianPort::solve(EffectiveSolver& solver, std::span<const double> x,
                                         std::span<const double> /*v*/, const ContactResponse& response,
                                         std::span<const double> residual, double absolute, std::span<double> dy) {
  return solve_with_tangents(solver, x, response, residual, absolute, dy);
}

PenaltyPort::ClosedSpring AugmentedLagrangianPort::closed_spring(const ConstraintRows& rows, std::size_t r,
                                                                 std::span<const double> x) const {
  const double factor = stiffening(rows, r), eps_N = factor * rows.law[r].eps_N;
  const double eps_T = rows.law[r].mu > 0.0 ? factor * rows.law[r].eps_T : 0.0;
  const Vec3 lambda = multiplier(rows, r);
  return {{s_ * eps_N, 0.0, 0.0, 0.0, s_ * eps_T, 0.0, 0.0, 0.0, s_ * eps_T}, lambda[0] - eps_N * rows.gap_at(r, x)};
}

/// Rounding of gaps, which the stiffened springs turn into forces.
ContactError AugmentedLagrangianPort::error(std::span<const double> x, std::span<const double> /*v*/,
                                            const ContactResponse& response) const {
  const ConstraintRows& rows = *response.rows;
  std::vector<double> rounding(x.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const bool is_held = is_bond(rows.law[r]);
    if (is_equation(rows.law[r]) || (response.force[r][0] == 0.0 && !is_held)) continue;
    const double force = stiffening(rows, r) * rows.law[r].eps_N * rows.gap_rounding(r, x);
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < (is_held ? 3U : 1U); ++i)
          rounding[3 * static_cast<std::size_t>(rows.node[k]) + c] += force * std::abs(rows.block[k][i][c]);
  }
  held_.add_rounding(x, response, rounding);
  return {0.0, work_of(rounding, x)};
}

/// What an update of the multipliers would change.
AugmentedLagrangianPort::Update AugmentedLagrangianPort::update(std::span<const double> x,
                                                                const ContactResponse& response) const {
  const ConstraintRows& rows = *response.rows;
  Update out;
  std::vector<double> force(x.size(), 0.0), change(x.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_equation(rows.law[r])) continue;
    const Vec3 w = rows.relative(r, x), &now = response.force[r];
    const double gap = rows.gap[r] + w[0];
    const bool is_held = is_bond(rows.law[r]);
    const double miss = is_held ? norm(parted(rows, r, x)) : std::abs(gap);
    rows.scatter(r, now, force);
    if (miss > rows.gap_rounding(r, x)) rows.scatter(r, subtract(now, multiplier(rows, r)), change);
    if (is_held) {
      out.violation = std::max(out.violation, miss);
      continue;
    }
    out.violation = std::max(out.violation, now[0] > 0.0 ? std::abs(gap) : -gap);
    if (response.status[r] != RowStatus::stick || rows.law[r].mu == 0.0) continue;
    const Vec3 w_begin = rows.relative(r, begin_->q);
    out.violation = std::max(out.violation, std::hypot(w[1] - w_begin[1], w[2] - w_begin[2]));
  }
  double largest = 0.0, most = 0.0, squares = 0.0;
  for (std::size_t n = 0; 3 * n < x.size(); ++n) {
    const double stiffness = diagonal_[3 * n] + diagonal_[3 * n + 1] + diagonal_[3 * n + 2];
    const double resistance = m_ * system_.mass.node_diagonal()[n] + c_ * stiffness / 3.0;
    if (!(resistance > 0.0)) continue;
    const auto size = [&](const std::vector<double>& f) {
      return norm(Vec3{f[3 * n], f[3 * n + 1], f[3 * n + 2]}) / resistance;
    };
    largest = std::max(largest, size(force));
    most = std::max(most, size(change));
    // Not what leads an obstacle: residuals have no part there.
    for (std::size_t c = 0; c < 3; ++c) squares += change[3 * n + c] * change[3 * n + c];
  }
  out.is_settled = out.violation <= penetration_ && most <= (is_static() ? settled_in_statics : settled) * largest;
  out.force = std::sqrt(squares);
  return out;
}

bool AugmentedLagrangianPort::settle(std::span<const double> x, const ContactResponse& response) {
  const bool is_met = held_.settle(x, response);
  if (update(x, response).is_settled) return is_met;
  take_forces(response);
  return false;
}

bool AugmentedLagrangianPort::renew(std::span<const double> x, const ContactResponse& response, double residual) {
  const Update made = update(x, response);
  if (made.is_settled || residual > near_equilibrium * made.force) return false;
  take_forces(response);
  return true;
}

void AugmentedLagrangianPort::take_forces(const ContactResponse& response) {
  for (std::size_t i = 0; i < contact_.size(); ++i) contact_[i].multiplier = response.history[i].multiplier;
}

ContactWork AugmentedLagrangianPort::work(const State& begin, const State& end, double end_weight) const {
  return multiplier_work(begin, end, end_weight);
}

}  // namespace carom
