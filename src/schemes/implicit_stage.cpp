#include "schemes/implicit_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/types.hpp"
#include "enforcement/make_contact_port.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "schemes/initial_acceleration.hpp"
#include "solid/point_history.hpp"

namespace carom {

/// Equilibrium error of a trial state. Forces are paired with the displacement of the whole body, norm with norm: node
/// by node, a body at rest would take any force for equilibrium.
struct ImplicitStage::Residual {
  double norm = 0.0;          ///< 2-norm
  double displacement = 0.0;  ///< 2-norm of the step's displacement, and of what the residual would still add to it
  double work = 0.0;          ///< norm x displacement, at least the energy that the residual may leave unbooked
  double unbooked = 0.0;      ///< what of it the ledger would miss: residual . displacement of the step
  double round_off = 0.0;     ///< the part of `work` that rounding alone leaves
  double supplied = 0.0;      ///< work of the loads or of the internal forces on the step's displacement
  double resultant = 0.0;     ///< force on all bodies together
  double force_round_off = 0.0;
};

namespace {

PointStep point_step(const StageEquation& eq, const State& begin) {
  PointStep step = step_from(begin, eq.dt);
  step.is_static = eq.m == 0.0;
  return step;
}

constexpr const char* with_inertia = ". Lower time.step, or choose another enforcement or method of contact";
constexpr const char* without_inertia =
    ". There may be none near, as where a body snaps through or a node slips over a sharp edge: follow the motion by a "
    "scheme with inertia, or soften a contact (enforcement = \"penalty\", less stiffness)";

/// Displacements and velocities of end.a.
void follow(const StageEquation& eq, State& end) {
  parallel_each(end.a.size(), [&](std::size_t i) {
    end.q[i] = eq.x_hat[i] + eq.s * end.a[i];
    end.v[i] = eq.v_hat[i] + eq.r * end.a[i];
  });
  for (const ImposedStep& s : eq.imposed) {
    end.q[s.dof] = s.u;
    end.v[s.dof] = s.v;
  }
}

}  // namespace

ImplicitStage::ImplicitStage(const System& system, const ImplicitSettings& settings, double ratio,
                             double omega_max_squared)
    : ImplicitStage(system, settings, ratio, omega_max_squared, make_contact_port(system, settings),
                    force_of_bodies(system)) {}

ImplicitStage::ImplicitStage(const System& system, const ImplicitSettings& settings, double ratio,
                             double omega_max_squared, std::unique_ptr<ContactPort> port, StageForce force)
    : system_(system),
      max_iterations_(settings.max_iterations),
      reach_(system.contact.reach()),
      solver_(make_effective_solver(
          system, chosen_solver(system, settings.solver, settings.enforcement, ratio, omega_max_squared))),
      port_(std::move(port)),
      force_(std::move(force)) {
  residual_.resize(system.solid.dof_count());
  correction_.resize(residual_.size());
  stiffness_diagonal_ = system.solid.diagonal_at_rest();
  for (const double k : stiffness_diagonal_)
    if (k > 0.0) softest_ = std::min(softest_, k);
  force_parts_.resize(residual_.size());
  closed_diagonal_.assign(residual_.size(), 0.0);
  port_->add_stiffness_diagonal(closed_diagonal_);
  std::vector<double> body_force(residual_.size(), 0.0);
  system.solid.turning_bodies().add_force_scale(body_force);
  body_force_ = std::sqrt(dot(body_force, body_force));
}

StageForce force_of_bodies(const System& system) {
  return {[&system](const PointStep& step, State& end) { evaluate_solid(system, step, end); },
          [](std::span<const double> x) { return x; }};
}

void ImplicitStage::hold(const std::vector<DofSpring>& springs) {
  solver_->hold(springs);
  for (const DofSpring& spring : springs) stiffness_diagonal_[spring.dof] += spring.stiffness;
}

void ImplicitStage::start_memory(State& state, std::size_t place) const {
  state.stages.resize(std::max(state.stages.size(), place + 1));
  state.stages[place] = {};
  solver_->leave(state.stages[place]);
}

void ImplicitStage::start(State& state, std::size_t place) {
  Forces& forces = state.forces;
  start_memory(state, place);
  port_->begin({&state, &state.stages[place], 1.0, 0.0, 1.0, 0.0, nullptr, state.q, {}});
  port_->respond(state.q, state.v, forces.rows);
  forces.contact.clear(state.q.size());
  forces.rows.add_force(forces.contact);
}

ImplicitStage::Residual ImplicitStage::residual(const StageEquation& eq, const State& begin, State& end) {
  Forces& forces = end.forces;
  follow(eq, end);
  force_.value(point_step(eq, begin), end);
  forces.contact.clear(end.q.size());
  port_->respond(end.q, end.v, forces.rows);
  forces.rows.add_force(forces.contact);
  system_.mass.apply(end.a, forces.inertia);
  const std::vector<bool>& fixed = system_.supports.fixed();
  const std::vector<double>& mass = system_.mass.node_diagonal();
  // Squares of the residual, of the displacement, of Jacobi's estimate of what is missing, and of the forces that
  // cancel in the residual.
  double unbooked = 0.0;
  Vec3 resultant{};
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    residual_[i] =
        fixed[i] ? 0.0 : eq.known[i] - eq.k * forces.internal[i] + forces.contact[i] - eq.m * forces.inertia[i];
    unbooked += residual_[i] * (end.q[i] - begin.q[i]);
    resultant[i % 3] += residual_[i];
  }
  if (is_improved_) port_->relieve(end.q, forces.rows, residual_);
  const auto sums = parallel_sums<6>(residual_.size(), [&](std::size_t i, std::array<double, 6>& sum) {
    const double du = end.q[i] - begin.q[i];
    sum[1] += du * du;
    sum[4] += eq.known[i] * du;
    sum[5] += forces.internal[i] * du;
    if (fixed[i]) return;
    sum[0] += residual_[i] * residual_[i];
    const double slope = eq.m * mass[i / 3] + force_.factor * eq.k * eq.s * stiffness_diagonal_[i];
    const double missing = eq.s * residual_[i] / (slope > 0.0 ? slope : force_.factor * eq.k * eq.s * softest_);
    force_parts_[i] = std::abs(eq.known[i]) + std::abs(forces.internal[i]) + std::abs(forces.contact[i]) +
                      eq.m * mass[i / 3] * std::abs(end.a[i]);
    const double moved = std::abs(begin.q[i]) + std::abs(eq.x_hat[i]) + std::abs(end.q[i]);
    // Gaps of moving rows are differences of positions, those of fixed rows of displacements.
    const double placed = moved + reach_;
    const double force = force_parts_[i] + stiffness_diagonal_[i] * moved + closed_diagonal_[i] * placed;
    sum[2] += missing * missing;
    sum[3] += force * force;
  });
  const ContactError contact = port_->error(end.q, end.v, forces.rows);
  Residual out;
  out.norm = std::sqrt(sums[0]);
  out.displacement = std::sqrt(sums[1]) + std::sqrt(sums[2]);
  out.work = out.norm * out.displacement + contact.work;
  out.unbooked = std::abs(unbooked);
  out.supplied = std::max(std::abs(sums[4]), std::abs(sums[5]));
  // A displacement is known to a relative 1e-16 of its terms only, which the stiffness of a node turns into a force.
  constexpr double precision = 16.0 * std::numeric_limits<double>::epsilon();
  const double round_off = precision * std::sqrt(sums[3]) + std::numeric_limits<double>::epsilon() * body_force_;
  out.round_off = out.displacement * round_off + contact.round_off;
  out.resultant = carom::norm(resultant);
  out.force_round_off = round_off;
  return out;
}

