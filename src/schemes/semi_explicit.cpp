#include "schemes/semi_explicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "enforcement/explicit_contact.hpp"
#include "enforcement/node_compliance.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "schemes/books.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/initial_acceleration.hpp"
#include "schemes/scheme_table.hpp"
#include "solid/point_history.hpp"

namespace carom {

namespace {

/// Iterations in which rows follow the nodes. A node that comes to the edge between two facets may see the one from the
/// other's equilibrium and back without end; what is left of the gaps then is of the order of the change between the
/// last two, far below the motion of the step, and the next step sees it.
constexpr int most_row_updates = 12;

}  // namespace

/// The dofs b: those without mass that are not imposed and that their cells hold.
struct SemiExplicit::Boundary {
  explicit Boundary(const System& given) : system(given), of_dof(given.solid.dof_count(), -1), force(of_dof.size()) {
    const std::vector<double>& stiffness = system.solid.diagonal_at_rest();
    for (std::size_t i = 0; i < of_dof.size(); ++i) {
      if (system.mass.node_diagonal()[i / 3] > 0.0 || system.supports.is_prescribed(static_cast<Index>(i))) continue;
      if (stiffness[i] == 0.0) continue;
      of_dof[i] = static_cast<Index>(dofs.size());
      dofs.push_back(i);
    }
    for (std::size_t k = 0; k < system.solid.cells().size(); ++k) {
      const auto nodes = system.solid.cells().nodes_of(k);
      const bool touches = std::any_of(nodes.begin(), nodes.end(), [this](Index n) {
        const std::size_t i = 3 * static_cast<std::size_t>(n);
        return of_dof[i] >= 0 || of_dof[i + 1] >= 0 || of_dof[i + 2] >= 0;
      });
      if (touches) cells.push_back(static_cast<Index>(k));
    }
    contact_operator.inverse = [this](std::span<double> b) { invert(b, 1); };
    contact_operator.delassus = [this](const ConstraintRows& rows, const std::vector<std::size_t>& chosen) {
      return delassus(rows, chosen);
    };
  }

  /// Brings what is kept to where the memory has it; rows: those of any displacement, where they are fixed. Throws as
  /// factorise does.
  void go_on(const ModifiedMassMemory& memory, const ConstraintRows* rows) {
    const bool is_same =
        memory.factored_at == factored_at || (memory.factored_at && factored_at && *memory.factored_at == *factored_at);
    if (!is_same) factorise(memory.factored_at->u, {memory.factored_at->dt, memory.factored_at->points});
    of_nodes.grow_as(memory.nodes, of_dof.size(), {[this](std::span<double> b, int columns) { invert(b, columns); }});
    if (rows != nullptr && !std::ranges::equal(memory.rows, W.rows)) {
      W = memory.rows.empty() ? Delassus{} : make(*rows, {memory.rows.begin(), memory.rows.end()});
    }
  }
  ModifiedMassMemory memory() const { return {factored_at, {W.rows.begin(), W.rows.end()}, of_nodes.growth()}; }

  /// Factors K_bb at displacement u, the end of the step. Throws std::runtime_error when it is not positive definite.
  void factorise(std::span<const double> u, const PointStep& step) {
    W = {};
    of_nodes.forget();
    factored_at = {};
    if (!system.solid.is_linear())
      factored_at = std::make_shared<const TangentPlace>(
          TangentPlace{step.dt, {u.begin(), u.end()}, {step.history.begin(), step.history.end()}});
    if (dofs.empty()) return;
    const CsrMatrix K = system.solid.tangent(u, step);
    CsrMatrix K_bb;
    K_bb.size = static_cast<Index>(dofs.size());
    K_bb.row_begin.push_back(0);
    for (const std::size_t i : dofs) {
      for (auto k = static_cast<std::size_t>(K.row_begin[i]); k < static_cast<std::size_t>(K.row_begin[i + 1]); ++k) {
        const Index j = of_dof[static_cast<std::size_t>(K.column[k])];
        if (j < 0) continue;
        K_bb.column.push_back(j);
        K_bb.value.push_back(K.value[k]);
      }
      K_bb.row_begin.push_back(static_cast<std::int64_t>(K_bb.column.size()));
    }
    factor.emplace(K_bb);
  }

