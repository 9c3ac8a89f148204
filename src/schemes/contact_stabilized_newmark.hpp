// Newmark's scheme, its predictor kept out of the obstacle.
#pragma once

#include <utility>
#include <vector>

#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// u_hat = the admissible displacement (G u + gap >= 0) that is nearest to u0 + h v0 in the norm of M,
/// M a~ = (1 - gamma) (f0 - F0) + gamma (f1 - F1) + contact(u1),  u1 = u_hat + h^2/2 a~,  v1 = v0 + h a~
/// (Deuflhard, Krause and Ertel, Int. J. Numer. Methods Eng. 73, 2008; there with gamma = 1/2; this is Newmark's scheme
/// with beta = gamma/2, its contact force implicit). Contact is by multipliers, friction by the slip of the step.
/// Order 2 between impacts for gamma = 1/2, else 1; unconditionally stable (linear); the energy of linear bodies never
/// grows, and is constant while contact does not change (gamma = 1/2). Conserves linear momentum. The acceleration of
/// the state is the mean a~, the reactions likewise. With delta = u_hat - u0 - h v0 = M^-1 G^T mu, du = h v_bar +
/// delta:
///   algorithmic = delta . M a~ - (gamma - 1/2) d(f - F) . du.
class ContactStabilizedNewmark final : public Scheme {
 public:
  /// parameters: gamma 1/2 ... 1. settings.enforcement is lagrange.
  ContactStabilizedNewmark(const System& system, const ContactStabilizedParameters& parameters,
                           const ImplicitSettings& settings, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 1.0; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state, 1); }

 private:
  StageReport project(const State& begin, const StepRequest& request);

  const System& system_;
  double gamma_;
  ImplicitStage projection_, stage_;
  State projected_;
  std::vector<ImposedStep> imposed_;
  std::vector<double> x_predicted_, zero_, known_;
};

}  // namespace carom
