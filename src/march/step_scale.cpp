#include "march/step_scale.hpp"

#include <algorithm>
#include <array>

#include "math/vec3.hpp"

namespace carom {

StepScale::StepScale(const Model& model, const Stage& stage, double least)
    : is_explicit_(carom::is_explicit(stage.settings().kind)), least_(least) {
  const System& system = stage.system();
  for (const ContactDefinition& contact : model.contacts) {
    const ContactParts parts = parts_of(contact);
    if (parts.shape != nullptr && parts.body < 0) obstacles_.push_back({parts.carrier, parts.direction});
  }
  for (const PrescribedDof& p : system.supports.prescribed()) {
    const auto dof = static_cast<std::size_t>(p.dof);
    if (system.mass.node_diagonal()[dof / 3] > 0.0) held_.push_back(dof);
  }
  std::array<bool, 3> is_held{};
  for (const std::size_t dof : held_) is_held[dof % 3] = true;
  is_free_ = !(is_held[0] && is_held[1] && is_held[2]);
  std::vector<double> along_x(system.solid.dof_count(), 0.0), momentum(along_x.size());
  for (std::size_t i = 0; i < along_x.size(); i += 3) along_x[i] = 1.0;
  system.mass.apply(along_x, momentum);
  for (std::size_t i = 0; i < momentum.size(); i += 3) mass_ += momentum[i];
}

/// Their velocity; along an axis that nothing is held along that of the centre of mass.
Vec3 StepScale::of_supports(const State& state) const {
  std::array<double, 3> sum{}, count{};
  for (const std::size_t dof : held_) {
    sum[dof % 3] += state.v[dof];
    count[dof % 3] += 1.0;
  }
  Vec3 w = scaled(state.forces.total_momentum.linear, mass_ > 0.0 ? 1.0 / mass_ : 0.0);
  for (std::size_t c = 0; c < 3; ++c)
    if (count[c] > 0.0) w[c] = sum[c] / count[c];
  return w;
}

/// T as one sees it who moves at the velocity w: T - w . p + 1/2 m w^2.
double StepScale::seen(const State& state) const {
  const EnergyTerms& energy = state.forces.stored;
  const Vec3& p = state.forces.total_momentum.linear;
  const auto kinetic_at = [&](const Vec3& w) { return energy.kinetic - dot(w, p) + 0.5 * mass_ * dot(w, w); };
  const Vec3 of_bodies = scaled(p, mass_ > 0.0 ? 1.0 / mass_ : 0.0);
  double kinetic = (is_free_ ? 2.0 : 1.0) * kinetic_at(of_supports(state));
  for (const Obstacle& obstacle : obstacles_) {
    Vec3 w = obstacle.carrier < 0 ? Vec3{} : vector_at(state.v, static_cast<std::size_t>(obstacle.carrier));
    if (const std::optional<Vec3>& n = obstacle.normal) w = add(of_bodies, scaled(*n, dot(*n, subtract(w, of_bodies))));
    kinetic = std::max(kinetic, kinetic_at(w));
  }
  return kinetic + energy.mechanical() - energy.kinetic;
}

void StepScale::follow(const State& state) {
  largest_ = std::max({largest_, least_, seen(state)});
  frame_ = of_supports(state);
}

double StepScale::of_step_to(const State& end, double friction) const {
  return std::max(largest_, seen(end)) + (is_explicit_ ? friction : 0.0);
}

double StepScale::algorithmic(const LedgerIncrement& step) const {
  return step.energy.algorithmic - dot(frame_, step.lag);
}

}  // namespace carom