/// Equilibrium is found when the residual's work is at most `wanted`. Below `round_off` it may be found as well, but
/// that is a bound which fine meshes and turning rigid bodies seldom come near. So a stage with a share to meet, or
/// with such bodies, goes on below it as long as an iteration halves the work. Any other stage goes on while it would
/// leave the ledger more than a third of its bound: a solve of an ill-conditioned operator may leave a residual whose
/// norm is rounding but whose work on the displacement another solve still takes away. The unbooked energy may be small
/// by chance, since its terms cancel, and a single solve may fail to help; so the stage stops when neither the unbooked
/// energy nor the work has fallen to half in two solves. before, earlier: one and two iterations ago. Work says
/// nothing of a body at rest, whose displacement is none. So the resultant of the residual (ResidualTolerance) is asked
/// for as well, as long as an iteration halves it, and once where it may be rounding.
bool ImplicitStage::is_equilibrium(const StageEquation& eq, const Residual& error, double wanted,
                                   const Residual& before, const Residual& earlier) const {
  if (error.work <= wanted) return true;
  if (error.work > error.round_off) return false;
  const bool is_strict = eq.share > 0.0 || body_force_ > 0.0;
  constexpr double third_of_bound = 30.0;  // `wanted` is a hundredth of it
  const bool is_booked = error.unbooked <= (is_strict ? wanted : third_of_bound * wanted);
  const bool stays = error.work > 0.5 * earlier.work && error.unbooked > 0.5 * earlier.unbooked;
  return (!is_strict || error.work > 0.5 * before.work) && (is_booked || stays);
}

