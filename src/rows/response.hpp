// The answer of contact at one configuration, whichever enforcement has made it.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "parallel/threads.hpp"
#include "rows/admissible.hpp"
#include "rows/constraint_rows.hpp"
#include "rows/node_forces.hpp"
#include "rows/row_history.hpp"

namespace carom {

/// The forces on the rows at one configuration, with status and new history. Forces act on the positive side and stand
/// in the row's frame (normal, tangent_1, tangent_2). There is one entry per row, and one history per slot.
struct ContactResponse {
  std::shared_ptr<const ConstraintRows> rows;
  std::vector<Vec3> force;
  std::vector<double> damper;  ///< part of the normal force that a damper gives
  std::vector<RowStatus> status;
  std::vector<RowHistory> history;
  double stored = 0.0;     ///< sum of RowLaw::spring_energy + 1/2 eps_T |s_e|^2 (ledger: contact_stored)
  double slip_work = 0.0;  ///< work of the friction forces on the slip of the step (ledger: friction)

  /// f += G^T force.
  void add_force(NodeForces& f) const;
  void add_force(std::span<double> f) const;
  /// Compares by value, the rows as well.
  friend bool operator==(const ContactResponse& a, const ContactResponse& b);
};

template <class A>
void fields(A& archive, ContactResponse& x) {
  archive("rows", x.rows);
  archive("force", x.force);
  archive("damper", x.damper);
  archive("status", x.status);
  archive("history", x.history);
  archive("stored", x.stored);
  archive("slip_work", x.slip_work);
}

/// Enters into the history which facet each row is behind at displacement u: where its gap is negative or a part
/// of it is behind (ConstraintRows::has_entered), its own facet.
/// In the next step the row is taken to be behind that facet, however deep it goes, until it comes out in front.
void mark_behind(const ConstraintRows& rows, std::span<const double> u, std::vector<RowHistory>& history);

/// Sets the history to that of the response, and enters which facets its rows are behind at displacement u.
void take_history(const ContactResponse& response, std::span<const double> u, std::vector<RowHistory>& history);

/// The tangent of one row in its frame, -d(force)/d(w), 3 x 3, row-major.
using RowTangent = std::array<double, 9>;

/// True unless the tangent is zero.
inline bool acts(const RowTangent& D) {
  return !is_zero(D);
}
/// D w
inline Vec3 product(const RowTangent& D, const Vec3& w) {
  return {D[0] * w[0] + D[1] * w[1] + D[2] * w[2], D[3] * w[0] + D[4] * w[1] + D[5] * w[2],
          D[6] * w[0] + D[7] * w[1] + D[8] * w[2]};
}

}  // namespace carom
