#include "schemes/initial_acceleration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/page_memory.hpp"
#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "schemes/imposed_motion.hpp"
#include "solid/point_history.hpp"
#include "system/bonded_mass.hpp"

namespace carom {

void start_with_supports(const System& system, State& state) {
  const std::size_t n = system.solid.dof_count();
  state.q.resize(n, 0.0);
  state.v.resize(n, 0.0);
  state.a.resize(n);
  release_pages(state.a);
  if (state.points.size() != history_size(system.solid)) state.points = initial_history(system.solid);
  state.contact.resize(system.contact.slots(state.topology));
  State fresh;
  fresh.topology = state.topology;
  carry_memory(fresh, state);
  const std::vector<bool>& fixed = system.supports.fixed();
  for (std::size_t i = 0; i < n; ++i) {
    if (fixed[i]) state.v[i] = 0.0;
  }
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    const Supports::Motion& motion = system.supports.motions()[p.motion];
    if (motion.kind == MotionKind::displacement) state.q[i] = motion.function(state.t);
    state.v[i] = imposed_velocity(system.supports, p, state.t);
  }
}

void start_multipliers(const System& system, MassSolver& solver, double dt, State& state) {
  Forces& forces = state.forces;
  const std::shared_ptr<const ConstraintRows> shared = forces.rows.rows;
  const ConstraintRows& rows = *shared;
  forces.contact.clear(state.q.size());
  open_response(shared, state.contact.size(), forces.rows);
  BondedMass bonds(system, solver);
  const BondMotion motion{dt, state.q, state.v, state.a};
  if (!bonds.hold(motion, forces).empty()) throw std::runtime_error("the ties find no forces at the start");
  std::vector<double> rhs(state.q.size()), a_free = state.a;
  force_sum(forces, rhs);
  if (solver.solve(rhs, a_free) < 0) throw std::runtime_error("the initial accelerations cannot be solved for");
  std::vector<ClosingRow> closing;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (is_bond(rows.law[r]) || !rows.is_closed(r, state.q)) continue;
    const Vec3 a = rows.relative(r, a_free), v = rows.relative(r, state.v);
    closing.push_back({r, {a[0] + std::max(0.0, v[0]) / dt, a[1] + v[1] / dt, a[2] + v[2] / dt}});
  }
  if (!closing.empty()) solver.factorise();
  std::vector<double> push(state.q.size());
  if (!close_rows(system.contact, closing, state.contact, bonds.contact_operator(), forces.rows, push).empty())
    open_response(shared, state.contact.size(), forces.rows);
  forces.contact.clear(state.q.size());
  forces.rows.add_force(forces.contact);
  if (!closing.empty() && !bonds.hold(motion, forces).empty())
    throw std::runtime_error("the ties find no forces at the start");
  take_history(forces.rows, state.q, state.contact);
}

void start_equations(const System& system, MassSolver& solver, double dt, State& state) {
  if (system.contact.equations().size() == 0) return;
  BondedMass bonds(system, solver, BondedMass::Bonds::equations);
  if (!bonds.hold({dt, state.q, state.v, state.a}, state.forces).empty())
    throw std::runtime_error("the equations find no forces at the start");
  take_history(state.forces.rows, state.q, state.contact);
}

void start_accelerations(const System& system, MassSolver& solver, State& state) {
  std::vector<double> rhs(state.a.size());
  force_sum(state.forces, rhs);
  if (solver.solve(rhs, state.a) < 0) throw std::runtime_error("the initial accelerations cannot be solved for");
  complete_forces(system, state);
}

void start_lumped_accelerations(const System& system, const Holding& nodes, State& state) {
  const Forces& forces = state.forces;
  nodes.each_range([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
      if ((system.supports.fixed_components(i / 3) >> (i % 3) & 1U) != 0) continue;
      const double m = system.mass.node_diagonal()[i / 3];
      state.a[i] = m > 0.0 ? (forces.external[i] - forces.internal[i] + forces.contact[i]) / m : 0.0;
    }
  });
  complete_forces_without_inertia(system, nodes, state);
}

}  // namespace carom