StageReport ImplicitStage::solve(const StageEquation& eq, const State& begin, const ResidualTolerance& allowed,
                                 State& end) {
  const std::size_t n = begin.q.size();
  const StageMemory& memory = begin.stages[eq.place];
  Forces& forces = end.forces;
  forces.internal.resize(n);
  forces.inertia.resize(n);
  end.q.resize(n);
  end.v.resize(n);
  port_->begin({&begin, &memory, eq.s, eq.r, eq.m, stiffness_share(eq), eq.free, eq.x_predicted, force_parts_, eq.dt});
  solver_->begin(memory);
  is_improved_ = false;
  StageReport report;
  std::vector<RowStatus> before;
  double first = 0.0;  // norm of the residual that the iteration begins with
  const Residual none{.work = infinity, .unbooked = infinity, .resultant = infinity};
  Residual last = none, earlier = none;
  const bool is_exact =
      (system_.solid.is_linear() && system_.contact.slots() == 0) || !solver_->iterates() || !port_->is_function();
  forcing_ = ForcingTerm(is_exact);
  for (int newton = 0, outer = 0;; ++newton, ++report.iterations) {
    before.swap(forces.rows.status);
    Residual error = residual(eq, begin, end);
    if (newton > 0 && error.work > error.round_off && port_->is_function()) error = shorten(eq, begin, error, end);
    if (!std::isfinite(error.norm)) {
      report.failure = "the forces are not finite";
      return report;
    }
    if (newton == 0) first = error.norm;
    const double wanted = std::max(allowed.work, eq.share * error.supplied);
    const double tolerance = std::max(wanted, error.round_off);
    const bool is_found = is_equilibrium(eq, error, wanted, last, earlier) &&
                          (error.resultant <= allowed.resultant || error.resultant > 0.5 * last.resultant ||
                           (newton > 0 && error.resultant <= error.force_round_off));
    if (is_found && port_->settle(end.q, forces.rows)) {
      if (error.work > wanted) report.rounding = std::min(error.work, error.round_off);
      break;
    }
    if (is_found || port_->renew(end.q, forces.rows, error.norm)) {
      if (++outer > max_iterations_) {
        report.failure = fmt::format("the contact forces do not settle in {} updates of the multipliers", outer - 1);
        return report;
      }
      newton = -1;
      last = earlier = none;
      continue;
    }
    if (newton == max_iterations_) {
      report.failure = cycling_rows(before, forces) + (eq.m == 0.0 ? without_inertia : with_inertia);
      return report;
    }
    // Rows that move leave their motion out of the tangent, and turns may have inertia; a new set of acting rows is
    // another equation. Far from equilibrium points yield and let go from one iterate to the next, each time with
    // another tangent: the last differences say nothing then, and Newton's method comes near by itself.
    constexpr double near = 0.01;
    const bool is_far = history_size(system_.solid) > 0 && error.norm > near * first;
    if (newton == 0 || before != forces.rows.status || is_far) mixing_.forget();
    earlier = last;
    last = newton == 0 ? none : error;  // before the first solve, the work is of a displacement that is a guess
    // Each solve is asked for a hundredth of what is left: less would feed its own error to the mixing.
    double left = std::max(0.3 * wanted, std::min(0.3 * tolerance, 0.01 * error.work)) / error.displacement;
    if (error.resultant > allowed.resultant)
      left = std::min(left, std::max(0.3 * allowed.resultant, 0.01 * error.resultant));
    report.failure = improve(eq, begin, forcing_.next(error.norm, left), end, report);
    if (!report.failure.empty()) return report;
  }
  take_history(forces.rows, end.q, end.contact);
  if (is_improved_) leave(eq, end.stages[eq.place]);
  report.converged = true;
  return report;
}

/// Writes the stage's memory. Results that belong to another operator m M + c K than this one are dropped first.
void ImplicitStage::leave(const StageEquation& eq, StageMemory& memory) const {
  if (memory.m != eq.m || memory.c != stiffness_share(eq)) {
    memory.m = eq.m;
    memory.c = stiffness_share(eq);
    memory.solver_rows = memory.port_rows = memory.port_nodes = {};
    memory.chosen_rows.clear();
  }
  solver_->leave(memory);
  port_->leave(memory);
}

/// Cuts a step that overshoots, so that the residual along it turns round by more than `share`, to where it is
/// below that (Illinois' form of regula falsi): Newton's method alone may jump to and fro between two directions of
/// slip.
ImplicitStage::Residual ImplicitStage::shorten(const StageEquation& eq, const State& begin, Residual error,
                                               State& end) {
  constexpr double share = 0.5;
  constexpr int most = 20;
  double slope = dot(residual_, correction_), at = 1.0;
  double low = 0.0, slope_low = slope_, high = 1.0, slope_high = slope;
  for (int i = 0; i < most && slope_ > 0.0 && std::abs(slope) > share * slope_ && slope_high < 0.0; ++i) {
    const double next = low + (high - low) * slope_low / (slope_low - slope_high);
    parallel_each(end.a.size(), [&](std::size_t k) { end.a[k] += (next - at) * correction_[k]; });
    error = residual(eq, begin, end);
    slope = dot(residual_, correction_);
    const bool was_low = at == low;
    at = next;
    if (slope > 0.0) {
      if (was_low) slope_high *= 0.5;
      low = next, slope_low = slope;
    } else {
      if (!was_low) slope_low *= 0.5;
      high = next, slope_high = slope;
    }
  }
  return error;
}

