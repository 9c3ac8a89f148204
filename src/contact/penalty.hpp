// Penalty enforcement of unilateral contact with regularised Coulomb friction and normal damping.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/constraint_rows.hpp"
#include "model/model.hpp"
#include "state/state.hpp"

namespace carom {

/// Stiffnesses of one row, already times its measure: force per length (eps_N, eps_T), force per velocity (damping).
struct PenaltyParameters {
  double eps_N = 0.0;
  double eps_T = 0.0;
  double damping = 0.0;
};

enum class RowStatus : std::uint8_t { open, stick, slip };

/// What the rows answer at one configuration. Forces are those on the positive side, in the row's frame (normal,
/// tangent_1, tangent_2).
struct PenaltyResponse {
  std::vector<Vec3> force;
  std::vector<double> damper;  ///< part of the normal force that the spring eps_N <-g> does not give
  std::vector<RowStatus> status;
  std::vector<RowHistory> history;  ///< elastic slip at this configuration
  double stored = 0.0;              ///< sum of 1/2 eps_N <-g>^2 + 1/2 eps_T |s_e|^2 (ledger: contact_stored)
  double slip_work = 0.0;           ///< sum of |force_T| x slip since x_begin (ledger: friction)
};

/// 3 x 3 tangent of one row in its frame, row-major: -d(force)/d(w).
using RowTangent = std::array<double, 9>;

/// The penalty port of contact (Wriggers, Computational Contact Mechanics, 2nd ed., sections 5.2 and 10.5):
///   p = eps_N <-g>, and with a damper p = max(0, -eps_N g - c dg/dt) in the steps that begin with the row closed: a
///   damper that acted at first touch would make the force jump within an implicit step, which then has no solution;
///   trial t = eps_T (s_e + w_T(x) - w_T(x_begin)), returned to |t| <= mu p; open rows forget their slip.
class Penalty {
 public:
  Penalty(ConstraintRows rows, std::vector<PenaltyParameters> parameters);

  const ConstraintRows& rows() const { return rows_; }
  const std::vector<PenaltyParameters>& parameters() const { return parameters_; }

  /// Forces at displacement x and velocity v, the history standing at displacement x_begin.
  void evaluate(std::span<const double> x_begin, std::span<const double> x, std::span<const double> v,
                std::span<const RowHistory> history, PenaltyResponse& response) const;

  /// f += G^T force.
  void add_force(const PenaltyResponse& response, std::span<double> f) const;

  /// Tangent of row r for the same arguments, when the velocity follows the displacement with slope dv_dx.
  RowTangent tangent(std::size_t r, std::span<const double> x_begin, std::span<const double> x,
                     std::span<const double> v, std::span<const RowHistory> history, double dv_dx) const;

  /// y += G^T diag(eps_N, eps_T, eps_T) G x with every row closed: the stiffness that the stable step must allow for.
  void add_closed_stiffness(std::span<const double> x, std::span<double> y) const;
  /// d += the diagonal of that stiffness, one entry per dof.
  void add_closed_diagonal(std::span<double> d) const;

 private:
  struct RowForce;
  RowForce row_force(std::size_t r, std::span<const double> x_begin, std::span<const double> x,
                     std::span<const double> v, const RowHistory& history) const;

  ConstraintRows rows_;
  std::vector<PenaltyParameters> parameters_;
};

/// Parameters of every row from its contact definition, times the row's measure.
std::vector<PenaltyParameters> penalty_parameters(const Model& model, const ConstraintRows& rows);

}  // namespace carom