  /// b = K_bb^-1 b on the dofs b, zero elsewhere.
  void invert(std::span<double> b, int columns) const {
    const std::size_t n = of_dof.size(), m = dofs.size(), count = static_cast<std::size_t>(columns);
    std::vector<double> x(m * count);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < m; ++i) x[k * m + i] = b[k * n + dofs[i]];
    }
    if (m > 0) factor->solve(x, columns);
    std::fill(b.begin(), b.end(), 0.0);
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < m; ++i) b[k * n + dofs[i]] = x[k * m + i];
    }
  }

  /// W on rows that move: linear bodies keep the compliance of their nodes, so that new rows cost no solve.
  Delassus moving(const ConstraintRows& rows, std::vector<std::size_t> chosen) {
    const InverseOperator inverse{[this](std::span<double> b, int columns) { invert(b, columns); }};
    if (!system.solid.is_linear() || !of_nodes.extend(rows, chosen, of_dof.size(), inverse))
      return make_delassus(rows, std::move(chosen), of_dof.size(), inverse);
    std::vector<std::size_t> components;
    for (const std::size_t r : chosen) components.push_back(carom::components(rows.law[r]));
    return of_nodes.compliance(rows, chosen, components);
  }

  /// W on the chosen rows. Where rows are fixed it is kept, and grows by a quarter at least, with the rows next to
  /// closing, so that a contact that spreads does not make it anew at every step.
  Delassus delassus(const ConstraintRows& rows, std::vector<std::size_t> chosen) {
    if (!system.contact.is_fixed()) return moving(rows, std::move(chosen));
    std::vector<std::size_t> set;
    std::set_union(chosen.begin(), chosen.end(), W.rows.begin(), W.rows.end(), std::back_inserter(set));
    if (set.size() == W.size()) return W;
    std::vector<std::size_t> others;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (!std::binary_search(set.begin(), set.end(), r)) others.push_back(r);
    }
    const std::size_t wanted = std::min(W.size() + W.size() / 4, rows.size());
    if (set.size() < wanted) {
      const auto last = others.begin() + static_cast<std::ptrdiff_t>(wanted - set.size());
      std::partial_sort(others.begin(), last, others.end(),
                        [&](std::size_t a, std::size_t b) { return closing[a].w[0] < closing[b].w[0]; });
      set.insert(set.end(), others.begin(), last);
      std::sort(set.begin(), set.end());
    }
    W = make(rows, std::move(set));
    return W;
  }
  Delassus make(const ConstraintRows& rows, std::vector<std::size_t> set) const {
    return make_delassus(rows, std::move(set), of_dof.size(),
                         {[this](std::span<double> b, int columns) { invert(b, columns); }});
  }

  /// r = f - F(u) on the dofs b, zero elsewhere.
  void residual(const ExternalForce& f, std::span<const double> u, const PointStep& step, std::span<double> r) {
    std::fill(force.begin(), force.end(), 0.0);
    system.solid.add_internal_force_of(cells, u, force, step);
    std::fill(r.begin(), r.end(), 0.0);
    for (const std::size_t i : dofs) r[i] = f[i] - force[i];
  }

  const System& system;
  std::vector<std::size_t> dofs;
  std::vector<Index> of_dof;                        ///< position in `dofs`, -1 elsewhere
  std::vector<Index> cells;                         ///< that touch them
  std::shared_ptr<const TangentPlace> factored_at;  ///< K_bb of nonlinear bodies
  std::vector<double> force;
  std::vector<ClosingRow> closing;  ///< every row, in order
  std::optional<Cholesky> factor;
  Delassus W;
  ContactOperator contact_operator;
  NodeCompliance of_nodes;  ///< of K_bb
};

/// What the dofs b are brought into equilibrium for.
struct SemiExplicit::Target {
  const State& begin;
  double dt;
  PointStep step() const { return step_from(begin, dt); }
};

SemiExplicit::SemiExplicit(const System& system, int max_iterations)
    : system_(system),
      max_iterations_(max_iterations),
      reach_(system.contact.reach()),
      start_(system),
      boundary_(std::make_unique<Boundary>(system)) {
  if (system.mass.kind() != MassKind::lumped) throw std::invalid_argument("the modified mass is a lumped one");
  const std::size_t n = system.solid.dof_count();
  v_half_.resize(n);
  residual_.resize(n);
  push_.resize(n);
  try {
    const std::vector<double> history = initial_history(system.solid);
    boundary_->factorise(v_half_, {0.0, history});
  } catch (const std::runtime_error& e) {
    throw std::invalid_argument(fmt::format(
        "the contact nodes are not held by their cells, so that they cannot go without mass: {}", e.what()));
  }
}
SemiExplicit::~SemiExplicit() = default;

