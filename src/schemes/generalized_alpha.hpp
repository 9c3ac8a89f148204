// The generalised-alpha family: Newmark, HHT, WBZ and Chung-Hulbert as parameters of one scheme.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "enforcement/velocity_impulses.hpp"
#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

struct GeneralizedAlphaParameters {
  double alpha_m = 0.0, alpha_f = 0.0;
  double beta = 0.25, gamma = 0.5;
};

/// Newmark, Journal of the Engineering Mechanics Division 85, 1959.
constexpr GeneralizedAlphaParameters newmark_parameters(double beta, double gamma) {
  return {0.0, 0.0, beta, gamma};
}
/// Hilber, Hughes and Taylor, Earthquake Eng. Struct. Dyn. 5, 1977; alpha in [-1/3, 0].
constexpr GeneralizedAlphaParameters hht_parameters(double alpha) {
  return {0.0, -alpha, 0.25 * (1.0 - alpha) * (1.0 - alpha), 0.5 - alpha};
}
/// Wood, Bossak and Zienkiewicz, Int. J. Numer. Methods Eng. 15, 1980; alpha in [-1, 0], with the spectral
/// radius (1 + alpha) / (1 - alpha) at high frequencies (Chung and Hulbert, 1993).
constexpr GeneralizedAlphaParameters wbz_parameters(double alpha) {
  return {alpha, 0.0, 0.25 * (1.0 - alpha) * (1.0 - alpha), 0.5 - alpha};
}
/// Chung and Hulbert, Journal of Applied Mechanics 60, 1993, eqs. 17, 20, 25: the least damping at low frequencies for
/// the spectral radius rho_inf in [0, 1] at infinite ones.
constexpr GeneralizedAlphaParameters chung_hulbert_parameters(double rho_inf) {
  const double alpha_m = (2.0 * rho_inf - 1.0) / (rho_inf + 1.0), alpha_f = rho_inf / (rho_inf + 1.0);
  const double e = 1.0 - alpha_m + alpha_f;
  return {alpha_m, alpha_f, 0.25 * e * e, 0.5 - alpha_m + alpha_f};
}

/// u1 = u0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1),  v1 = v0 + h ((1 - gamma) a0 + gamma a1),
/// M ((1 - alpha_m) a1 + alpha_m a0) + (1 - alpha_f) (F1 - f1) + alpha_f (F0 - f0) = contact(u1, v1)
/// (Chung and Hulbert, Journal of Applied Mechanics 60, 1993; contact at the end of the step). Order 2 for
/// gamma = 1/2 - alpha_m + alpha_f, else 1; unconditionally stable (linear) for alpha_m <= alpha_f <= 1/2 and
/// beta >= 1/4 + (alpha_f - alpha_m) / 2. Newmark with 1/4, 1/2 conserves the energy of linear bodies; all conserve
/// linear momentum. The unknown of Newton's method is a1. Imposed dofs move by the exact integrals of their functions
/// (ImposedStep); their accelerations give their velocities by the scheme's rule, which is what their neighbours feel
/// through a consistent mass. The impulses of the ledger follow from M a: with e1 the resultant that
/// (1 - alpha_m) e1 + alpha_m e0 = forces of the equation defines, it is h ((1 - gamma) e0 + gamma e1); e is the
/// scheme's memory.
///
/// With VelocityImpulses contact is implicit (Kane, Repetto, Ortiz and Marsden, Comput. Methods Appl. Mech. Eng. 180,
/// 1999): s = a - M^-1 G^T lambda takes the place of a above, and the multipliers lambda and the forces Lambda of the
/// velocities act for the whole step,
///   u1 = ... + h^2/2 M^-1 G^T lambda1,  v1 = ... + h M^-1 G^T Lambda.
/// A node that touches is stopped, and the next step remembers nothing of it. Newmark with 1/4, 1/2 keeps the energy
/// between touches.
class GeneralizedAlpha final : public Scheme {
 public:
  /// omega_max_squared: a bound of the spectrum of M^-1 K, for the choice of the solver; dt: the usual step.
  GeneralizedAlpha(const System& system, const GeneralizedAlphaParameters& parameters, const ImplicitSettings& settings,
                   double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return parameters_.gamma; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state); }

 private:
  bool predict(const State& begin, double h, State& end);
  bool stop_at_rows(const State& begin, double h, State& end, StepReport& report);
  std::string settle_bonds(const State& begin, State& end);
  Momentum impulse(double h, const State& begin, State& end, const Momentum& force);
  Momentum resultant_of(std::span<const double> u, std::span<const double> acceleration);

  const System& system_;
  GeneralizedAlphaParameters parameters_;
  StepStart start_;
  ImplicitStage stage_;
  std::vector<ImposedStep> imposed_;
  std::unique_ptr<VelocityImpulses> impulses_;
  std::vector<double> pushed_begin_, pushed_end_;  ///< M^-1 G^T lambda, with impulses
  std::vector<double> u_predicted_, v_predicted_, known_, inertia_;
};

}  // namespace carom
