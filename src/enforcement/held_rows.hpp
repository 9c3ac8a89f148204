// Linear equations within implicit stages whose contact has springs: exact all the same.
#pragma once

#include <span>
#include <vector>

#include "enforcement/contact_port.hpp"

namespace carom {

/// The method of multipliers (Hestenes, J. Optim. Theory Appl. 4, 1969) on the rows of linear equations alone:
///   force = lambda - eps w,
/// eps being 1e3 over what the row answers to its own force by the operator's diagonal, and lambda becoming the force
/// at every equilibrium until no w is left but rounding: each update takes off all of w but some 1e-3. Nothing is
/// stored in the springs, and the multipliers do no work.
class HeldRows {
 public:
  explicit HeldRows(const System& system);

  bool any() const { return size_ > 0; }
  /// Takes the multipliers of the state at the beginning of the stage.
  void begin(const StageStart& start);
  /// Adds the forces of the equations at displacement x to a response that lacks them.
  void respond(std::span<const double> x, ContactResponse& response) const;
  /// eps of row r, an equation.
  double stiffness(const ConstraintRows& rows, std::size_t r) const { return stiffness_[place(rows, r)]; }
  /// Adds to `rounding`, on the dofs of the rows, the error of their forces that rounding of w makes.
  void add_rounding(std::span<const double> x, const ContactResponse& response, std::span<double> rounding) const;
  /// True when the equations are met; else their multipliers have been changed.
  bool settle(std::span<const double> x, const ContactResponse& response);

 private:
  std::size_t place(const ConstraintRows& rows, std::size_t r) const {
    return static_cast<std::size_t>(rows.slot[r] - first_slot_);
  }

  const System& system_;
  std::size_t size_;
  Index first_slot_ = 0;
  std::vector<double> diagonal_;  ///< of K
  std::vector<double> stiffness_, multiplier_, miss_;
};

}  // namespace carom