std::string SemiExplicit::solver_name(const State& /*state*/) const {
  return fmt::format("lumped mass, Cholesky factorisation of {} contact dofs", boundary_->dofs.size());
}

/// What the rows would see at u + residual_, the answer of the dofs b to their residual.
void SemiExplicit::see_rows(const Target& target, std::span<const double> u, const ConstraintRows& rows) {
  std::vector<ClosingRow>& closing = boundary_->closing;
  closing.resize(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3 w = rows.relative(r, u), w_begin = rows.relative(r, target.begin.q), dw = rows.relative(r, residual_);
    closing[r] = {
        r, {rows.gap[r] + w[0] + dw[0], w[1] - w_begin[1] + dw[1], w[2] - w_begin[2] + dw[2]}, rows.gap_rounding(r, u)};
  }
}

/// Names a row that closes between nodes that all have their mass, which multipliers cannot move; empty without one.
std::string SemiExplicit::unanswered(const ConstraintRows& rows) const {
  const std::vector<double>& mass = system_.mass.node_diagonal();
  for (const ClosingRow& c : boundary_->closing) {
    if (c.w[0] >= -c.round_off) continue;
    bool gives_way = false, has_mass = false;
    for (auto k = static_cast<std::size_t>(rows.begin[c.row]); k < static_cast<std::size_t>(rows.begin[c.row + 1]);
         ++k) {
      for (Index i = 3 * rows.node[k]; i < 3 * rows.node[k] + 3; ++i) {
        gives_way = gives_way || boundary_->of_dof[static_cast<std::size_t>(i)] >= 0;
        has_mass = has_mass || (mass[static_cast<std::size_t>(i / 3)] > 0.0 && !system_.supports.is_prescribed(i));
      }
    }
    if (gives_way || !has_mass) continue;
    return fmt::format(
        "contact closes between faces that did not look at each other at the start, so that their nodes have kept "
        "their mass: {}. Choose another scheme (cd_lagrange), or contact of kind = \"all\", whose nodes all go without "
        "mass",
        system_.contact.describe(rows, c.row));
  }
  return {};
}

/// u += residual_ + push_ on the dofs b.
SemiExplicit::Correction SemiExplicit::correct(const Target& target, std::span<double> u) {
  double change = 0.0, place = 0.0, motion = 0.0;
  for (const std::size_t i : boundary_->dofs) {
    const double du = residual_[i] + push_[i];
    u[i] += du;
    const double x = std::abs(u[i]) + reach_;
    change += du * du;
    place += x * x;
    motion += (u[i] - target.begin.q[i]) * (u[i] - target.begin.q[i]);
  }
  constexpr double round_off = 64.0 * std::numeric_limits<double>::epsilon();
  return {std::sqrt(change), std::sqrt(motion), 1e-12 * std::sqrt(motion) + round_off * std::sqrt(place)};
}

/// Finds u on the dofs b and the multipliers. Returns why it failed, empty when it did not.
std::string SemiExplicit::equilibrate(const Target& target, std::span<double> u, Forces& forces, int& iterations) {
  Boundary& b = *boundary_;
  std::vector<RowHistory> history(target.begin.contact.begin(), target.begin.contact.end());
  const bool is_linear = system_.solid.is_linear();
  std::shared_ptr<const ConstraintRows> rows;
  for (iterations = 1;; ++iterations) {
    b.residual(forces.external, u, target.step(), residual_);
    b.invert(residual_, 1);
    const bool follows = iterations <= most_row_updates && !system_.contact.is_fixed();
    if (follows || !rows) rows = system_.contact.rows_at(target.begin.q, u, past_of(target.begin));
    open_response(rows, history.size(), forces.rows);
    see_rows(target, u, *rows);
    std::string failure = unanswered(*rows);
    if (failure.empty())
      failure = close_rows(system_.contact, b.closing, history, b.contact_operator, forces.rows, push_);
    if (!failure.empty()) return failure;
    const Correction c = correct(target, u);
    if (!std::isfinite(c.change)) return "the forces are not finite";
    // Linear bodies are in equilibrium with the forces of any rows; Newton on the others may end once rows are kept.
    if ((is_linear && !follows) || c.change <= c.negligible) break;
    if (iterations == max_iterations_) return no_equilibrium(iterations, c);
    history = forces.rows.history;
    constexpr int patience = 8;  // iterations with one factorisation
    if (iterations % patience == 0 && !is_linear) b.factorise(u, target.step());
  }
  forces.contact.clear(u.size());
  forces.rows.add_force(forces.contact);
  return {};
}

