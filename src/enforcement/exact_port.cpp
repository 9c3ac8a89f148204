#include "enforcement/exact_port.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "enforcement/contact_work.hpp"
#include "enforcement/make_port_compliance.hpp"
#include "enforcement/stopped_rows.hpp"
#include "linalg/dense.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

constexpr const char* no_compliance = "the linear solver does not find the compliance of the rows in contact";
/// The largest relative error of forces whose rows still have to turn. In the first solves rows turn by some
/// thousandths. An error of a tenth of that saves half of the factorisations that a solve to round-off costs, and an
/// error a thousand times below the last turn is below the next one.
constexpr double most_loose = 1e-4;
constexpr double precision = 16.0 * std::numeric_limits<double>::epsilon();

double largest(std::span<const double> x) {
  double m = 0.0;
  for (const double entry : x) m = std::max(m, std::abs(entry));
  return m;
}

}  // namespace

ExactPort::ExactPort(const System& system)
    : system_(system), extent_(system.contact.reach()), compliance_(make_port_compliance(system)) {}

void ExactPort::begin(const StageStart& start) {
  start_ = start;
  is_solved_ = false;
  factors_ = {};
  const std::vector<RowHistory>& history = start.begin->contact;
  multiplier_.resize(history.size());
  compliance_of_.assign(history.size(), 0.0);
  for (std::size_t i = 0; i < history.size(); ++i) multiplier_[i] = history[i].multiplier;
}

void ExactPort::respond(std::span<const double> x, std::span<const double> /*v*/, ContactResponse& response) {
  response.rows = rows_at(x);
  const ConstraintRows& rows = *response.rows;
  response.force.resize(rows.size());
  response.status.resize(rows.size());
  response.damper.assign(rows.size(), 0.0);
  response.history.assign(multiplier_.size(), {});
  response.stored = response.slip_work = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto slot = static_cast<std::size_t>(rows.slot[r]);
    Vec3 force = rows.to_frame(r, multiplier_[slot]);
    const Admissible set = admitted(rows.law[r]);
    if (set.components() == 1) force[1] = force[2] = 0.0;
    response.status[r] = set.status(force);
    if (response.status[r] == RowStatus::open) force = {};
    response.force[r] = force;
    response.history[slot].multiplier = rows.to_space(r, force);
  }
}

bool ExactPort::settle(std::span<const double> /*x*/, const ContactResponse& /*response*/) {
  return true;
}

void ExactPort::add_stiffness_diagonal(std::span<double> /*d*/) const {}

ContactWork ExactPort::work(const State& begin, const State& end, double end_weight) const {
  return multiplier_work(begin, end, end_weight);
}

void ExactPort::leave(StageMemory& memory) const {
  if (is_solved_) compliance_->leave(memory, chosen_);
}

/// moved_ = z + slope dy; adds to chosen_ the rows that this violates. Returns true when there are such rows.
bool ExactPort::choose(const ConstraintRows& rows, std::span<const double> z, std::span<const double> dy) {
  moved_.resize(z.size());
  parallel_each(z.size(), [&](std::size_t i) { moved_[i] = z[i] + slope() * dy[i]; });
  const double round_off = precision * (extent_ + largest(moved_));
  bool is_violated = false;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double tolerance = round_off + precision * std::abs(rows.gap[r]);
    if (!may_act(r) || !admitted(rows.law[r]).violates(value(rows, r, moved_), tolerance)) continue;
    is_violated = true;
    add(r);
  }
  return is_violated;
}

void ExactPort::add(std::size_t r) {
  if (is_chosen_[r]) return;
  is_chosen_[r] = true;
  chosen_.push_back(r);
}

/// Makes W for the chosen rows. Returns false when the operator cannot be inverted.
bool ExactPort::assemble(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& shared,
                         LinearSolveReport& linear) {
  const ConstraintRows& rows = *shared;
  std::vector<std::size_t> acting, counts;
  std::copy_if(chosen_.begin(), chosen_.end(), std::back_inserter(acting), [&](std::size_t r) { return may_act(r); });
  if (W_.rows == acting) return true;
  for (const std::size_t r : acting) counts.push_back(admitted(rows.law[r]).components());
  Delassus::admit_dense(acting.size(), std::ranges::any_of(counts, [](std::size_t count) { return count > 1; }));
  LinearSolveReport columns{true};
  W_ = compliance_->make(rows, acting, counts, inverse(solver, columns));
  linear.iterations += columns.iterations;
  add_direct_compliance(shared, acting, counts, W_);
  for (const std::size_t r : acting) W_.names.push_back(static_cast<std::size_t>(rows.slot[r]));
  if (columns.converged) return true;
  W_ = {};
  compliance_->forget();
  return false;
}

