// The rows that would close, and the multipliers that keep them open or just closed.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "contact/contact_geometry.hpp"
#include "rows/delassus.hpp"
#include "rows/response.hpp"

namespace carom {

/// The operator A of W = G A^-1 G^T, which belongs to the bodies and which contact knows by these functions only.
struct ContactOperator {
  /// Makes W of the chosen rows, or of more, in ascending order.
  std::function<Delassus(const ConstraintRows&, const std::vector<std::size_t>& chosen)> delassus;
  /// Overwrites a dof vector b by A^-1 b, zero on fixed dofs.
  std::function<void(std::span<double> b)> inverse;
};

/// A row that takes part, with the w, in its frame, that it would have without multipliers. w_n includes the gap, or
/// what stands for it.
struct ClosingRow {
  std::size_t row = 0;
  Vec3 w{};
  double round_off = 0.0;  ///< how much of w rounding may have made
};

/// Finds the multipliers of solve_cone for w + W r on the rows given (none of them a bond: BondedMass), working only on
/// those that close: rows are added
/// until none of the others closes under the answer of these. `response` has been opened (open_response) and receives
/// the multipliers, x receives A^-1 G^T r. Start values are those of the history. Multipliers are good when they are
/// exact for w that differ from the given ones by 1e-5 of the largest, or by their rounding; as a rule they are to
/// 1e-12, but rows that contradict each other (twins of two passes, each linearised about another facet) leave more
/// than that undetermined. What is accepted lets closed surfaces come together by 1e-5 of the way that the fastest row
/// moves, and does that part of the work of the forces, which the ledger books; rows are linear in the motion of a
/// step, and leave out more: motion over facet size, some 1e-3 in impacts. To ask for less is to ask forces that cancel
/// to grow until a row slips (two balls of 4,600 cells with friction, the first third: 76 % of the solutions of two
/// passes end between 1e-7 and 1e-5, of surface to surface 0.3 %; the normal speeds of rebound agree to 2e-5). Returns
/// why there are none and where, "" when there are.
std::string close_rows(const ContactGeometry& contact, const std::vector<ClosingRow>& rows,
                       std::span<const RowHistory> history, const ContactOperator& contact_operator,
                       ContactResponse& response, std::span<double> x);

/// Clears the response for these rows and the history of multipliers: every row open.
void open_response(std::shared_ptr<const ConstraintRows> rows, std::size_t slots, ContactResponse& response);

}  // namespace carom
