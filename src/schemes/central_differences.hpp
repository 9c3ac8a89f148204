// Central differences, with any contact that answers explicit steps.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "enforcement/explicit_contact.hpp"
#include "schemes/explicit_books.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/scheme.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// v_{1/2} = v0 + h/2 a0,  u1 = u0 + h v_{1/2},  M a1 = f(t1) - F(u1) + contact,  v1 = v_{1/2} + h/2 a1
/// (Hughes, The Finite Element Method, section 9.1: Newmark with beta = 0, gamma = 1/2). Order 2; stable for
/// omega h <= 2; momenta exact; the shadow energy T + U - h^2/8 a.Ma is constant while contact does not change.
/// Contact is a force of (u1, v_{1/2}) for the penalty; multipliers and impulses are found so that the next step keeps
/// to the rows: as part of a1 they act on v_{3/2} = v_{1/2} + h a1 (explicit_contact.hpp). Steps of changing length
/// keep to them up to that change. Imposed dofs move by the exact integrals of their functions (ImposedStep); v_{1/2}
/// is their mean velocity, and their accelerations lead from v0 to it and from it to v1.
class CentralDifferences final : public Scheme {
 public:
  /// With penalty contact.
  explicit CentralDifferences(const System& system);
  CentralDifferences(const System& system, std::unique_ptr<ExplicitContact> contact);

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 0.5; }
  std::string solver_name(const State& /*state*/) const override { return mass_solver_.name(); }
  /// With a lumped mass and springs each node goes its own way, given the forces of cells and contact.
  const Holding* shared_nodes() const override {
    return is_lumped() && contact_->is_local() ? &system_.solid.shared_nodes() : nullptr;
  }

 private:
  const Holding& nodes() const { return shared_nodes() != nullptr ? *shared_nodes() : system_.solid.all_nodes(); }
  bool is_lumped() const { return system_.mass.kind() == MassKind::lumped; }
  bool end_consistent_step(const State& begin, std::span<const double> a_begin, double h, State& end,
                           StepReport& report);

  const System& system_;
  std::unique_ptr<ExplicitContact> contact_;
  MassSolver mass_solver_;
  StepStart start_;
  PushedNodes pushed_;
  std::vector<double> rhs_;  ///< of a consistent mass
  std::vector<ImposedStep> imposed_, imposed_next_;
};

}  // namespace carom
