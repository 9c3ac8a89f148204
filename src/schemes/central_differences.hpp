// Central differences with penalty contact.
#pragma once

#include <vector>

#include "schemes/mass_solver.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// v_{1/2} = v0 + h/2 a0,  u1 = u0 + h v_{1/2},  M a1 = f(t1) - F(u1) + contact(u1, v_{1/2}),  v1 = v_{1/2} + h/2 a1
/// (Hughes, The Finite Element Method, section 9.1: Newmark with beta = 0, gamma = 1/2). Order 2; stable for
/// omega h <= 2; momenta exact; the shadow energy T + U - h^2/8 a.Ma is constant while contact does not change.
/// Imposed motions are imposed through a1, the second difference of their function, as for Newmark.
class CentralDifferences final : public Scheme {
 public:
  explicit CentralDifferences(const System& system);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  const Forces& forces() const override { return now_; }
  double end_weight() const override { return 0.5; }
  std::string solver_name() const override;

 private:
  const System& system_;
  MassSolver mass_solver_;
  Forces now_, next_;
  std::vector<double> v_half_, rhs_;
};

}  // namespace carom
