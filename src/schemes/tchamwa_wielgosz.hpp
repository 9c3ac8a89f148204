// Tchamwa and Wielgosz' explicit scheme.
#pragma once

#include <utility>
#include <vector>

#include "enforcement/explicit_contact.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/scheme.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// u1 = u0 + h v0 + phi h^2 a0,  v1 = v0 + h a0,  M a1 = f(t1) - F(u1) + contact(u1, v1)
/// (Tchamwa, Conway and Wielgosz, ASME PVP 398, 1999). Order 1; stable for omega h <= 2 / sqrt(2 phi - 1); phi > 1
/// dissipates the high frequencies, phi = 1 nothing. Momenta are exact (impulses by the forces at the beginning of the
/// steps). Penalty contact. Imposed dofs move by the exact integrals of their functions, a0 being
/// their mean acceleration.
class TchamwaWielgosz final : public Scheme {
 public:
  TchamwaWielgosz(const System& system, const TchamwaWielgoszParameters& parameters);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 0.0; }
  std::string solver_name(const State& /*state*/) const override { return mass_solver_.name(); }

 private:
  const System& system_;
  double phi_;
  std::unique_ptr<ExplicitContact> contact_;
  MassSolver mass_solver_;
  StepStart start_;
  std::vector<double> rhs_, B_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
