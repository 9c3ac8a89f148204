// Imposed motions in a step: where they lead exactly, and the accelerations with which the bodies feel it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "system/mass_solver.hpp"
#include "system/system.hpp"

namespace carom {

/// One dof of imposed motion over a step. Displacement, velocity and acceleration are functions of time and their exact
/// integrals, so that they do not depend on the scheme or the step.
struct ImposedStep {
  std::size_t dof = 0;
  double u = 0.0, v = 0.0;     ///< displacement and velocity at its end
  double v_begin = 0.0;        ///< velocity at its beginning
  double mean_velocity = 0.0;  ///< (u - u_begin) / h
  /// Acceleration at its beginning, from the right: that of the function; the mean one where the displacement is
  /// imposed, whose function is made of straight lines.
  double a_begin = 0.0;
};

/// Accelerations of the two halves of a step of central differences, v_{1/2} being the mean velocity.
inline double acceleration_to_middle(const ImposedStep& s, double h) {
  return 2.0 * (s.mean_velocity - s.v_begin) / h;
}
inline double acceleration_from_middle(const ImposedStep& s, double h) {
  return 2.0 * (s.v - s.mean_velocity) / h;
}
/// The acceleration of the dof in schemes with v = v_begin + h a.
inline double mean_acceleration(const ImposedStep& s, double h) {
  return (s.v - s.v_begin) / h;
}

/// Velocity at time t of a dof whose acceleration or velocity is imposed, or the rate of its displacement.
double imposed_velocity(const Supports& supports, const PrescribedDof& p, double t);

/// All imposed dofs over the step from `begin` to `end`, the displacements at its beginning being u; in the order of
/// Supports::prescribed.
void imposed_steps(const Supports& supports, double begin, double end, std::span<const double> u,
                   std::vector<ImposedStep>& steps);

/// Accelerations at the beginning of a step, from the right. An imposed acceleration may jump between two steps (at a
/// kink of its velocity), and with a consistent mass its neighbours' jump along, as M a = f - F + contact stays on the
/// free dofs. The kink therefore ends with its step. If a scheme without dissipation carried it on by its rule, it
/// would ring for ever.
class StepStart {
 public:
  explicit StepStart(const System& system) : system_(system), mass_solver_(system) {}

  using Wanted = std::function<double(const ImposedStep&)>;

  /// a: accelerations from the left; wanted(s): that of the dof of an ImposedStep s from the right. False when the mass
  /// matrix cannot be solved.
  bool set(std::span<const double> a, double h, std::span<const ImposedStep> steps, const Wanted& wanted);
  /// Takes the accelerations of a state at the beginning of a step as those from the left. balance() follows from it as
  /// well.
  bool set(const State& begin, double h, std::span<const ImposedStep> steps, const Wanted& wanted);
  /// The accelerations from the right. Refers to those from the left where nothing has changed.
  std::span<const double> a() const { return a_; }
  /// The inertia and the reactions that balance the forces with these accelerations. Refers to the state at the
  /// beginning where nothing has changed.
  const Balance& balance() const { return *balance_; }
  /// The resultant of M times the change of the accelerations, on the imposed dofs. u: displacement at the beginning.
  Momentum change(std::span<const double> u);

 private:
  const System& system_;
  MassSolver mass_solver_;
  std::vector<double> own_, change_, product_;
  std::vector<double> inertia_;  ///< of a changed beginning
  std::vector<SupportForce> supports_;
  std::span<const double> a_;
  std::optional<Balance> balance_;
  bool is_changed_ = false;
};

}  // namespace carom