/// For the error of the forces: what each row answers to its own.
void ExactPort::note_compliances(const ConstraintRows& rows) {
  for (std::size_t i = 0; i < W_.size(); ++i) {
    const FrameBlock d = W_.block_at(W_.own_entry(i));
    compliance_of_[static_cast<std::size_t>(rows.slot[W_.rows[i]])] = slope() * std::max({d[0], d[4], d[8]});
  }
}

/// Forces of the rows of W, moved_ being z with those of the response. Returns why there are none, "" when there are.
std::string ExactPort::solve_rows(const ContactResponse& response) {
  const ConstraintRows& rows = *response.rows;
  const std::size_t n = W_.size();
  std::vector<Vec3> b(n), present(n);
  std::vector<Admissible> sets(n);
  for (std::size_t i = 0; i < n; ++i) present[i] = response.force[W_.rows[i]];
  W_.apply(present, b);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t r = W_.rows[i];
    sets[i] = admitted(rows.law[r]);
    b[i] = subtract(scaled(value(rows, r, moved_), 1.0 / slope()), b[i]);
    if (sets[i].components() == 1) b[i][1] = b[i][2] = 0.0;
  }
  force_.insert(force_.end(), present.begin() + static_cast<std::ptrdiff_t>(force_.size()), present.end());
  // Forces that miss their cone by 1e-10 are in equilibrium all the same. Where rows move, error() measures by how much
  // they miss, against 1e-12 of the energy shared out over the run: there they are wanted to round-off. And where
  // contact alone holds a body, b is that of the body on its springs, far more than the motion that is looked for.
  constexpr double accepted = 1e-10;
  const bool is_held = start_.free == nullptr || start_.free->empty();
  const bool has_tangents = std::ranges::any_of(sets, [](const Admissible& set) { return set.components() > 1; });
  const bool has_bonds = std::ranges::any_of(sets, [](const Admissible& set) { return set.is_bond(); });
  const bool is_fixed = system_.contact.is_fixed() && !has_bonds;  // what bonds miss would add up from step to step
  const double wanted = !is_held ? (has_tangents ? 1e-14 : 1e-16) : is_fixed ? accepted : 1e-15;
  // Rows that are not followed are solved for once.
  const double enough = compliance_->knows_nodes() ? looseness_ : 0.0;
  const ConeResult result =
      solve_cone(W_, b, sets, force_, std::max(wanted, enough), std::max(accepted, enough), 0.0, &factors_);
  if (result.converged && !is_held && !has_tangents && !has_bonds) refine(rows, present);
  if (result.converged) return {};
  if (std::isinf(result.error))
    return "a body gives way against its contact forces (its tangent is indefinite on the rows in contact, or its "
           "forces are not finite); take smaller steps, or penalty";
  return fmt::format("the forces of {} rows in contact are not found in {} iterations: error {:.3g}", n,
                     result.iterations, result.error);
}

/// Normal forces of bodies that contact alone holds are known to the rounding of b, the motion of these on their weak
/// springs: 1e-12 of the forces where W has soft motions, which then change at each Newton step by as much. What they
/// have changed since `present` moves the rows by no more than is looked for, so that what is missing there is exact.
void ExactPort::refine(const ConstraintRows& rows, std::span<const Vec3> present) {
  constexpr std::size_t most = 2000;
  constexpr double for_redundant = 1e-6;  // of the diagonal: less than what a soft motion has of it
  std::vector<Vec3> change(force_.size()), w(force_.size());
  for (std::size_t i = 0; i < change.size(); ++i) change[i] = subtract(force_[i], present[i]);
  W_.apply(change, w);
  std::vector<std::size_t> pressing, place(force_.size(), force_.size());
  std::vector<double> missing;
  for (std::size_t i = 0; i < force_.size(); ++i) {
    if (!(force_[i][0] > 0.0)) continue;
    place[i] = pressing.size();
    pressing.push_back(i);
    missing.push_back(-w[i][0] - value(rows, W_.rows[i], moved_)[0] / slope());
  }
  const std::size_t n = pressing.size();
  if (n == 0 || n > most) return;
  std::vector<double> A(n * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    W_.each(pressing[k], [&](std::size_t j, std::size_t entry) {
      if (place[j] < n) A[k * n + place[j]] = W_.normal_at(entry) * (j == pressing[k] ? 1.0 + for_redundant : 1.0);
    });
  }
  DenseLu(std::move(A), static_cast<int>(n)).solve(missing);
  for (std::size_t k = 0; k < n; ++k) force_[pressing[k]][0] = std::max(0.0, force_[pressing[k]][0] + missing[k]);
}

