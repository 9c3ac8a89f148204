// Central differences with a modified mass: contact nodes follow statically.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/closing_rows.hpp"
#include "linalg/cholesky.hpp"
#include "rows/delassus.hpp"
#include "schemes/imposed_motion.hpp"
#include "schemes/scheme.hpp"

namespace carom {

/// The semi-explicit modified mass (Khenous, Laborde and Renard, Eur. J. Mech. A/Solids 27, 2008; Doyen, Ern and
/// Piperno, SIAM J. Sci. Comput. 33, 2011, section 4.4). System::mass is lumped and has no inertia on contact nodes
/// (solid/modified_mass.hpp). Dofs with inertia i move by central differences, the others b by
///   F_b(u_i, u_b) = f_b + G^T lambda,   0 <= g(u_b) perpendicular to lambda_n >= 0,
/// slip increments over the step in Coulomb's cone with lambda_t. Linear bodies: K_bb is factored once and the rows
/// solved on W = G K_bb^-1 G^T, which is kept where rows are fixed. Otherwise Newton on the dofs b, with the cells that
/// touch them; K_bb is factored again where that converges slowly. Order 2 away from changes of contact; stable for
/// omega h <= 2 on the dofs i with the others held; no penetration; momenta exact; algorithmic energy as for central
/// differences. Velocities of the dofs b are differences over the last step. Dofs b without stiffness (bars across
/// their axis) keep their velocity. A row must have a node without mass. start() brings the dofs b into equilibrium.
class SemiExplicit final : public Scheme {
 public:
  /// Throws std::invalid_argument when the mass is not lumped or the contact nodes are not held by their cells.
  explicit SemiExplicit(const System& system, int max_iterations = 50);
  ~SemiExplicit() override;

  void start(State& state, double dt) override;
  StepReport step(const State& begin, const StepRequest& request, State& end) override;
  double end_weight() const override { return 0.5; }
  std::string solver_name(const State& state) const override;

 private:
  struct Boundary;
  struct Target;
  /// 2-norms over the dofs b: of an iteration's correction, of the motion in the step, and what counts as none.
  struct Correction {
    double change = 0.0, motion = 0.0, negligible = 0.0;
  };
  void see_rows(const Target& target, std::span<const double> u, const ConstraintRows& rows);
  std::string unanswered(const ConstraintRows& rows) const;
  Correction correct(const Target& target, std::span<double> u);
  std::string no_equilibrium(int iterations, const Correction& c) const;
  std::string equilibrate(const Target& target, std::span<double> u, Forces& forces, int& iterations);
  void accelerate(State& state) const;

  const System& system_;
  int max_iterations_;
  double reach_;  ///< ContactGeometry::reach
  StepStart start_;
  std::unique_ptr<Boundary> boundary_;
  std::vector<double> v_half_, residual_, push_;
  std::vector<ImposedStep> imposed_;
};

}  // namespace carom
