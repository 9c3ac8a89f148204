// Generalised-alpha for the smooth motion, impulses for what contact does to it.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "schemes/generalized_alpha.hpp"
#include "schemes/implicit_stage.hpp"
#include "schemes/scheme.hpp"
#include "system/bonded_mass.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// z: the smooth acceleration, a: the algorithmic one, W: the jump of the velocity that the impulses p make.
///   M z1 + F(u1) = f1,   M W = G^T p,   (1 - alpha_m) a1 + alpha_m a0 = (1 - alpha_f) z1 + alpha_f z0,
///   u1 = u0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1) + h/2 W,   v1 = v0 + h ((1 - gamma) a0 + gamma a1) + W
/// (Chen, Acary, Virlez and Bruls, Int. J. Numer. Methods Eng. 96, 2013; the algorithmic acceleration as in Arnold and
/// Bruls, Multibody System Dynamics 18, 2007), with the parameters of Chung and Hulbert, Newton's restitution and
/// Coulomb's cone for p on the rows that u0 + h/2 v0 closes (ImpulsePort): a row that has closed keeps a penetration of
/// at most one step's motion. Bonds are part of the smooth motion: z
/// balances their forces, and what they join jumps as one. The projection of the positions that Bruls, Acary and
/// Cardona (Comput. Methods Appl. Mech. Eng. 281, 2014) add is not made. Order 2 between impacts, 1 across them and
/// while contact lasts; unconditionally stable (linear, without contact), spectral radius rho_inf at infinite
/// frequency; conserves linear momentum, and for rho_inf = 1 the energy of linear bodies between impacts.
///
/// With y = z1 + W / (2 kappa beta h), kappa = (1 - alpha_f) / (1 - alpha_m), u1 follows y alone, and W remains in
///   v1 = v_hat + gamma kappa h y + (1 - gamma / (2 beta)) W
/// (JumpPort); 2 beta >= gamma for all rho_inf. The acceleration of the state is z + W / h, which balances the contact
/// force p / h; z and a are the scheme's memory. With x_bar the mean and d the difference of both ends, the kinematics
/// give du = h v_bar + h^2 (beta - gamma/2) da, whatever W, and the equations du . M (z_bar + W/h) = works of the mean
/// forces and of p / h; hence
///   algorithmic = du . M (z_bar - (1 - gamma) a0 - gamma a1) + h (beta - gamma/2) da . M dv,
/// which is zero for rho_inf = 1.
class NonsmoothGeneralizedAlpha final : public Scheme {
 public:
  /// parameters: with 2 beta >= gamma > 0; settings.enforcement is impulse.
  NonsmoothGeneralizedAlpha(const System& system, const GeneralizedAlphaParameters& parameters,
                            const ImplicitSettings& settings, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 1.0; }
  std::string solver_name(const State& state) const override { return stage_.solver_name(state); }

 private:
  bool solve_jump(const Forces& forces);
  Momentum jump_resultant(const State& end);
  bool start_from_the_right(const State& begin, double h);
  void split(double h, State& end);
  LedgerIncrement books(const State& begin, double h, State& end);

  const System& system_;
  GeneralizedAlphaParameters parameters_;
  double kappa_;
  std::shared_ptr<MassSolver> mass_solver_;
  std::shared_ptr<BondedMass> bonds_;
  ImplicitStage stage_;
  StepStart start_;
  std::vector<double> u_hat_, v_hat_, carried_, known_, u_predicted_;
  std::vector<double> jump_;  ///< W / h
  std::vector<double> mean_, mean_inertia_;
  NonsmoothMemory old_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