/// What W was made for last is forgotten where the operator or the rows may have changed. False when the operator
/// cannot be inverted.
bool ExactPort::forget_stale(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& rows) {
  use_rows(solver, rows);
  if (!is_solved_ && go_on_directly()) W_ = {};
  const bool is_good = is_solved_ || go_on(solver);
  for (const std::size_t r : chosen_) is_chosen_[r] = true;
  return is_good;
}

/// W and what has been chosen are forgotten where they are those of another operator or of other rows.
void ExactPort::use_rows(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& rows) {
  if (!compliance_->use(rows, solver.operators_made())) {
    chosen_.clear();
    W_ = {};
  }
  is_chosen_.assign(rows->size(), false);
}

/// Brings what is kept to where the state at the beginning of the stage has it.
bool ExactPort::go_on(EffectiveSolver& solver) {
  static const StageMemory none;
  const bool is_same = start_.memory->m == start_.m && start_.memory->c == start_.c;
  LinearSolveReport anew{true};  // what is made anew has been counted before
  if (compliance_->go_on(is_same ? *start_.memory : none, chosen_, inverse(solver, anew))) W_ = {};
  return anew.converged;
}

/// A^-1 on the free dofs.
InverseOperator ExactPort::inverse(EffectiveSolver& solver, LinearSolveReport& linear) const {
  const auto solve = [this, &solver, &linear](std::span<double> b, int columns) {
    const std::vector<bool>& fixed = system_.supports.fixed();
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (fixed[i % fixed.size()]) b[i] = 0.0;
    }
    const LinearSolveReport report = solver.invert(b, columns);
    linear.converged = linear.converged && report.converged;
    linear.iterations += report.iterations;
  };
  return {solve, solver.halves()};
}

PortSolve ExactPort::solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                           const ContactResponse& response, std::span<const double> residual, double absolute,
                           std::span<double> dy) {
  const std::span<const double> z = seen(x, v);
  if (!forget_stale(solver, response.rows)) return {{}, no_compliance};
  is_solved_ = true;
  free_.resize(dy.size());
  PortSolve out{solver.solve(residual, response.rows, {}, absolute, free_), {}};
  std::copy(free_.begin(), free_.end(), dy.begin());
  load_.assign(dy.size(), 0.0);
  force_.clear();
  see_all(response);
  const bool acts = take_acting(response, z);
  if (!out.linear.converged || !acts) return out;
  const ContactResponse* at = &response;
  for (bool is_done = false; !is_done;) {
    looseness_ = rows_follow() ? most_loose : 0.0;
    out.failure = solve_surface(solver, *at, z, residual, absolute, out.linear, dy);
    if (!out.failure.empty()) return out;
    if (!compliance_->knows_nodes()) break;
    if (rows_follow()) at = follow_rows(solver, *at, z, residual, absolute, out.linear, dy, out.failure);
    if (!out.failure.empty()) return out;
    add_forces(solver, *at, residual, absolute, out.linear, dy);
    const std::size_t before = chosen_.size();
    choose(*at->rows, z, dy);  // rows whose nodes were not known to move
    is_done = chosen_.size() == before;
  }
  return out;
}

/// Adds to chosen_ the rows that act or that free_ and load_ violate. False when there are none.
bool ExactPort::take_acting(const ContactResponse& response, std::span<const double> z) {
  for (std::size_t r = 0; r < response.status.size(); ++r) {
    if (response.status[r] != RowStatus::open) add(r);
  }
  const bool is_violated = choose(*response.rows, z, free_);
  return is_violated ||
         std::any_of(response.status.begin(), response.status.end(), [](RowStatus s) { return s != RowStatus::open; });
}

