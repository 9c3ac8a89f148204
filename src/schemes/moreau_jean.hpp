// Moreau and Jean's theta scheme with impulses.
#pragma once

#include <utility>
#include <vector>

#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// u1 = u0 + h (theta v1 + (1 - theta) v0),
/// M (v1 - v0) = h [theta (f1 - F1) + (1 - theta) (f0 - F0)] + G^T p
/// (Jean, Comput. Methods Appl. Mech. Eng. 177, 1999), with Newton's restitution and Coulomb's cone for p on the rows
/// that u0 + h/2 v0 closes (ImpulsePort): a row that has closed keeps a penetration of at most one step's motion. Order
/// 2 between impacts for theta = 1/2, else 1; first order across them. Unconditionally stable (linear) for
/// theta >= 1/2; for 1/2 it conserves the energy of linear bodies between impacts. Conserves linear momentum. The
/// acceleration of the state is the mean of the step, (v1 - v0) / h, the contact force p / h, the reactions are means
/// likewise. With du = h v_bar + h (theta - 1/2) dv, v_bar the mean of both ends:
///   algorithmic = (theta - 1/2) [dv . M dv - d(f - F) . du].
class MoreauJean final : public Scheme {
 public:
  /// parameters: theta 1/2 ... 1. settings.enforcement is impulse.
  MoreauJean(const System& system, const MoreauJeanParameters& parameters, const ImplicitSettings& settings, double dt,
             double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 1.0; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state); }

 private:
  const System& system_;
  double theta_;
  ImplicitStage stage_;
  std::vector<ImposedStep> imposed_;
  std::vector<double> x_hat_, x_predicted_, known_;
};

}  // namespace carom
