#include "system/system.hpp"

#include <algorithm>
#include <array>

#include "base/page_memory.hpp"
#include "parallel/threads.hpp"
#include "solid/point_history.hpp"

namespace carom {

namespace {

/// Hands over what bodies store and have spent.
void take(const SolidEnergies& energies, EnergyTerms& terms) {
  terms.strain = energies.strain;
  terms.plastic = energies.plastic;
  terms.hourglass = energies.hourglass;
  terms.hourglass_loss = energies.hourglass_loss;
  terms.viscous = energies.viscous;
  terms.heat = energies.heat;
  terms.distortion = energies.distortion;
}

}  // namespace

void evaluate_solid(const System& system, const PointStep& step, State& end) {
  Forces& forces = end.forces;
  (step.nodes != nullptr ? *step.nodes : system.solid.all_nodes()).resize(forces.internal);
  if (const std::size_t size = history_size(system.solid); end.points.size() != size)
    end.points = unwritten_zeros(size);
  std::vector<SolidEnergies> of_parts;
  take(system.solid.evaluate(end.q, step, forces.internal, end.points, &of_parts), forces.stored);
  forces.of_parts.resize(of_parts.size());
  for (std::size_t p = 0; p < of_parts.size(); ++p) take(of_parts[p], forces.of_parts[p]);
  forces.stored.fracture = system.solid.cohesive().dissipated(end.points);
}

PointStep start_step(double dt, std::span<const double> points, const State& state) {
  const bool have_flowed = !is_zero(points);
  return {.dt = dt, .history = points, .is_over = have_flowed, .alive = state.alive()};
}

void evaluate_bodies(const System& system, const PointStep& step, State& end) {
  evaluate_solid(system, step, end);
  evaluate_loads(system, end.t, end.forces, JumpSide::after, step.nodes);
}

void evaluate_loads(const System& system, double t, Forces& forces, JumpSide side, const Holding* shared) {
  if (system.solid.loads().empty()) return forces.external.value.clear();
  (shared != nullptr ? *shared : system.solid.all_nodes()).resize(forces.external.value);
  system.solid.loads().force(t, system.mass, forces.external.value, side, shared);
}

Momentum momentum_from(const double* sums) {
  return {{sums[0], sums[1], sums[2]}, {sums[3], sums[4], sums[5]}};
}

void force_sum(const Forces& forces, std::span<double> rhs) {
  parallel_each(rhs.size(),
                [&](std::size_t i) { rhs[i] = forces.external[i] - forces.internal[i] + forces.contact[i]; });
}

void carry_memory(const State& begin, State& end) {
  end.topology = begin.topology;
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

void complete_supports(const System& system, State& state) {
  Forces& forces = state.forces;
  const std::vector<PrescribedDof>& prescribed = system.supports.prescribed();
  forces.supports.resize(prescribed.size());
  std::size_t node = 0;
  Vec3 Ma, Mv, contact;
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    const auto i = static_cast<std::size_t>(prescribed[k].dof);
    const std::size_t c = i % 3;
    if (k == 0 || i / 3 != node) {  // the dofs of a node stand together
      node = i / 3;
      Ma = system.mass.at_node(node, state.a);
      Mv = system.mass.at_node(node, state.v);
      contact = forces.contact.at(node);
    }
    SupportForce& support = forces.supports[k];
    support.inertia = Ma[c];
    support.momentum = Mv[c];
    support.reaction = support.inertia + forces.internal[i] - forces.external[i] - contact[c];
  }
}

void StateSums::give(const System& system, const double* sums, Forces& forces) {
  forces.stored.kinetic = 0.5 * sums[0];
  if (system.solid.is_linear()) forces.stored.strain = 0.5 * sums[1] - forces.stored.hourglass;
  forces.stored.contact_stored = forces.rows.stored;
  forces.inertia_power = sums[2];
  forces.total_momentum = momentum_from(sums + 3);
}

void complete_forces_without_inertia(const System& system, const Holding& nodes, State& state) {
  const StateSums terms(system, state);
  const auto sums = nodes.sums<StateSums::count>([&](std::size_t node, std::array<double, StateSums::count>& s) {
    terms.add(node, vector_at(state.v, node), system.mass.at_node(node, state.v), vector_at(state.a, node),
              system.mass.at_node(node, state.a), s.data());
  });
  StateSums::give(system, sums.data(), state.forces);
  complete_supports(system, state);
}

void complete_forces(const System& system, State& state) {
  Forces& forces = state.forces;
  forces.inertia.resize(state.a.size());
  const StateSums terms(system, state);
  const auto sums = parallel_sums<StateSums::count>(
      state.a.size() / 3, [&](std::size_t node, std::array<double, StateSums::count>& s) {
        const Vec3 Ma = system.mass.at_node(node, state.a);
        std::copy(Ma.begin(), Ma.end(), forces.inertia.begin() + static_cast<std::ptrdiff_t>(3 * node));
        terms.add(node, vector_at(state.v, node), system.mass.at_node(node, state.v), vector_at(state.a, node), Ma,
                  s.data());
      });
  StateSums::give(system, sums.data(), forces);
  complete_supports(system, state);
}

}  // namespace carom
