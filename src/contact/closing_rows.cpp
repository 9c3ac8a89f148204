#include "contact/closing_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/vec3.hpp"
#include "rows/admissible.hpp"
#include "rows/cone_solver.hpp"

namespace carom {

namespace {

/// Puts the multiplier of row r (in its frame) into response and history.
void set_multiplier(std::size_t r, const Vec3& force, ContactResponse& response) {
  const ConstraintRows& rows = *response.rows;
  response.force[r] = force;
  response.status[r] = admissible(rows.law[r]).status(force);
  response.history[static_cast<std::size_t>(rows.slot[r])].multiplier = rows.to_space(r, force);
}

/// Marks the rows that close at w + G x; false when there is none that was not marked before.
bool mark_closing(const std::vector<ClosingRow>& candidates, const ConstraintRows& rows, std::span<const double> x,
                  std::vector<std::size_t>& chosen) {
  const std::size_t before = chosen.size();
  for (const ClosingRow& c : candidates) {
    if (std::binary_search(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(before), c.row)) continue;
    const double pushed = rows.relative(c.row, x)[0];
    // Rows that others push to within round-off of their limit stay out; what is not a number is left to the solver.
    const bool is_open = c.w[0] + pushed >= -1e-13 * (std::abs(c.w[0]) + std::abs(pushed));
    if (!is_open) chosen.push_back(c.row);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen.size() > before;
}

/// Relative errors of the motions; see close_rows.
constexpr double kWantedError = 1e-12, kAcceptedError = 1e-5;

std::string failure(const ContactGeometry& contact, const ConstraintRows& rows, const Delassus& W,
                    const ConeResult& result) {
  const std::string where = contact.describe(rows, W.rows[result.worst]);
  if (std::isinf(result.error))
    return fmt::format(
        "the contact forces are not finite: {}. Shorten the step (time.step or time.safety), and look at the "
        "velocities and the stiffness there",
        where);
  return fmt::format(
      "no contact forces were found for {} rows that close together (error {:.2g} of their motion, worst: {}). Where "
      "nothing there can give way (nodes held on both sides of a gap that closes) a support must go; else shorten the "
      "step (time.step or time.safety), take less friction, or scheme.kind = \"central_differences\" (penalty)",
      W.size(), result.error, where);
}

}  // namespace

std::string close_rows(const ContactGeometry& contact, const std::vector<ClosingRow>& candidates,
                       std::span<const RowHistory> history, const ContactOperator& contact_operator,
                       ContactResponse& response, std::span<double> x) {
  const ConstraintRows& rows = *response.rows;
  std::vector<std::size_t> chosen;
  std::fill(x.begin(), x.end(), 0.0);
  while (mark_closing(candidates, rows, x, chosen)) {
    const Delassus W = contact_operator.delassus(rows, chosen);
    chosen = W.rows;
    std::vector<Vec3> b, r;
    std::vector<Admissible> sets;
    double round_off = 0.0;
    auto candidate = candidates.begin();
    for (const std::size_t row : chosen) {
      candidate = std::find_if(candidate, candidates.end(), [row](const ClosingRow& c) { return c.row == row; });
      b.push_back(candidate->w);
      round_off = std::max(round_off, candidate->round_off);
      sets.push_back(admissible(rows.law[row]));
      r.push_back(rows.to_frame(row, history[static_cast<std::size_t>(rows.slot[row])].multiplier));
    }
    const ConeResult result = solve_cone(W, b, sets, r, kWantedError, kAcceptedError, round_off);
    if (!result.converged) return failure(contact, rows, W, result);
    for (std::size_t k = 0; k < chosen.size(); ++k) set_multiplier(chosen[k], r[k], response);
    std::fill(x.begin(), x.end(), 0.0);
    response.add_force(x);
    contact_operator.inverse(x);
  }
  return {};
}

void open_response(std::shared_ptr<const ConstraintRows> rows, std::size_t slots, ContactResponse& response) {
  response.rows = std::move(rows);
  const std::size_t n = response.rows->size();
  response.force.assign(n, Vec3{});
  response.damper.assign(n, 0.0);
  response.status.assign(n, RowStatus::open);
  response.history.assign(slots, {});
  response.stored = response.slip_work = 0.0;
}

}  // namespace carom
