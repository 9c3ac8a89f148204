#include "march/run_books.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "march/body_scales.hpp"
#include "math/vec3.hpp"
#include "parallel/threads.hpp"

namespace carom {

namespace {

RunMonitor::StageKind stage_kind(const Stage& stage, const State& begin) {
  const bool is_static = !has_inertia(stage.settings().kind);
  const double of_accelerations = is_static ? 0.0 : 0.125 * stage.dt() * stage.dt() * begin.forces.inertia_power;
  return {stage.reversible_energy(), is_static, is_explicit(stage.settings().kind), of_accelerations};
}

RunMonitor::Bodies bodies_of(const Simulation& s, const Stage& stage, double rest) {
  const std::vector<double>& masses = stage.mass().node_diagonal();
  return {sum_of(masses), rest, momenta_of(s.model())};
}

}  // namespace

GivenMotion given_motion(const Stage& stage, const State& state, const std::vector<double>& v_before) {
  std::vector<double> p(v_before.size());
  stage.mass().apply(v_before, p);
  const double kinetic_before = 0.5 * dot(p, v_before);
  const MomentArms arms(stage.system(), state.q);
  std::array<double, 6> before{};
  for (std::size_t i = 0; i < p.size(); ++i) add_with_moment(arms.at(i / 3), i % 3, p[i], before.data());
  GivenMotion given{state.forces.stored.kinetic - kinetic_before, state.forces.total_momentum};
  for (std::size_t c = 0; c < 3; ++c) {
    given.momentum.linear[c] -= before[c];
    given.momentum.angular[c] -= before[3 + c];
  }
  return given;
}

RunBooks::RunBooks(const Simulation& simulation, const Stage& stage, const State& begin, double rest)
    : s_(simulation),
      ledger_(begin.forces.stored, begin.forces.total_momentum, reach(s_.mesh())),
      monitor_(ledger_, bodies_of(s_, stage, rest), stage_kind(stage, begin)) {}

double RunBooks::begin_stage(const Stage& stage, const State& begin, const GivenMotion& given) {
  ledger_.give(given.kinetic, given.momentum);
  const EnergyTerms before = ledger_.now(), &after = begin.forces.stored;
  LedgerIncrement jump;
  jump.energy = change_of_state(before, after);
  jump.energy.algorithmic = -jump.energy.mechanical() - jump.energy.lost();
  const Momentum now = begin.forces.total_momentum;
  for (std::size_t c = 0; c < 3; ++c) {
    jump.impulse.linear[c] = now.linear[c] - ledger_.momentum().linear[c] - given.momentum.linear[c];
    jump.impulse.angular[c] = now.angular[c] - ledger_.momentum().angular[c] - given.momentum.angular[c];
  }
  ledger_.add(jump, now);
  monitor_.begin_stage(stage_kind(stage, begin), -jump.energy.contact_stored);
  return jump.energy.mechanical();
}

/// Magnitude of the impulse of the loads over a step, by their forces at its end; static stages have none.
double RunBooks::load_impulse(const Stage& stage, const State& end, double dt) const {
  if (s_.model().loads.empty() || !has_inertia(stage.settings().kind)) return 0.0;
  const std::vector<double>& f = end.forces.external.value;
  const std::vector<Index>& nodes = s_.solid().loads().nodes();
  const auto sum = parallel_sums<3>(nodes.size(), [&](std::size_t k, std::array<double, 3>& s) {
    for (std::size_t c = 0; c < 3; ++c) s[c] += f[3 * static_cast<std::size_t>(nodes[k]) + c];
  });
  return norm(sum) * dt;
}

void RunBooks::add_step(const Stage& stage, const State& end, const StepReport& report, double dt) {
  ledger_.add(report.books, end.forces.total_momentum);
  monitor_.update(load_impulse(stage, end, dt), report.rounding);
  body_strain_ = std::max(body_strain_, s_.solid().turning_bodies().largest_strain(end.q));
  alarm_ = monitor_.alarm(s_.given().guards.energy_growth);
}

void RunBooks::add_eroded(const State& after, const EnergyTerms& stored_before, const SolidEnergies& gone) {
  LedgerIncrement jump;
  jump.energy = change_of_state(stored_before, after.forces.stored);
  jump.energy.eroded = gone.strain + gone.plastic + gone.hourglass + gone.hourglass_loss + gone.viscous +
                       gone.distortion - jump.energy.contact_stored;
  const Momentum now = after.forces.total_momentum;
  for (std::size_t c = 0; c < 3; ++c) {
    jump.impulse.linear[c] = now.linear[c] - ledger_.momentum().linear[c];
    jump.impulse.angular[c] = now.angular[c] - ledger_.momentum().angular[c];
  }
  ledger_.add(jump, now);
}

}  // namespace carom
