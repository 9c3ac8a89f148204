#include "schemes/imposed_motion.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "parallel/threads.hpp"

namespace carom {

namespace {

/// What one motion adds to all of its dofs.
struct MotionOverStep {
  double way = 0.0;       ///< integral of the velocity, without that at the beginning where the acceleration is imposed
  double v_begin = 0.0;   ///< beside PrescribedDof::start_velocity
  double v = 0.0;         ///< the same at the end
  double position = 0.0;  ///< where the displacement is imposed, and of the centre of a rotation
  double a_begin = 0.0;
  double angle_begin = 0.0, angle = 0.0, turned = 0.0;     ///< of a rotation; at the end less at the beginning
  double rate_begin = 0.0, rate = 0.0, rate_change = 0.0;  ///< of the angle; its second derivative at the beginning
};

MotionOverStep over_step(const Supports::Motion& motion, double begin, double end) {
  const TimeFunction& f = motion.function;
  MotionOverStep out;
  switch (motion.kind) {
    case MotionKind::displacement:
      out = {0.0, f.derivative(begin), f.derivative(end), f(end), 0.0};
      out.a_begin = (out.v - out.v_begin) / (end - begin);
      break;
    case MotionKind::velocity:
      out = {f.integral(begin, end), f(begin), f(end), 0.0, f.derivative(begin)};
      break;
    case MotionKind::acceleration:
      out = {f.second_integral(begin, end), f.integral(0.0, begin), f.integral(0.0, end), 0.0, f(begin)};
      break;
    case MotionKind::rotation: {
      const TimeFunction& centre = motion.travel;
      out = {centre.integral(begin, end), centre(begin), centre(end), centre.integral(0.0, end),
             centre.derivative(begin)};
      out.angle_begin = f.integral(0.0, begin);
      out.turned = f.integral(begin, end);
      out.angle = f.integral(0.0, end);
      out.rate_begin = f(begin);
      out.rate = f(end);
      out.rate_change = f.derivative(begin);
      break;
    }
  }
  return out;
}

/// Adds the rotation of the point to the way of its centre: (cos a - 1) p + sin a q, whose derivatives by the angle are
/// -sin a p + cos a q and -(cos a p + sin a q). Position by the angle since the start of the run, so that nothing adds
/// up.
void add_rotation(const MotionOverStep& m, const PrescribedDof& point, double h, ImposedStep& step) {
  const double p = point.cosine, q = point.sine;
  const auto slope = [&](double angle) { return q * std::cos(angle) - p * std::sin(angle); };
  const double half = std::sin(0.5 * m.angle);
  step.u = m.position + std::sin(m.angle) * q - 2.0 * half * half * p;
  step.mean_velocity = (m.way + 2.0 * std::sin(0.5 * m.turned) * slope(0.5 * (m.angle_begin + m.angle))) / h;
  step.v_begin += m.rate_begin * slope(m.angle_begin);
  step.v += m.rate * slope(m.angle);
  step.a_begin += m.rate_change * slope(m.angle_begin) -
                  m.rate_begin * m.rate_begin * (p * std::cos(m.angle_begin) + q * std::sin(m.angle_begin));
}

}  // namespace

double imposed_velocity(const Supports& supports, const PrescribedDof& p, double t) {
  const auto& [kind, f, travel] = supports.motions()[p.motion];
  switch (kind) {
    case MotionKind::displacement:
      return f.derivative(t);
    case MotionKind::velocity:
      return f(t);
    case MotionKind::rotation: {
      const double angle = f.integral(0.0, t);
      return travel(t) + f(t) * (p.sine * std::cos(angle) - p.cosine * std::sin(angle));
    }
    case MotionKind::acceleration:
      break;
  }
  return p.start_velocity + f.integral(0.0, t);
}

void imposed_steps(const Supports& supports, double begin, double end, std::span<const double> u,
                   std::vector<ImposedStep>& steps) {
  std::vector<MotionOverStep> motions;
  for (const Supports::Motion& motion : supports.motions()) motions.push_back(over_step(motion, begin, end));
  const double h = end - begin;
  steps.clear();
  for (const PrescribedDof& p : supports.prescribed()) {
    const MotionOverStep& m = motions[p.motion];
    const auto i = static_cast<std::size_t>(p.dof);
    ImposedStep step{i, 0.0, p.start_velocity + m.v, p.start_velocity + m.v_begin, 0.0, m.a_begin};
    const MotionKind kind = supports.motions()[p.motion].kind;
    if (kind == MotionKind::rotation) {
      add_rotation(m, p, h, step);
      steps.push_back(step);
      continue;
    }
    const double way = kind == MotionKind::displacement ? m.position - u[i]
                       : kind == MotionKind::velocity   ? m.way
                                                        : m.way + h * step.v_begin;
    step.u = kind == MotionKind::displacement ? m.position : u[i] + way;
    step.mean_velocity = way / h;
    steps.push_back(step);
  }
}

bool StepStart::set(std::span<const double> a, double h, std::span<const ImposedStep> steps, const Wanted& wanted) {
  is_changed_ = false;
  a_ = a;
  const std::vector<double>& masses = system_.mass.node_diagonal();
  for (const ImposedStep& s : steps) {
    if (masses[s.dof / 3] == 0.0) continue;  // as of what holds an obstacle: nobody feels its acceleration
    const double change = wanted(s) - a[s.dof];
    // Velocities are known to a relative 1e-16, and accelerations are their differences.
    const double noise = 16.0 * std::numeric_limits<double>::epsilon() *
                         (std::abs(s.v_begin) + std::abs(s.mean_velocity) + std::abs(s.v)) / h;
    if (std::abs(change) <= noise) continue;
    if (!is_changed_) change_.assign(a.size(), 0.0);
    is_changed_ = true;
    change_[s.dof] = change;
  }
  if (!is_changed_) return true;
  product_.assign(a.size(), 0.0);
  if (mass_solver_.solve(product_, change_) < 0) return false;
  own_.resize(a.size());
  parallel_each(own_.size(), [&](std::size_t i) { own_[i] = a[i] + change_[i]; });
  a_ = own_;
  return true;
}

bool StepStart::set(const State& begin, double h, std::span<const ImposedStep> steps, const Wanted& wanted) {
  const Forces& forces = begin.forces;
  balance_.emplace(forces);
  if (!set(begin.a, h, steps, wanted)) return false;
  if (!is_changed_) return true;
  product_.resize(a_.size());
  system_.mass.apply(a_, product_);
  inertia_ = forces.inertia;
  supports_ = forces.supports;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::size_t i = steps[k].dof;
    if (!inertia_.empty()) inertia_[i] = product_[i];
    supports_[k].inertia = product_[i];
    supports_[k].reaction = product_[i] + forces.internal[i] - forces.external[i] - forces.contact[i];
  }
  balance_->inertia = inertia_;
  balance_->supports = supports_;
  balance_->inertia_power = dot(a_, product_);
  return true;
}

Momentum StepStart::change(std::span<const double> u) {
  if (!is_changed_) return {};
  system_.mass.apply(change_, product_);
  const MomentArms arms(system_, u);
  std::array<double, 6> sums{};
  for (const PrescribedDof& p : system_.supports.prescribed()) {
    const auto i = static_cast<std::size_t>(p.dof);
    add_with_moment(arms.at(i / 3), i % 3, product_[i], sums.data());
  }
  return momentum_from(sums.data());
}

}  // namespace carom
