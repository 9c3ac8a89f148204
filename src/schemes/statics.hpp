// Statics: equilibrium at the end of every step, without inertia.
#pragma once

#include <utility>
#include <vector>

#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// F(u1) = f(t1) + contact(u1) by Newton's method; v1 = a1 = 0. Loads and imposed displacements are those at the end of
/// the step; imposed velocities and accelerations move their dofs by their integrals. Friction follows the path
/// of the steps. Where only contact can hold a body, weak springs on as many of its dofs as it has free motions
/// (FreeModes) give the operator of Newton's method an inverse; the equation does not have them. Their stiffness is
/// a node's, and closed rows take the springs off again that they make needless (penalty, augmented Lagrangian); or 0.1
/// of it (multipliers, whose compliance must not be lost in rounding). A load that neither supports nor closed rows
/// resist closes the rows it would reach first; where there are none, there is no equilibrium, and the step fails.
/// There is no inertia and no momentum: impulses are not booked. algorithmic = sum over k of du . (mean of both ends -
/// force at the end): what an initial lack of equilibrium or a sudden load would have left in motion.
class Statics final : public Scheme {
 public:
  Statics(const System& system, const ImplicitSettings& settings, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 1.0; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state); }

 private:
  const System& system_;
  FreeModes free_;
  ImplicitStage stage_;
  std::vector<double> zero_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
