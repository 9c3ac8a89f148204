// Newmark's scheme with penalty contact iterated to convergence.
#pragma once

#include <memory>
#include <vector>

#include "schemes/effective_solver.hpp"
#include "schemes/mass_solver.hpp"
#include "schemes/scheme.hpp"

namespace carom {

struct NewmarkParameters {
  double beta = 0.25;
  double gamma = 0.5;
  int max_iterations = 50;  ///< of the contact state within a step
  SolverKind solver = SolverKind::automatic;
};

/// u1 = u0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1),  v1 = v0 + h ((1 - gamma) a0 + gamma a1),
/// M a1 = f(t1) - F(u1) + contact(u1, v1)  (Newmark, Journal of the Engineering Mechanics Division 85, 1959).
/// Order 2 for gamma = 1/2, else 1; unconditionally stable for 2 beta >= gamma >= 1/2 (linear). The unknown of the
/// Newton iteration is a1: (M + beta h^2 K + G^T (beta h^2 D) G) da = residual. Imposed motions are imposed through a1,
/// so that the kinematic relations, and with them the energy identity of newmark_books, hold on every dof.
class Newmark final : public Scheme {
 public:
  /// omega_max_squared: a bound of the spectrum of M^-1 K, for the choice of the solver; dt: the usual step.
  Newmark(const System& system, const NewmarkParameters& parameters, double dt, double omega_max_squared);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  const Forces& forces() const override { return now_; }
  double end_weight() const override { return parameters_.gamma; }
  std::string solver_name() const override { return solver_->name(); }

 private:
  struct Residual;
  void impose_motions(const StepRequest& request, State& end) const;
  void move(const StepRequest& request, State& end) const;
  Residual residual(const State& begin, const StepRequest& request, const State& end);
  void set_tangents(const State& begin, const State& end, double dt);
  std::string cycling_rows(const std::vector<RowStatus>& before) const;

  const System& system_;
  NewmarkParameters parameters_;
  std::unique_ptr<EffectiveSolver> solver_;
  MassSolver mass_solver_;
  Forces now_, next_;
  std::vector<double> u_predicted_, v_predicted_, residual_, correction_, stiffness_diagonal_;  ///< diagonal of K
  std::vector<double> closed_diagonal_;  ///< with every contact row closed
  std::vector<RowTangent> tangents_;
};

}  // namespace carom
