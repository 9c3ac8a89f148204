// Contact springs within implicit stages: penalty and augmented Lagrangian.
#pragma once

#include <memory>
#include <vector>

#include "enforcement/contact_port.hpp"
#include "enforcement/held_rows.hpp"

namespace carom {

/// The penalty (rows/penalty.hpp), whose tangents are those of the rows of the iterate. HeldRows holds linear equations
/// exactly beside it.
class PenaltyPort : public ContactPort {
 public:
  explicit PenaltyPort(const System& system);

  void begin(const StageStart& start) override;
  bool is_law() const override { return true; }
  bool is_function() const override { return true; }
  void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) override;
  ContactError error(std::span<const double> x, std::span<const double> v,
                     const ContactResponse& response) const override;
  PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                  const ContactResponse& response, std::span<const double> residual, double absolute,
                  std::span<double> dy) override;
  void relieve(std::span<const double> x, const ContactResponse& response, std::span<double> residual) const override;
  bool settle(std::span<const double> x, const ContactResponse& response) override;
  void add_stiffness_diagonal(std::span<double> d) const override;
  /// Books friction on the slip, and dampers and the total by the trapezoidal rule.
  ContactWork work(const State& begin, const State& end, double end_weight) const override;

 protected:
  /// The spring of a row as if it were closed and sticking: its tangent, and the normal force that it would have at x.
  struct ClosedSpring {
    RowTangent tangent;
    double force;
  };
  virtual ClosedSpring closed_spring(const ConstraintRows& rows, std::size_t r, std::span<const double> x) const;
  /// Solves the linear system with tangents_. Where a load acts on a free motion that these tangents do not resist, the
  /// open rows that the motion would reach first (within a hundredth of the smallest cell) count as closed, and if that
  /// is not enough, sliding rows as sticking.
  PortSolve solve_with_tangents(EffectiveSolver& solver, std::span<const double> x, const ContactResponse& response,
                                std::span<const double> residual, double absolute, std::span<double> dy);

  /// The rows with tangents_, together with the springs that resist motion beside the rows
  /// (RowMaker::append_stiffness).
  struct Stiffness {
    std::shared_ptr<const ConstraintRows> rows;
    std::vector<RowTangent> tangents;
  };
  Stiffness stiffness_of(const ContactResponse& response) const;

  /// The tangent of row r, an equation.
  RowTangent held_tangent(const ConstraintRows& rows, std::size_t r) const {
    return {held_.stiffness(rows, r), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  }
  /// |x - begin| times the norm of the rounding of forces.
  double work_of(std::span<const double> rounding, std::span<const double> x) const;

  const System& system_;
  HeldRows held_;
  const State* begin_ = nullptr;
  double s_ = 0.0, dv_dx_ = 0.0;
  CountedSlip slip_ = CountedSlip::after_touch;
  std::vector<RowTangent> tangents_;

 private:
  std::string hold_bodies(const ContactResponse& response, std::span<const double> x, std::span<const double> residual);
  bool close_reached(const ConstraintRows& rows, std::span<const double> x, std::span<const double> motion);
  void release_held(EffectiveSolver& solver, const Stiffness& stiffness, std::span<const double> x,
                    const ContactResponse& response, LinearSolveReport& linear, std::span<double> dy);
  bool stick_sliding(const ContactResponse& response, std::span<const double> x);

  const FreeModes* free_ = nullptr;
  std::span<const double> force_parts_;
  double reach_;
  std::vector<double> load_;
};

/// Uzawa's iteration around the penalty (Wriggers, Computational Contact Mechanics, 2nd ed., section 6.3.2):
///   p = <lambda_n - eps_N g>,  t = lambda_t - eps_T slip, returned to |t| <= mu p,
/// the slip being that of the step (rows of faces: face_rows.hpp); the multipliers become the forces wherever the
/// residual is small against the change, and at equilibrium, until no row penetrates, no pressed row is open, and no
/// sticking row slips by more than the given length, and the nodes' accelerations (displacements, without inertia)
/// change no more. Rows of nearly dependent constraints share their forces at will: these alone never settle. The
/// springs are a means only: they store nothing, friction is exact in the limit, and where inertia would make an
/// iteration gain little, they are stiffened to ten times what the body's own diagonal answers. Dampers have no part in
/// it.
class AugmentedLagrangianPort final : public PenaltyPort {
 public:
  AugmentedLagrangianPort(const System& system, double penetration);

  void begin(const StageStart& start) override;
  bool is_law() const override { return false; }
  void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) override;
  PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                  const ContactResponse& response, std::span<const double> residual, double absolute,
                  std::span<double> dy) override;
  ContactError error(std::span<const double> x, std::span<const double> v,
                     const ContactResponse& response) const override;
  bool settle(std::span<const double> x, const ContactResponse& response) override;
  bool renew(std::span<const double> x, const ContactResponse& response, double residual) override;
  ContactWork work(const State& begin, const State& end, double end_weight) const override;

 private:
  struct Update {
    double violation = 0.0;  ///< largest penetration, opening of a pressed row or slip of a sticking one
    double force = 0.0;      ///< 2-norm of the change of the nodal forces
    bool is_settled = false;
  };
  Update update(std::span<const double> x, const ContactResponse& response) const;
  void take_forces(const ContactResponse& response);
  ClosedSpring closed_spring(const ConstraintRows& rows, std::size_t r, std::span<const double> x) const override;
  bool is_static() const { return m_ == 0.0; }
  double stiffening(const ConstraintRows& rows, std::size_t r) const;
  Vec3 multiplier(const ConstraintRows& rows, std::size_t r) const;

  double penetration_;
  double m_ = 1.0, c_ = 0.0;         ///< of the operator
  std::vector<double> diagonal_;     ///< of K
  std::vector<RowHistory> contact_;  ///< of the beginning, but for multipliers
};

}  // namespace carom
