// Bathe's composite scheme: the trapezoidal rule, then a three-point backward formula.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "enforcement/velocity_impulses.hpp"
#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// To the middle of the step by the trapezoidal rule, to its end by the backward formula over 0, h/2, h:
///   v_half = v0 + h/4 (a0 + a_half),  u_half = u0 + h/4 (v0 + v_half),
///   h v1 = u0 - 4 u_half + 3 u1,  h a1 = v0 - 4 v_half + 3 v1,
/// M a = f - F + contact at h/2 and at h (Bathe and Baig, Computers and Structures 83, 2005). Order 2; unconditionally
/// stable (linear), spectral radius 0 at infinite frequency. Conserves linear momentum, whose impulse is
/// h/3 (P0 + P_half + P1); energy decays. The ledger books both sub-steps.
///
/// So it is where contact is a law, and with plain multipliers. These make energy at every touch of a node with mass:
/// the trapezoidal rule reflects what it stops, the backward formula makes 5/3 of that, and the multiplier of a row
/// that has opened pushes on through a0. With VelocityImpulses, s = M^-1 (f - F) and multipliers lambda,
///   u_half = u0 + h/2 v0 + h^2/16 (s0 + s_half) + h^2/8 M^-1 G^T lambda_half,
///   v_half = v0 + h/4 (s0 + s_half) + h/2 M^-1 G^T Lambda,
/// the contact force of the first sub-step being that of its end (Kane, Repetto, Ortiz and Marsden, Comput. Methods
/// Appl. Mech. Eng. 180, 1999), and its velocity having forces Lambda of its own (VelocityImpulses): what touches is
/// stopped. The impulse of contact is then h/3 (2 Lambda + lambda_1), order 2 while contact lasts; lambda_half is the
/// mean of the first sub-step, and does its work.
class Bathe final : public Scheme {
 public:
  Bathe(const System& system, const ImplicitSettings& settings, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return impulses_ ? 1.0 : 0.5; }
  std::string solver_name(const State& state) const override { return second_.solver_name(state, 1); }

 private:
  bool to_middle(const State& begin, const StepRequest& request, StepReport& report);
  bool to_end(const State& begin, const StepRequest& request, State& end, StepReport& report);
  /// Place of its stage, what its equation is multiplied by, how displacement and velocity follow the unknown, and its
  /// length.
  struct SubStep {
    std::size_t place;
    double share, s, r, dt;
  };
  /// Solves one sub-step for its unknown.
  bool solve(ImplicitStage& stage, const SubStep& sub_step, const StepRequest& request, const State& begin, State& end,
             StepReport& report);
  bool stop_at_rows(double k, StepReport& report);
  /// Adds the energies of a sub-step to the report.
  void book(const ContactWork& contact, const State& begin, const Balance& balance, const State& end,
            StepReport& report) const;
  Momentum impulse(double h, const State& begin, const State& end);

  const System& system_;
  StepStart start_;
  ImplicitStage first_, second_;
  std::unique_ptr<VelocityImpulses> impulses_;  ///< none where contact is a law or plain, or its nodes have no mass
  State middle_;
  std::vector<ImposedStep> imposed_;                ///< of the sub-step under way
  std::vector<double> pushed_begin_, pushed_half_;  ///< M^-1 G^T lambda at the beginning and in the middle
  std::vector<double> x_hat_, v_hat_, known_;
};

}  // namespace carom