/// One Newton step. Returns why there is none, "" when there is.
std::string ImplicitStage::improve(const StageEquation& eq, const State& begin, double absolute, State& end,
                                   StageReport& report) {
  is_improved_ = true;
  const PointStep step = point_step(eq, begin);
  const bool needs_inertia = eq.m == 0.0 && eq.free != nullptr && !port_->is_law();
  const double m = needs_inertia ? stiffness_share(eq) * eq.free->inertia_for_turns(end.q, step) : eq.m;
  has_more_inertia_ = m > eq.m;
  std::string failure = solver_->prepare(m, stiffness_share(eq), force_.tangent_at(end.q), step);
  if (!failure.empty()) return failure;
  const PortSolve solved = port_->solve(*solver_, end.q, end.v, end.forces.rows, residual_, absolute, correction_);
  report.linear_iterations += solved.linear.iterations;
  forcing_.solved(solved.linear.residual);
  if (!solved.failure.empty()) return solved.failure;
  if (!solved.linear.converged) {
    return fmt::format(
        "the linear solver stopped after {} iterations at a residual of {:.3g} (asked: {:.3g}){}; it ran "
        "off where {}: if nothing resists that, add a [[support]] or a [[spring]]",
        solved.linear.iterations, solved.linear.residual, absolute,
        solved.linear.is_indefinite ? ": the tangent is not positive definite, or its numbers are not finite. Shorten "
                                      "the step, or choose solver.kind = \"mumps\""
                                    : "",
        describe_motion(system_.mesh, solved.linear.worst));
  }
  if (system_.contact.is_fixed() && !has_more_inertia_)
    parallel_each(correction_.size(), [&](std::size_t i) { end.a[i] += correction_[i]; });
  else
    mixing_.advance(end.a, correction_);
  slope_ = dot(residual_, correction_);
  return {};
}

std::string ImplicitStage::cycling_rows(const std::vector<RowStatus>& before, const Forces& forces) const {
  static constexpr const char* names[] = {"open", "stick", "slip"};
  const ConstraintRows& rows = *forces.rows.rows;
  const std::vector<RowStatus>& now = forces.rows.status;
  std::string list;
  int count = 0;
  for (std::size_t r = 0; r < rows.size() && r < before.size(); ++r) {
    if (before[r] == now[r]) continue;
    if (++count > 5) continue;
    const Vec3& x = rows.position[r];
    list += fmt::format("{}row {} at ({:.4g}, {:.4g}, {:.4g}) {} -> {}", list.empty() ? "" : ", ", r, x[0], x[1], x[2],
                        names[static_cast<int>(before[r])], names[static_cast<int>(now[r])]);
  }
  if (count == 0) {
    const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    const auto worst = std::max_element(residual_.begin(), residual_.end(), smaller) - residual_.begin();
    return fmt::format(
        "no equilibrium after {} iterations, with a settled contact state; what is not balanced is greatest where {}",
        max_iterations_, describe_motion(system_.mesh, static_cast<std::size_t>(worst)));
  }
  if (count > 5) list += fmt::format(" and {} more", count - 5);
  return fmt::format("the contact state does not settle in {} iterations; these rows cycle: {}", max_iterations_, list);
}

void impose_on_stage(const StageEquation& eq, std::span<double> y) {
  for (const ImposedStep& s : eq.imposed) y[s.dof] = (s.v - eq.v_hat[s.dof]) / eq.r;
}

void start_in_equilibrium(const System& system, ImplicitStage& stage, double dt, State& state, std::size_t place) {
  start_with_supports(system, state);
  const std::vector<double> points = state.points;
  evaluate_bodies(system, start_step(dt, points, state), state);
  stage.start(state, place);
  std::vector<ImposedStep> imposed;
  imposed_steps(system.supports, state.t, state.t + dt, state.q, imposed);
  for (const ImposedStep& s : imposed) state.a[s.dof] = s.a_begin;
  MassSolver mass_solver(system);
  if (!stage.port().is_law())
    start_multipliers(system, mass_solver, dt, state);
  else
    start_equations(system, mass_solver, dt, state);
  start_accelerations(system, mass_solver, state);
}

}  // namespace carom