std::string SemiExplicit::no_equilibrium(int iterations, const Correction& c) const {
  return fmt::format(
      "the contact nodes find no equilibrium in {} iterations: the last moved them by {:.3g}, of {:.3g} in this step "
      "(asked: {:.3g}). Shorten the step (time.step or time.safety)",
      iterations, c.change, c.motion, c.negligible);
}

/// Accelerations of the dofs i; those of the imposed ones stand in `state`.
void SemiExplicit::accelerate(State& state) const {
  const Forces& forces = state.forces;
  const std::vector<double>& m = system_.mass.node_diagonal();
  parallel_each(state.a.size(), [&](std::size_t i) {
    if (system_.supports.is_prescribed(static_cast<Index>(i))) return;
    state.a[i] = m[i / 3] > 0.0 ? (forces.external[i] - forces.internal[i] + forces.contact[i]) / m[i / 3] : 0.0;
  });
}

void SemiExplicit::start(State& state, double dt) {
  const std::vector<double> velocities = state.v;
  start_with_supports(system_, state);
  for (const std::size_t i : boundary_->dofs) state.v[i] = velocities[i];
  evaluate_loads(system_, state.t, state.forces);
  if (!system_.solid.is_linear()) boundary_->factorise(state.q, {dt, state.points});
  const State given = state;
  int iterations = 0;
  const std::string failure = equilibrate({given, dt}, state.q, state.forces, iterations);
  if (!failure.empty()) throw std::runtime_error("the contact nodes find no equilibrium at the start: " + failure);
  state.memory = boundary_->memory();
  take_history(state.forces.rows, state.q, state.contact);
  evaluate_solid(system_, {dt, given.points}, state);
  imposed_steps(system_.supports, state.t, state.t + dt, state.q, imposed_);
  for (const ImposedStep& s : imposed_) state.a[s.dof] = acceleration_to_middle(s, dt);
  accelerate(state);
  complete_forces(system_, state);
}

StepReport SemiExplicit::step(const State& begin, const StepRequest& request, State& end) {
  const double h = request.dt;
  const std::size_t n = begin.q.size();
  go_on_from(begin, end);
  end.t = request.t_end;
  StepReport report;
  imposed_steps(system_.supports, begin.t, end.t, begin.q, imposed_);
  if (!start_.set(begin, h, imposed_, [h](const ImposedStep& s) { return acceleration_to_middle(s, h); })) {
    report.failure = MassSolver::failure;
    return report;
  }
  const std::span<const double> a_begin = start_.a();
  parallel_each(n, [&](std::size_t i) {
    v_half_[i] = begin.v[i] + 0.5 * h * a_begin[i];
    end.q[i] = begin.q[i] + h * v_half_[i];
  });
  for (const ImposedStep& s : imposed_) {
    v_half_[s.dof] = s.mean_velocity;
    end.q[s.dof] = s.u;
    end.a[s.dof] = acceleration_from_middle(s, h);
  }
  Forces& forces = end.forces;
  evaluate_loads(system_, request.t_end, forces);
  try {
    const auto fixed_rows = system_.contact.is_fixed() ? system_.contact.rows_at(begin.q, begin.q) : nullptr;
    boundary_->go_on(std::get<ModifiedMassMemory>(begin.memory), fixed_rows.get());
    report.failure = equilibrate({begin, h}, end.q, forces, report.iterations);
  } catch (const std::runtime_error& e) {
    report.failure = e.what();  // a stiffness that has become indefinite
  }
  if (!report.failure.empty()) return report;
  end.memory = boundary_->memory();
  evaluate_solid(system_, step_from(begin, h), end);
  accelerate(end);
  parallel_each(n, [&](std::size_t i) { end.v[i] = v_half_[i] + 0.5 * h * end.a[i]; });
  for (const std::size_t i : boundary_->dofs) end.v[i] = (end.q[i] - begin.q[i]) / h;
  take_history(forces.rows, end.q, end.contact);
  for (const ImposedStep& s : imposed_) end.v[s.dof] = s.v;
  complete_forces(system_, end);
  report.books =
      central_difference_books(system_, begin, start_.balance(), a_begin, multiplier_work(begin, end, 0.5), end, h);
  report.converged = true;
  return report;
}

SchemeRow modified_mass_row() {
  return {.make = [](const SchemeRequest& r) -> std::unique_ptr<Scheme> {
            return std::make_unique<SemiExplicit>(r.system, r.settings.max_iterations);
          },
          .stability_limit = [](const SchemeParameters& /*parameters*/) { return 2.0; }};
}

}  // namespace carom