/// The forces of the chosen rows and of those that these push others into, and dy: where the compliance of the nodes is
/// known, on those.
std::string ExactPort::solve_surface(EffectiveSolver& solver, const ContactResponse& response,
                                     std::span<const double> z, std::span<const double> residual, double absolute,
                                     LinearSolveReport& linear, std::span<double> dy) {
  const ConstraintRows& rows = *response.rows;
  const std::vector<double> before = load_;
  for (std::size_t known = 0; known != chosen_.size();) {
    known = chosen_.size();
    load_ = before;
    if (!assemble(solver, response.rows, linear)) return no_compliance;
    note_compliances(rows);
    move_surface(dy);
    choose(rows, z, compliance_->knows_nodes() ? dy : free_);
    std::string failure = solve_rows(response);
    if (!failure.empty()) return failure;
    for (std::size_t i = 0; i < force_.size(); ++i)
      rows.scatter(W_.rows[i], subtract(force_[i], response.force[W_.rows[i]]), load_);
    if (compliance_->knows_nodes())
      move_surface(dy);
    else
      add_forces(solver, response, residual, absolute, linear, dy);
    see_forces(rows, W_.rows, force_);
    choose(rows, z, dy);  // what the forces push other rows into
    see_all(response);
  }
  for (std::size_t i = 0; i < force_.size(); ++i)
    multiplier_[static_cast<std::size_t>(rows.slot[W_.rows[i]])] = rows.to_space(W_.rows[i], force_[i]);
  return {};
}

/// Rows move with their nodes. What that changes is found on the nodes of the contact alone, whose compliance is known,
/// until the forces are in balance within `absolute`. While they keep their nodes, W stays: it changes by as little as
/// the rows do, and the motions are those of the rows as they are. Returns the response on the rows of the last forces.
const ContactResponse* ExactPort::follow_rows(EffectiveSolver& solver, const ContactResponse& response,
                                              std::span<const double> z, std::span<const double> residual,
                                              double absolute, LinearSolveReport& linear, std::span<double> dy,
                                              std::string& failure) {
  constexpr int most = 5;
  const ContactResponse* last = &response;
  std::vector<double> base(z.size(), 0.0), turn;
  response.add_force(base);
  double before = infinity;
  for (int n = 0; n < most; ++n) {
    ContactResponse& next = followed_[last == &followed_[0] ? 1 : 0];  // `response` may be one of them
    moved_.resize(z.size());
    parallel_each(z.size(), [&](std::size_t i) { moved_[i] = z[i] + slope() * dy[i]; });
    respond(moved_, {}, next);
    // What the turn of the rows has changed.
    turn.assign(z.size(), 0.0);
    next.add_force(turn);
    const std::vector<bool>& fixed = system_.supports.fixed();
    for (std::size_t i = 0; i < turn.size(); ++i) turn[i] = fixed[i] ? 0.0 : turn[i] - base[i] - load_[i];
    const double change = std::sqrt(dot(turn, turn));
    const bool is_last = change <= absolute || !(change < 0.1 * before) || n + 1 == most;
    if (is_last && looseness_ == 0.0) break;
    looseness_ = is_last ? 0.0 : std::min(most_loose, 1e-3 * change / std::sqrt(dot(load_, load_)));
    before = change;
    parallel_each(load_.size(), [&](std::size_t i) { load_[i] += turn[i]; });
    if (next.rows->node != last->rows->node || next.rows->slot != last->rows->slot) use_rows(solver, next.rows);
    force_.clear();
    move_surface(dy);
    for (std::size_t r = 0; r < next.status.size(); ++r) {
      if (next.status[r] != RowStatus::open) add(r);
    }
    choose(*next.rows, z, dy);
    failure = solve_surface(solver, next, z, residual, absolute, linear, dy);
    last = &next;
    if (!failure.empty() || !compliance_->knows_nodes()) break;
  }
  return last;
}

/// dy = free_, and on the nodes of the contact A^-1 load_ too.
void ExactPort::move_surface(std::span<double> dy) {
  std::copy(free_.begin(), free_.end(), dy.begin());
  if (compliance_->knows_nodes()) compliance_->add_node_motion(load_, dy);
}

