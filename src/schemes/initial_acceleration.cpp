#include "schemes/initial_acceleration.hpp"

#include <stdexcept>

#include "parallel/threads.hpp"

namespace carom {

void start_with_supports(const System& system, State& state) {
  const std::size_t n = system.solid.dof_count();
  state.q.resize(n, 0.0);
  state.v.resize(n, 0.0);
  state.a.assign(n, 0.0);
  state.contact.resize(system.contact.rows().size());
  const std::vector<bool>& fixed = system.supports.fixed();
  for (std::size_t i = 0; i < n; ++i) {
    if (fixed[i]) state.v[i] = 0.0;
  }
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    if (p.kind == MotionKind::displacement) {
      state.q[i] = p.function(state.t);
      state.v[i] = p.function.derivative(state.t);
    } else if (p.kind == MotionKind::velocity) {
      state.v[i] = p.function(state.t);
    }
  }
}

void force_sum(const Forces& forces, std::span<double> rhs) {
  parallel_each(rhs.size(),
                [&](std::size_t i) { rhs[i] = forces.external[i] - forces.internal[i] + forces.contact[i]; });
}

void start_accelerations(const System& system, MassSolver& solver, State& state, Forces& forces) {
  std::vector<double> rhs(state.a.size());
  force_sum(forces, rhs);
  if (solver.solve(rhs, state.a) < 0) throw std::runtime_error("the initial accelerations cannot be solved for");
  complete_forces(system, state, forces);
}

}  // namespace carom
