#include "schemes/stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/page_memory.hpp"
#include "enforcement/contact_frequency.hpp"
#include "math/vec3.hpp"
#include "parallel/entries.hpp"
#include "parallel/threads.hpp"
#include "schemes/driven_cells.hpp"
#include "solid/stability.hpp"
#include "system/mass_solver.hpp"

namespace carom {

namespace {

/// K + closed contact at rest, and M, on the free dofs with mass. Ranks share the nodes out where M is lumped.
class Vibration {
 public:
  /// rows: nullptr without contact
  Vibration(const System& system, std::shared_ptr<const ConstraintRows> rows)
      : system_(system), rows_(std::move(rows)), u_(unwritten_zeros(system.solid.dof_count())) {
    if (system.mass.kind() != MassKind::lumped)
      consistent_.emplace(system);
    else
      nodes_ = &system.solid.shared_nodes();
  }

  Entries entries() const { return nodes_ != nullptr ? Entries(*nodes_) : Entries(u_.size()); }
  Pencil pencil() {
    return {[this](std::span<const double> x, std::span<double> y) { stiffness(x, y); },
            [this](std::span<const double> x, std::span<double> y) { mass(x, y); },
            [this](std::span<const double> x, std::span<double> y) { inverse_mass(x, y); }};
  }

 private:
  void stiffness(std::span<const double> x, std::span<double> y) const {
    system_.solid.tangent_action(u_, x, y, {.history = {}, .nodes = nodes_});
    if (rows_) add_closed_stiffness(*rows_, x, y);
    if (consistent_) keep_moving(y);  // the inverse of a lumped mass leaves the others out
  }
  void mass(std::span<const double> x, std::span<double> y) const {
    if (nodes_ != nullptr)
      system_.mass.combine(1.0, x, 0.0, y, *nodes_);
    else
      system_.mass.apply(x, y);
  }
  void inverse_mass(std::span<const double> x, std::span<double> y) {
    if (consistent_) {
      std::fill(y.begin(), y.end(), 0.0);
      consistent_->solve(x, y);
    } else {
      entries().each([&](std::size_t i) { y[i] = x[i] / system_.mass.node_diagonal()[i / 3]; });
    }
    keep_moving(y);
  }
  void keep_moving(std::span<double> y) const {
    entries().each([&](std::size_t i) {
      const bool is_fixed = (system_.supports.fixed_components(i / 3) >> (i % 3) & 1U) != 0;
      if (is_fixed || system_.mass.node_diagonal()[i / 3] <= 0.0) y[i] = 0.0;
    });
  }

