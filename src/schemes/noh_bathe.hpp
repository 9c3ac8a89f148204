// Noh and Bathe's explicit scheme of two sub-steps.
#pragma once

#include <utility>
#include <vector>

#include "enforcement/explicit_contact.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/scheme.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// A step of central differences to t_p = t0 + p h, then with k = (1 - p) h
///   u1 = u_p + k v_p + k^2/2 a_p,  M a1 = f(t1) - F(u1) + contact,  v1 = v_p + k (q0 a0 + (1/2 + q1) a_p + q2 a1),
///   q1 = (1 - 2 p)/(2 p (1 - p)),  q2 = 1/2 - p q1,  q0 = 1/2 - q1 - q2
/// (Noh and Bathe, Computers and Structures 129, 2013). Order 2; two force evaluations a step; stable for omega h <=
/// stability_limit (3.745 for p = 0.54, which dissipates the high frequencies). Momenta are exact. Penalty contact,
/// evaluated at both sub-steps. Imposed dofs move by the exact integrals of their functions.
class NohBathe final : public Scheme {
 public:
  NohBathe(const System& system, const NohBatheParameters& parameters);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override;
  std::string solver_name(const State& /*state*/) const override { return mass_solver_.name(); }

 private:
  double middle_weight() const;
  bool first_part(const State& begin, const StepRequest& request, StepReport& report);
  bool second_part(const StepRequest& request, State& end, StepReport& report);
  bool solve(State& state, StepReport& report);
  LedgerIncrement books(const State& begin, const StepRequest& request, const State& end);

  const System& system_;
  double p_, q0_, q1_, q2_;
  std::unique_ptr<ExplicitContact> contact_;
  MassSolver mass_solver_;
  StepStart start_;
  State middle_;
  std::vector<double> rhs_, predicted_, A_, B_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
