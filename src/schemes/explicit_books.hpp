// The books of explicit steps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "enforcement/contact_work.hpp"
#include "system/system.hpp"

namespace carom {

/// Books of a step of central differences of length h. With x_bar the mean and d the difference of both ends, the
/// kinematics give d(1/2 v.Mv) = du . (M a)_bar + h^2/8 d(a.Ma), so that algorithmic = -h^2/8 da . (M a0 + M a1) on the
/// free dofs; those of the supports are in their work. balance, a_begin: at the beginning (StepStart) (Krenk,
/// Computer Methods in Applied Mechanics and Engineering 195, 2006, eq. 11 with beta = 0, gamma = 1/2, with forces
/// instead of K u; it holds with whatever forces contact adds). contact: where the work of contact went; its total is
/// summed here.
LedgerIncrement central_difference_books(const System& system, const State& begin, const Balance& balance,
                                         std::span<const double> a_begin, const ContactWork& contact, const State& end,
                                         double h);

/// The nodes that loads or contact may push.
class PushedNodes {
 public:
  explicit PushedNodes(const System& system);
  /// The rows at both ends of a step.
  void look(const ConstraintRows& before, const ConstraintRows& after);
  bool operator[](std::size_t node) const { return is_pushed_[node] != 0; }
  const std::vector<Index>& nodes() const { return nodes_; }
  bool are_all() const { return loaded_ == is_pushed_.size(); }

 private:
  std::size_t loaded_;        ///< how many of the nodes loads may push
  std::vector<Index> nodes_;  ///< these first
  std::vector<std::uint8_t> is_pushed_;
};

/// Ends a step of central differences with a lumped mass, whose forces at its end are there, in one pass over the
/// nodes: a1 = (f - F + contact) / m and v1 = v_{1/2} + h/2 a1 on the free dofs, end.v holding v_{1/2} there and end.a
/// and end.v being complete on the others; what complete_forces gives but for the inertia; and the books, which are
/// returned. nodes: those that a rank holds; all ranks hold those that are pushed, but where loads push all.
LedgerIncrement end_lumped_step(const System& system, const State& begin, const Balance& balance,
                                std::span<const double> a_begin, const ContactWork& contact_work,
                                const PushedNodes& pushed, const Holding& nodes, State& end, double h);

/// Books of a step with u1 = u0 + h v0 + h^2 B,  v1 = v0 + h A. With x_bar the mean of both ends and R = M a the
/// inertia that balances the forces at each end,
///   d(1/2 v.Mv) = v_bar . M dv = du . M A + h^2 (A/2 - B) . M A,
/// so that algorithmic = du . (R_bar - M A) - h^2 (A/2 - B) . M A, on the free dofs. The impulse is left to the caller.
LedgerIncrement explicit_books(const System& system, const State& begin, const Balance& balance,
                               const ContactWork& contact, const State& end, std::span<const double> A,
                               std::span<const double> B, double h);

}  // namespace carom