  const System& system_;
  std::shared_ptr<const ConstraintRows> rows_;
  std::vector<double> u_;
  std::optional<MassSolver> consistent_;
  const Holding* nodes_ = nullptr;  ///< null: every rank has all of them
};

/// Largest sum of damping / mass over the nodes. For the consistent mass of parallelepipeds, M >= 1/8 of its diagonal
/// (Wathen, IMA Journal of Numerical Analysis 7, 1987).
double largest_damping_ratio(const System& system, const ConstraintRows& rows) {
  if (std::none_of(rows.law.begin(), rows.law.end(), [](const RowLaw& law) { return law.damping > 0.0; })) return 0.0;
  const double smallest_share = system.mass.kind() == MassKind::lumped ? 1.0 : 1.0 / 8.0;
  std::vector<double> damping(system.mass.node_diagonal().size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (auto k = static_cast<std::size_t>(rows.begin[r]); k < static_cast<std::size_t>(rows.begin[r + 1]); ++k) {
      const Vec3& n = rows.block[k][0];
      damping[static_cast<std::size_t>(rows.node[k])] += rows.law[r].damping * dot(n, n);
    }
  }
  double d = 0.0;
  for (std::size_t n = 0; n < damping.size(); ++n) {
    const double m = system.mass.node_diagonal()[n] * smallest_share;
    if (m > 0.0) d = std::max(d, damping[n] / m);
  }
  return d;
}

/// Infinite where nothing vibrates: viscosity then acts in cells that supports lead.
double step_of(double limit, double omega_squared, double damping_ratio) {
  if (omega_squared == 0.0) return std::numeric_limits<double>::infinity();
  const double d = damping_ratio;
  return 2.0 * limit / (std::sqrt(d * d + 4.0 * omega_squared) + d);
}

/// Bounds of the cells' omega^2 at rest over the largest of them.
std::vector<double> relative_bounds(const System& system) {
  std::vector<double> bounds = cell_bounds(system);
  const double largest = *std::max_element(bounds.begin(), bounds.end());
  for (double& bound : bounds) bound = largest > 0.0 ? bound / largest : 0.0;
  return bounds;
}

/// The largest omega^2 of a step, the inverse of step_of.
double omega_squared_of(double limit, double step, double damping_ratio) {
  const double h = 2.0 * step / limit;
  return (4.0 - 2.0 * h * damping_ratio) / (h * h);
}

double closing_step(double limit, double contact_omega_squared) {
  return contact_omega_squared > 0.0 ? closing_limit * 0.5 * limit / std::sqrt(contact_omega_squared)
                                     : std::numeric_limits<double>::infinity();
}

}  // namespace

double RestFrequencies::largest(std::shared_ptr<const ConstraintRows> rows) const {
  Vibration vibration(system_, std::move(rows));
  return largest_eigenvalue(vibration.pencil(), vibration.entries(), 1e-5).upper;
}

double RestFrequencies::free() const {
  if (!free_) free_ = largest(nullptr);
  return *free_;
}

double RestFrequencies::closed() const {
  if (closed_) return *closed_;
  const std::vector<double> zero = unwritten_zeros(system_.solid.dof_count());
  const auto rows = system_.contact.rows_at(zero, zero);
  closed_ = largest(std::make_shared<const ConstraintRows>(as_they_close(*rows, zero)));
  return *closed_;
}

double stable_step_of(double limit, double omega_squared) {
  return step_of(limit, omega_squared, 0.0);
}

StableStep contact_step(const RestFrequencies& rest, double limit, EnforcementKind enforcement) {
  const System& system = rest.system();
  StableStep out;
  out.dt_closing = std::numeric_limits<double>::infinity();
  double damping_ratio = largest_damping(system.solid, {});
  if (traits(enforcement).adds_stiffness && system.contact.slots() > 0) {
    const std::vector<double> zero = unwritten_zeros(system.solid.dof_count());
    const auto rows = system.contact.rows_at(zero, zero);
    out.omega_max_squared = rest.closed();
    out.dt_closing = closing_step(limit, contact_frequency_bound(system, *rows, zero));
    damping_ratio += largest_damping_ratio(system, *rows);
  } else {
    out.omega_max_squared = rest.free();
  }
  out.dt = step_of(limit, out.omega_max_squared, damping_ratio);
  return out;
}

StableStep stable_step(const RestFrequencies& rest, double limit, EnforcementKind enforcement) {
  StableStep out = contact_step(rest, limit, enforcement);
  out.omega_max_squared_free = rest.free();
  out.dt_free = step_of(limit, out.omega_max_squared_free, largest_damping(rest.system().solid, {}));
  return out;
}

StableStep stable_step(const System& system, double limit, EnforcementKind enforcement) {
  return stable_step(RestFrequencies(system), limit, enforcement);
}

StableStepWatch::StableStepWatch(const RestFrequencies& rest, double limit, EnforcementKind enforcement)
    : system_(rest.system()),
      limit_(limit),
      enforcement_(enforcement),
      omega_squared_(rest.free()),
      damping_(largest_damping(system_.solid, {})),
      at_rest_(omega_squared_) {
  if (system_.solid.is_linear()) return;
  if (system_.solid.cells().size() > 0) cells_ = relative_bounds(system_);
}

bool StableStepWatch::follow_damping(std::span<const double> points) {
  const double growth = at_rest_ > 0.0 ? omega_squared_ / at_rest_ : 1.0;
  damping_ = largest_damping(system_.solid, points) * std::sqrt(std::max(1.0, growth));
  return damping_ > 0.0;
}

double StableStepWatch::follow_bodies(const State& state) {
  if (cells_.empty() || at_rest_ == 0.0) return 0.0;
  std::vector<double> growth(cells_.size());
  frequency_growth(system_.solid, state.q, {.history = state.points, .is_over = true, .alive = state.alive()}, growth);
  const double before = omega_squared_;
  parallel_each(cells_.size(), [&](std::size_t k) { growth[k] *= cells_[k]; });
  const double own = parallel_max(cells_.size(), 0.0, [&](std::size_t k) { return growth[k]; });
  const auto [largest, worst] =
      largest_on_ranks(own, static_cast<std::size_t>(std::find(growth.begin(), growth.end(), own) - growth.begin()));
  worst_cell_ = static_cast<Index>(worst);
  omega_squared_ = at_rest_ * largest;
  return 0.5 * std::abs(omega_squared_ / before - 1.0);
}

StableStep StableStepWatch::with(const ConstraintRows& rows, std::span<const double> u, double wanted) const {
  StableStep out;
  out.omega_max_squared_free = omega_squared_;
  out.dt_free = step_of(limit_, omega_squared_, damping_);
  const bool has_springs = traits(enforcement_).adds_stiffness && rows.size() > 0;
  const double damping = damping_ + (has_springs ? largest_damping_ratio(system_, rows) : 0.0);
  const double closing = closing_limit * 0.5 * limit_ / wanted;
  const double enough = std::isfinite(wanted)
                            ? std::min(omega_squared_of(limit_, wanted, damping) - omega_squared_, closing * closing)
                            : 0.0;
  const double contact = has_springs ? contact_frequency_bound(system_, rows, u, enough) : 0.0;
  out.omega_max_squared = omega_squared_ + contact;
  out.dt = step_of(limit_, out.omega_max_squared, damping);
  out.dt_closing = closing_step(limit_, contact);
  return out;
}

}  // namespace carom
