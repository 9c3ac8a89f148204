// The energy-momentum scheme: forces between two configurations, as discrete gradients of stored energies.
#pragma once

#include <utility>
#include <vector>

#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// u1 = u0 + h/2 (v0 + v1),  M (v1 - v0) = h (f~ - F~ + C~),
/// with f~ the mean of the loads at both ends, F~ the discrete gradient of the strain energy (Solid::
/// discrete_gradient_force; Simo and Tarnow, ZAMP 43, 1992; Gonzalez, Comput. Methods Appl. Mech. Eng. 190, 2000) and
/// C~ that of the contact potential Phi, that of RowLaw (Laursen and Chawla, Int. J. Numer. Methods Eng. 40, 1997;
/// Armero and Petocz, Comput. Methods Appl. Mech. Eng. 158, 1998), on the rows made at the middle:
///   p = -(Phi(g1) - Phi(g0)) / (g1 - g0).
/// Regularised friction is the return mapping at the middle of the step, its slip s1 = 2 s_mid - s0, so that its work
/// is exactly what it stores and dissipates. Order 2; energy of bodies of any rotation and strain, with contact on
/// fixed rows, is conserved exactly at any step, and so are both momenta; for linear bodies it is the midpoint rule,
/// unconditionally stable. Newton's method takes K at the middle, so that it converges linearly, the faster the smaller
/// the step, where the body is not linear. The acceleration of the state is the mean of the step, reactions likewise.
/// algorithmic = 0.
class EnergyMomentum final : public Scheme {
 public:
  /// settings.enforcement is penalty.
  EnergyMomentum(const System& system, const ImplicitSettings& settings, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 1.0; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state); }

 private:
  StageForce discrete_gradient();

  const System& system_;
  const State* begin_ = nullptr;  ///< of the step under way
  ImplicitStage stage_;
  std::vector<ImposedStep> imposed_;
  std::vector<double> x_hat_, known_, mean_internal_;
  std::vector<double> middle_;  ///< (u0 + u1) / 2 of the iterate
};

}  // namespace carom
