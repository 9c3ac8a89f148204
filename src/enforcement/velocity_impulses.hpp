// Velocities that the rows in contact allow, where multipliers decide the displacements.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/closing_rows.hpp"
#include "enforcement/node_compliance.hpp"
#include "model/compatibility.hpp"
#include "system/bonded_mass.hpp"
#include "system/mass_solver.hpp"
#include "system/system.hpp"

namespace carom {

/// Multipliers that close a gap at the end of a (sub-)step take a mass that meets the row within it back to the row by
/// any velocity that the kinematics of the step ask for: the trapezoidal rule reflects it. Here the velocity has
/// contact forces Lambda of its own, on the rows that the multipliers hold closed: with v = v* + k M^-1 G^T Lambda,
///   0 <= (G v)_n  perpendicular to  Lambda_n >= 0,   (G v)_t in Coulomb's cone with Lambda_t,
/// which is Newton's impact law without restitution (as displacement and velocity have multipliers each in Gear,
/// Leimkuhler and Gupta, J. Comput. Appl. Math. 12-13, 1985, and in Bruls, Acary and Cardona, Comput. Methods Appl.
/// Mech. Eng. 281, 2014). v is then the admissible velocity that is nearest to v* in the norm of M: energy is lost, and
/// momentum is that of k Lambda. Contact nodes have mass. Bonds are no part of it: what they
/// keep together moves as one (A^-1 of BondedMass).
class VelocityImpulses {
 public:
  explicit VelocityImpulses(const System& system);
  VelocityImpulses(const VelocityImpulses&) = delete;

  /// Fills the accelerations that the forces of a response give the bodies, without those of bonds: a = A^-1 contact
  /// (BondedMass) on the free dofs, 0 on the others. False when the mass matrix cannot be solved.
  bool accelerations(const ContactResponse& contact, std::span<double> a);
  /// Finds the forces of bonds at the end of a stage that has scaled the multipliers: they balance its accelerations
  /// (BondedMass::balance). Returns why there are none, "" when there are.
  std::string settle_bonds(State& state, std::span<const double> besides = {});
  bool has_bonds() const { return bonds_.any(); }
  /// v: v* on entry, v on return. `closed`: the multipliers at the same instant. `nodes`: StageMemory::mass_nodes,
  /// which grows. Returns why there are no such forces, "" when there are.
  std::string respond(double k, const ContactResponse& closed, Growth& nodes, std::span<double> v);

  /// Lambda on the rows of the last respond().
  const ContactResponse& response() const { return response_; }
  /// M^-1 G^T Lambda
  std::span<const double> push() const { return push_; }

 private:
  void invert(std::span<double> b, int columns);
  InverseOperator inverse();
  Delassus of_consistent_mass(const ConstraintRows& rows, const std::vector<std::size_t>& chosen);

  const System& system_;
  MassSolver mass_;
  BondedMass bonds_;
  ContactOperator operator_;
  NodeCompliance nodes_;  ///< of a consistent mass, which is the same for the whole run
  ContactResponse response_;
  std::vector<ClosingRow> closing_;
  std::vector<double> push_;
};

/// Null where contact is a law, where its multipliers are plain, or where free nodes have no mass (a modified mass),
/// since nothing is to be stopped there.
std::unique_ptr<VelocityImpulses> velocity_impulses(const System& system, EnforcementKind enforcement);

}  // namespace carom
