// Bathe's composite scheme: the trapezoidal rule, then a three-point backward formula.
#pragma once

#include <utility>
#include <vector>

#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// To the middle of the step by the trapezoidal rule, to its end by the backward formula over 0, h/2, h:
///   v_half = v0 + h/4 (a0 + a_half),  u_half = u0 + h/4 (v0 + v_half),
///   h v1 = u0 - 4 u_half + 3 u1,  h a1 = v0 - 4 v_half + 3 v1,
/// M a = f - F + contact at h/2 and at h (Bathe and Baig, Computers and Structures 83, 2005). Order 2; unconditionally
/// stable (linear), spectral radius 0 at infinite frequency. Conserves linear momentum, whose impulse is
/// h/3 (P0 + P_half + P1); energy decays. The ledger books both sub-steps.
class Bathe final : public Scheme {
 public:
  Bathe(const System& system, const ImplicitSettings& settings, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  void take_back() override { std::swap(now_, next_); }
  const Forces& forces() const override { return now_; }
  double end_weight() const override { return 0.5; }
  ContactWithin contact_within() const override { return {1.0 / 3.0, &half_.rows, middle_.q}; }
  std::string solver_name() const override { return second_.solver_name(); }

 private:
  /// Solves one sub-step for its acceleration, completes its forces and adds its energies to the report.
  bool solve(ImplicitStage& stage, const StageEquation& equation, const StepRequest& request, const State& begin,
             const Forces& forces_begin, State& end, Forces& forces_end, StepReport& report);

  const System& system_;
  StepStart start_;
  ImplicitStage first_, second_;
  Forces now_, half_, next_;
  State middle_;
  std::vector<ImposedStep> imposed_;  ///< of the sub-step under way
  std::vector<double> x_hat_, v_hat_;
};

}  // namespace carom