void ExactPort::see_all(const ContactResponse& response) {
  std::vector<std::size_t> all(response.rows->size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  see_forces(*response.rows, all, response.force);
}

/// dy = free_ + A^-1 load_.
void ExactPort::add_forces(EffectiveSolver& solver, const ContactResponse& response, std::span<const double> residual,
                           double absolute, LinearSolveReport& linear, std::span<double> dy) {
  if (compliance_->knows_columns()) {
    std::vector<Vec3> change(force_.size());
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = subtract(force_[i], response.force[W_.rows[i]]);
    std::copy(free_.begin(), free_.end(), dy.begin());
    compliance_->add_columns(W_.rows, change, dy);
    return;
  }
  const std::vector<bool>& fixed = system_.supports.fixed();
  std::vector<double> sum(load_.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = fixed[i] ? 0.0 : residual[i] + load_[i];
  const LinearSolveReport report = solver.solve(sum, response.rows, {}, absolute, dy);
  linear.converged = linear.converged && report.converged;
  linear.iterations += report.iterations;
}

ContactError MultiplierPort::error(std::span<const double> x, std::span<const double> /*v*/,
                                   const ContactResponse& response) const {
  const ConstraintRows& rows = *response.rows;
  ContactError out;
  if (rows.size() == 0) return out;
  if (!is_solved_) return {std::numeric_limits<double>::infinity(), 0.0};
  const bool is_held = start_.free == nullptr || start_.free->empty();
  if (system_.contact.is_fixed() && is_held) return out;
  const double reach = precision * (extent_ + largest(x) + largest(start_.begin->q));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3 w = value(rows, r, x), force = response.force[r];
    const double length = precision * std::abs(rows.gap[r]) + reach;
    const double compliance = compliance_of_[static_cast<std::size_t>(rows.slot[r])];
    if (compliance == 0.0) {
      if (admitted(rows.law[r]).violates(w, length) || force[0] > 0.0)
        return {std::numeric_limits<double>::infinity(), 0.0};
      continue;
    }
    // The forces that projection on the cone makes of these: lambda itself where the conditions hold.
    const Vec3 projected = admitted(rows.law[r]).project(subtract(force, scaled(w, 1.0 / compliance)));
    const double miss = norm(subtract(force, projected)), scale = norm(force) + norm(projected);
    out.work += scale * miss * compliance;
    out.round_off += scale * length;
  }
  return out;
}

std::shared_ptr<const ConstraintRows> MultiplierPort::rows_at(std::span<const double> x) const {
  return system_.contact.rows_at(start_.begin->q, x, past_of(*start_.begin));
}

Vec3 MultiplierPort::value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const {
  const Admissible set = admitted(rows.law[r]);
  if (set.is_bond()) return parted(rows, r, z);
  const Vec3 w = rows.relative(r, z);
  if (set.components() == 1) return {rows.gap[r] + w[0], 0.0, 0.0};
  const Vec3 w_begin = rows.relative(r, start_.begin->q);
  return {rows.gap[r] + w[0], w[1] - w_begin[1], w[2] - w_begin[2]};
}

void ProjectionPort::begin(const StageStart& start) {
  MultiplierPort::begin(start);
  for (const Index slot : system_.contact.bonds().slot) multiplier_[static_cast<std::size_t>(slot)] = {};
}

void ImpulsePort::begin(const StageStart& start) {
  ExactPort::begin(start);
  rows_ = system_.contact.rows_at(start.begin->q, start.x_predicted, past_of(*start.begin));
  may_act_.resize(rows_->size());
  approach_.assign(rows_->size(), 0.0);
  for (std::size_t r = 0; r < rows_->size(); ++r) {
    may_act_[r] = is_bond(rows_->law[r]) || rows_->is_closed(r, start.x_predicted, system_.contact.extent());
    if (!may_act_[r] && is_stopped_before(system_.contact, rows_->law[r])) {
      may_act_[r] = true;
      approach_[r] = rows_->gap_at(r, start.x_predicted) / start.dt;
    }
    if (!may_act_[r]) multiplier_[static_cast<std::size_t>(rows_->slot[r])] = {};
  }
}

ContactError ImpulsePort::error(std::span<const double> /*x*/, std::span<const double> /*v*/,
                                const ContactResponse& /*response*/) const {
  return {is_solved_ || rows_->size() == 0 ? 0.0 : std::numeric_limits<double>::infinity(), 0.0};
}

std::shared_ptr<const ConstraintRows> ImpulsePort::rows_at(std::span<const double> /*x*/) const {
  return rows_;
}

Vec3 ImpulsePort::value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const {
  Vec3 w = rows.relative(r, z);
  if (is_bond(rows.law[r])) return w;
  w[0] += approach_[r] + rows.law[r].restitution * std::min(0.0, rows.relative(r, start_.begin->v)[0]);
  return w;
}

}  // namespace carom
