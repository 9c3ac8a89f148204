// The stable step of explicit schemes, contact included.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "linalg/largest_eigenvalue.hpp"
#include "model/compatibility.hpp"
#include "system/system.hpp"

namespace carom {

/// Steps of an explicit scheme with the given stability_limit L.
///
/// dt: the stable step of the linear system, L / omega_max of M^-1 (K + contact stiffness with every row closed), with
/// the lagged dampers of stops those of central differences scaled by L / 2:
///   h = 2 L / (sqrt(d^2 + 4 omega^2) + d),  d = max damping / mass
/// (the roots of z^2 - (2 - omega^2 h^2 - d h) z + 1 - d h stay in the unit circle); artificial viscosity, whose rates
/// are those of the middle of the step, adds to d. Only the penalty adds stiffness:
/// exact enforcements fix what they hold, which lowers no frequency bound. Nodes without mass are held: with the
/// modified mass they follow statically, which is softer, so that the step is one for the condensed system as well.
/// Infinite where nothing vibrates, as in bodies all of whose nodes are led by supports (driven_cells.hpp).
///
/// dt_closing: the longest step at which springs that open and close make no energy to speak of, closing_limit L / 2
/// over the frequency of the springs on the masses alone (contact_frequency_bound). A spring that pushes for the whole
/// step in which it opens, though it touches in a part of it only, gives more than it has stored, by up to
/// (omega h)^2 / 8 of what it holds; the step in which it closes takes as much on the average only. Far below the
/// linear limit that averages out, near it chatter grows: see docs/schemes.md for measurements.
struct StableStep {
  double omega_max_squared = 0.0;       ///< with contact
  double omega_max_squared_free = 0.0;  ///< of the solids alone
  double dt = 0.0;
  double dt_free = 0.0;  ///< without contact
  double dt_closing = 0.0;

  /// The longest step that a run chooses, before it is multiplied by time.safety.
  double advised() const { return dt < dt_closing ? dt : dt_closing; }
};
/// omega h of contact springs alone at dt_closing, for L = 2.
inline constexpr double closing_limit = 1.2;

/// Largest omega^2 of the vibrations of a system at rest, in the reference position. Each costs some tens of actions of
/// the stiffness, when it is asked for first.
class RestFrequencies {
 public:
  explicit RestFrequencies(const System& system) : system_(system) {}
  const System& system() const { return system_; }
  double free() const;    ///< of the solids alone
  double closed() const;  ///< with the springs of every row

 private:
  double largest(std::shared_ptr<const ConstraintRows> rows) const;

  const System& system_;
  mutable std::optional<double> free_, closed_;
};

/// The stable step of an omega^2 alone: L / omega.
double stable_step_of(double limit, double omega_squared);

/// The stable step of a system at rest, in the reference position.
StableStep stable_step(const RestFrequencies& rest, double limit, EnforcementKind enforcement);
StableStep stable_step(const System& system, double limit = 2.0,
                       EnforcementKind enforcement = EnforcementKind::penalty);
/// The stable step with contact alone: the figures without contact stay 0, which halves the work.
StableStep contact_step(const RestFrequencies& rest, double limit, EnforcementKind enforcement);

/// Follows the stable step through a run, as geometry and contact change. Where springs come and go, the square of the
/// frequency of the linear system is bounded by the sum of the squares of the bodies' and of the contact's own (Weyl),
/// instead of being computed.
class StableStepWatch {
 public:
  StableStepWatch(const RestFrequencies& rest, double limit, EnforcementKind enforcement);

  /// Re-estimates the frequency of the bodies at displacement u, where they are nonlinear: that at rest times the
  /// largest growth over the cells of (c / l)^2 (frequency_growth), each cell weighed by its bound at rest. It
  /// is that of elastic changes, since points that yield may unload at any moment. `points`: what they remember at the
  /// end of the step. One sweep over the laws; returns by how much of itself the frequency has changed.
  double follow_bodies(const State& state);
  /// Takes the damping of artificial viscosity from the rates that the points remember of a step, times the growth of
  /// the bodies' omega, since both go with 1 / l. One pass over cells with viscosity. Returns false where there are
  /// none.
  bool follow_damping(std::span<const double> points);
  /// The cell, a position in Solid::cells(), that has the highest frequency since follow_bodies; -1: not known.
  Index worst_cell() const { return worst_cell_; }
  /// The steps when every one of these rows, which are those at displacement u, is closed. Takes a few passes over the
  /// rows, and stops as soon as they show that `wanted` may be advised.
  StableStep with(const ConstraintRows& rows, std::span<const double> u,
                  double wanted = std::numeric_limits<double>::infinity()) const;

 private:
  template <class A>
  friend void fields(A& archive, StableStepWatch& x) {
    archive("omega_squared", x.omega_squared_);
    archive("damping", x.damping_);
    archive("worst_cell", x.worst_cell_);
  }

  const System& system_;
  double limit_;
  EnforcementKind enforcement_;
  double omega_squared_;  ///< of the bodies
  double damping_;        ///< of their viscosity, over mass
  double at_rest_ = 0.0;  ///< omega_squared_ at rest
  Index worst_cell_ = -1;
  std::vector<double> cells_;  ///< where it changes: bounds of the cells' over the largest, at rest
};

}  // namespace carom
