// Impulses that change the velocity at once, in addition to their effect through the equation of the step.
#pragma once

#include <memory>
#include <vector>

#include "enforcement/exact_port.hpp"
#include "enforcement/node_compliance.hpp"
#include "system/bonded_mass.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// ImpulsePort for stages whose velocity is v = v_hat + r (y + ratio M^-1 G^T lambda): the rows see the velocity with
/// its jump, and W is G (A^-1 + ratio M^-1) G^T. Bonds are no impulses, and jump with what they join: for them M^-1
/// stands for A^-1 of BondedMass, which is without any of their forces. The caller adds the jump to the velocity of the
/// stage.
class JumpPort final : public ImpulsePort {
 public:
  /// ratio: 0 or greater. The solver and the bonds are shared with the scheme; the solver factors
  /// once rows act.
  JumpPort(const System& system, double ratio, std::shared_ptr<MassSolver> mass, std::shared_ptr<BondedMass> bonds);

  void leave(StageMemory& memory) const override;

 protected:
  Vec3 value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const override;
  bool go_on_directly() override;
  void add_direct_compliance(const std::shared_ptr<const ConstraintRows>& rows, std::span<const std::size_t> acting,
                             std::span<const std::size_t> counts, Delassus& W) override;
  void see_forces(const ConstraintRows& rows, std::span<const std::size_t> which, std::span<const Vec3> force) override;

 private:
  void invert(std::span<double> b, int columns);
  InverseOperator inverse();

  double ratio_;
  std::shared_ptr<MassSolver> mass_;
  std::shared_ptr<BondedMass> bonds_;
  ContactOperator operator_;
  NodeCompliance nodes_;  ///< of M where it is consistent, which is the same for the whole run
  std::vector<double> load_, jump_;
};

}  // namespace carom
