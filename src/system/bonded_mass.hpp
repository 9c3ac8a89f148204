// Bonds that hold exactly in what the mass alone decides: explicit steps, impulses, accelerations at the start.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/closing_rows.hpp"
#include "system/mass_solver.hpp"

namespace carom {

/// The displacement at which the bonds of the model are to hold, and the velocity with which their sides part.
struct BondMotion {
  double h = 0.0;                   ///< length of the step
  std::span<const double> u, v, a;  ///< a holds the accelerations of the prescribed dofs
};

/// The forces lambda of the bonds, G their rows (all of them together: they act on each other), with
///   (G M^-1 G^T) lambda = -(G M^-1 f + k_v G v / h + k_u G u / h^2),
/// so that M a = f + G^T lambda keeps what G u = G v = 0 was at the start; the last terms take back what rounding and
/// the mean accelerations of imposed motions leave (Baumgarte, Comput. Methods Appl. Mech. Eng. 1, 1972), slowly enough
/// for every explicit scheme. The matrix is factored once, as sparse as the mass is diagonal. Bonds add no stiffness:
/// the highest frequency of bodies that they join is at most the highest of the bodies (Rayleigh's quotient on fewer
/// motions), so that the stable step stays. Forces are zero on dofs that are fixed on both sides.
class BondedMass {
 public:
  enum class Bonds : std::uint8_t { all, equations };
  /// Refers to the solver. Equations alone are held where springs hold the ties.
  BondedMass(const System& system, MassSolver& mass, Bonds which = Bonds::all);
  ~BondedMass();
  BondedMass(const BondedMass&) = delete;

  bool any() const;
  /// Finds the forces that the bonds among forces.rows need beside all other `forces`, with status and history, and
  /// puts them into forces.contact in place of those that they had. Returns why no such forces were found, "" when they
  /// were.
  std::string hold(const BondMotion& motion, Forces& forces);
  /// Does the same for forces that balance known accelerations and another force on the left side:
  ///   G M^-1 (M a + besides - f - G^T lambda) = 0.
  std::string balance(std::span<const double> a, Forces& forces, std::span<const double> besides = {});
  /// The operator from forces on rows that are no bonds to accelerations of the bodies that bonds keep together:
  ///   A^-1 = M^-1 - M^-1 G^T (G M^-1 G^T)^-1 G M^-1; mass_operator without bonds.
  ContactOperator contact_operator();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// G^T s of the rows that are no bonds, as a dof vector.
std::vector<double> force_of_contact(const ContactResponse& response, std::size_t dofs);

}  // namespace carom
