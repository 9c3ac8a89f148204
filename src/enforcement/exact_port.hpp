// Exact contact within implicit stages: multipliers on displacements, impulses on velocities.
#pragma once

#include <memory>
#include <vector>

#include "enforcement/contact_port.hpp"
#include "enforcement/port_compliance.hpp"
#include "rows/admissible.hpp"
#include "rows/cone_solver.hpp"

namespace carom {

/// The forces lambda on the rows that satisfy Signorini's and Coulomb's conditions exactly:
///   w = w_free + slope G A^-1 G^T lambda,  (lambda, w) in the cones of solve_cone,
/// where w_free is what the rows would see without lambda. A row takes part as soon as it would be violated, a bond
/// from the beginning. PortCompliance makes G A^-1 G^T and decides what of it is kept. The multipliers of a step are
/// the start values of the next, in State::contact.
class ExactPort : public ContactPort {
 public:
  explicit ExactPort(const System& system);

  void begin(const StageStart& start) override;
  bool is_law() const override { return false; }
  void respond(std::span<const double> x, std::span<const double> v, ContactResponse& response) override;
  PortSolve solve(EffectiveSolver& solver, std::span<const double> x, std::span<const double> v,
                  const ContactResponse& response, std::span<const double> residual, double absolute,
                  std::span<double> dy) override;
  bool settle(std::span<const double> x, const ContactResponse& response) override;
  void add_stiffness_diagonal(std::span<double> d) const override;
  ContactWork work(const State& begin, const State& end, double end_weight) const override;
  void leave(StageMemory& memory) const override;

 protected:
  virtual std::shared_ptr<const ConstraintRows> rows_at(std::span<const double> x) const = 0;
  /// slope() is the derivative by y of the vector that the rows see, and seen() says which of x and v that is.
  virtual double slope() const = 0;
  virtual std::span<const double> seen(std::span<const double> x, std::span<const double> v) const = 0;
  /// The w of row r when the rows see z.
  virtual Vec3 value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const = 0;
  /// True when the rows are those at the end of the correction.
  virtual bool rows_follow() const { return false; }
  virtual bool may_act(std::size_t /*r*/) const { return true; }
  virtual Admissible admitted(const RowLaw& law) const { return admissible(law); }
  /// Adds to W the compliance that acting rows (counts[i] components of row i) have beside slope x G A^-1 G^T, divided
  /// by the slope. There is none here, but in JumpPort.
  virtual void add_direct_compliance(const std::shared_ptr<const ConstraintRows>& /*rows*/,
                                     std::span<const std::size_t> /*acting*/, std::span<const std::size_t> /*counts*/,
                                     Delassus& /*W*/) {}
  /// Brings the compliances that add_direct_compliance keeps to those of the state at the beginning of the stage.
  /// Returns true when they were others.
  virtual bool go_on_directly() { return false; }
  /// From now on value() includes the direct effect of these forces, which are in the frames of the listed rows.
  virtual void see_forces(const ConstraintRows& /*rows*/, std::span<const std::size_t> /*which*/,
                          std::span<const Vec3> /*force*/) {}

  const System& system_;
  double extent_;  ///< ContactGeometry::reach: gaps are known to its rounding
  StageStart start_;
  std::vector<Vec3> multiplier_;  ///< per slot, a vector of space
  std::vector<double>
      compliance_of_;  ///< per slot, of the last solve: slope x largest diagonal entry of W, 0: not in it
  bool is_solved_ = false;

