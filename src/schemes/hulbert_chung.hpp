// Hulbert and Chung's explicit generalised-alpha scheme.
#pragma once

#include <utility>
#include <vector>

#include "enforcement/explicit_contact.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/scheme.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// With e_n the scheme's own accelerations (State::memory) and M a_n = f(t_n) - F(u_n) + contact(u_n, v_n):
///   (1 - alpha_m) e1 + alpha_m e0 = a0,
///   u1 = u0 + h v0 + h^2 ((1/2 - beta) e0 + beta e1),  v1 = v0 + h ((1 - gamma) e0 + gamma e1),
///   alpha_m = (2 r - 1)/(1 + r),  beta = (5 - 3 r)/((1 + r)^2 (2 - r)),  gamma = 3/2 - alpha_m
/// (Hulbert and Chung, Comput. Methods Appl. Mech. Eng. 137, 1996, with the spectral radius r at the bifurcation
/// point). e0 is the acceleration (1 - alpha_m) h before its end of the step that has made it; after one of length h',
/// a step takes a0 + h / h' (e0 - a0) for it, which is that as long before a0 as its own length asks. Order 2; stable
/// for omega h <= stability_limit. The state's accelerations are a_n. Momenta are exact, the impulses being those of
/// the forces filtered like e. Penalty contact. Imposed dofs move by the exact integrals of their functions; their a
/// give their velocities by the scheme's rule.
class HulbertChung final : public Scheme {
 public:
  /// parameters: spectral radius 0 ... 1
  HulbertChung(const System& system, const SpectralRadius& parameters);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 0.5; }
  std::string solver_name(const State& /*state*/) const override { return mass_solver_.name(); }

 private:
  const System& system_;
  double alpha_m_, beta_, gamma_;
  std::unique_ptr<ExplicitContact> contact_;
  MassSolver mass_solver_;
  StepStart start_;
  std::vector<double> rhs_, A_, B_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
