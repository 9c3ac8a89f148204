#include "system/system.hpp"

#include <array>

#include "parallel/threads.hpp"

namespace carom {

void evaluate_solid(const System& system, const PointStep& step, State& end) {
  Forces& forces = end.forces;
  forces.internal.resize(end.q.size());
  end.points.resize(system.solid.history_size());
  if (system.solid.is_linear() && !system.solid.has_hourglass()) {
    system.solid.internal_force(end.q, forces.internal);
    return;
  }
  const SolidEnergies energies = system.solid.evaluate(end.q, step, forces.internal, end.points);
  forces.stored.strain = energies.strain;
  forces.stored.plastic = energies.plastic;
  forces.stored.hourglass = energies.hourglass;
  forces.stored.hourglass_loss = energies.hourglass_loss;
  forces.stored.viscous = energies.viscous;
  forces.stored.heat = energies.heat;
}

void evaluate_bodies(const System& system, const PointStep& step, State& end) {
  evaluate_solid(system, step, end);
  end.forces.external.resize(end.q.size());
  system.solid.external_force(end.t, system.mass, end.forces.external);
}

Momentum momentum_from(const double* sums) {
  return {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}};
}

void force_sum(const Forces& forces, std::span<double> rhs) {
  parallel_each(rhs.size(),
                [&](std::size_t i) { rhs[i] = forces.external[i] - forces.internal[i] + forces.contact[i]; });
}

void carry_memory(const State& begin, State& end) {
  end.memory = begin.memory;
  end.stages = begin.stages;
  end.within.weight = 0.0;
  end.within.rows = {};
  end.within.u.clear();
}

void go_on_from(const State& begin, State& end) {
  carry_memory(begin, end);
  end.q = begin.q;
  end.v = begin.v;
  end.a = begin.a;
  end.contact = begin.contact;
}

double damping_work(const State& begin, const State& end) {
  double work = 0.0;
  for (const Forces* forces : {&begin.forces, &end.forces}) {
    const ConstraintRows& rows = *forces->rows.rows;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const double f = forces->rows.damper[r];
      if (f != 0.0) work -= 0.5 * f * (rows.relative(r, end.q)[0] - rows.relative(r, begin.q)[0]);
    }
  }
  return work;
}

void complete_forces(const System& system, State& state) {
  Forces& forces = state.forces;
  const std::size_t n = system.solid.dof_count();
  forces.inertia.resize(n);
  forces.momentum.resize(n);
  forces.reaction.assign(n, 0.0);
  system.mass.apply(state.a, forces.inertia);
  system.mass.apply(state.v, forces.momentum);
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    forces.reaction[i] = forces.inertia[i] + forces.internal[i] - forces.external[i] - forces.contact[i];
  }
  const MomentArms arms(system, state.q);
  // v.Mv, u.F (twice the energy of linear bodies), a.Ma, momentum and its moment
  const auto sums = parallel_sums<9>(n / 3, [&](std::size_t node, std::array<double, 9>& s) {
    Vec3 p;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t i = 3 * node + c;
      p[c] = forces.momentum[i];
      s[0] += state.v[i] * p[c];
      s[1] += state.q[i] * forces.internal[i];
      s[2] += state.a[i] * forces.inertia[i];
    }
    add_with_moment(arms.at(node), p, s.data() + 3);
  });
  forces.stored.kinetic = 0.5 * sums[0];
  if (system.solid.is_linear()) forces.stored.strain = 0.5 * sums[1] - forces.stored.hourglass;
  forces.stored.contact_stored = forces.rows.stored;
  forces.inertia_power = sums[2];
  forces.total_momentum = momentum_from(sums.data() + 3);
}

}  // namespace carom