 private:
  bool forget_stale(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& rows);
  bool go_on(EffectiveSolver& solver);
  InverseOperator inverse(EffectiveSolver& solver, LinearSolveReport& linear) const;
  bool choose(const ConstraintRows& rows, std::span<const double> z, std::span<const double> dy);
  void add(std::size_t r);
  bool assemble(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& shared,
                LinearSolveReport& linear);
  bool take_acting(const ContactResponse& response, std::span<const double> z);
  void use_rows(EffectiveSolver& solver, const std::shared_ptr<const ConstraintRows>& rows);
  std::string solve_surface(EffectiveSolver& solver, const ContactResponse& response, std::span<const double> z,
                            std::span<const double> residual, double absolute, LinearSolveReport& linear,
                            std::span<double> dy);
  const ContactResponse* follow_rows(EffectiveSolver& solver, const ContactResponse& response,
                                     std::span<const double> z, std::span<const double> residual, double absolute,
                                     LinearSolveReport& linear, std::span<double> dy, std::string& failure);
  void move_surface(std::span<double> dy);
  void see_all(const ContactResponse& response);
  void note_compliances(const ConstraintRows& rows);
  std::string solve_rows(const ContactResponse& response);
  void refine(const ConstraintRows& rows, std::span<const Vec3> present);
  void add_forces(EffectiveSolver& solver, const ContactResponse& response, std::span<const double> residual,
                  double absolute, LinearSolveReport& linear, std::span<double> dy);

  std::unique_ptr<PortCompliance> compliance_;
  std::vector<std::size_t> chosen_;  ///< rows that have taken part, in their order
  std::vector<bool> is_chosen_;
  Delassus W_;               ///< of those that may act
  std::vector<Vec3> force_;  ///< of the rows of W_, in their frames
  ConeFactors factors_;      ///< of the systems of the stage
  double looseness_ = 0.0;   ///< error of the forces that is small beside what the rows still have to turn
  ContactResponse followed_[2];
  std::vector<double> free_, moved_;
  std::vector<double> load_;  ///< what the forces have changed since the response
};

/// Multipliers with 0 <= g(x) perpendicular to lambda_n >= 0 at the end of the stage, and slip over the step in
/// Coulomb's cone.
class MultiplierPort : public ExactPort {
 public:
  using ExactPort::ExactPort;
  /// The distance of the multipliers from their conditions on the rows made at x, where rows move or the operator has
  /// springs of its own. Elsewhere the solve has met the conditions.
  ContactError error(std::span<const double> x, std::span<const double> v,
                     const ContactResponse& response) const override;

 protected:
  std::shared_ptr<const ConstraintRows> rows_at(std::span<const double> x) const override;
  double slope() const override { return start_.s; }
  bool rows_follow() const override { return start_.free == nullptr || start_.free->empty(); }
  std::span<const double> seen(std::span<const double> x, std::span<const double> /*v*/) const override { return x; }
  Vec3 value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const override;
};

/// A MultiplierPort without friction. With m M y = contact(x) it finds the admissible x that is nearest to x_hat in the
/// norm of M.
class ProjectionPort final : public MultiplierPort {
 public:
  using MultiplierPort::MultiplierPort;
  /// Lets bonds start without force. The forces of the step before belong to another equation, and their rounding would
  /// move bodies that need no projection.
  void begin(const StageStart& start) override;

 protected:
  Admissible admitted(const RowLaw& law) const override { return admissible(law).without_friction(); }
};

/// Impulses on rows with g(x_predicted) <= 0. With U = G v, 0 <= U_n + e min(0, U_n at the beginning) perpendicular to
/// lambda_n >= 0 (Newton's restitution), and U_t in Coulomb's cone (Jean, Comput. Methods Appl. Mech. Eng. 177, 1999).
/// The rows are those made at x_predicted. For open rows that move see stopped_rows.hpp.
class ImpulsePort : public ExactPort {
 public:
  using ExactPort::ExactPort;
  void begin(const StageStart& start) override;
  ContactError error(std::span<const double> x, std::span<const double> v,
                     const ContactResponse& response) const override;

 protected:
  std::shared_ptr<const ConstraintRows> rows_at(std::span<const double> x) const override;
  double slope() const override { return start_.r; }
  std::span<const double> seen(std::span<const double> /*x*/, std::span<const double> v) const override { return v; }
  Vec3 value(const ConstraintRows& rows, std::size_t r, std::span<const double> z) const override;
  bool may_act(std::size_t r) const override { return may_act_[r]; }

 private:
  std::shared_ptr<const ConstraintRows> rows_;
  std::vector<bool> may_act_;
  std::vector<double> approach_;  ///< by row, the speed at which it may close
};

}  // namespace carom
