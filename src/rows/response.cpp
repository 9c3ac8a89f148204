#include "rows/response.hpp"

#include <algorithm>
#include <tuple>

namespace carom {

void ContactResponse::add_force(NodeForces& f) const {
  for (std::size_t r = 0; r < force.size(); ++r)
    if (status[r] != RowStatus::open)
      rows->for_each_share(r, force[r], [&f](Index node, const Vec3& share) { f.add(node, share); });
}

void ContactResponse::add_force(std::span<double> f) const {
  for (std::size_t r = 0; r < force.size(); ++r)
    if (status[r] != RowStatus::open) rows->scatter(r, force[r], f);
}

bool operator==(const ContactResponse& a, const ContactResponse& b) {
  const bool have_rows = a.rows && b.rows;
  const auto values = [](const ContactResponse& r) {
    return std::tie(r.force, r.damper, r.status, r.history, r.stored, r.slip_work);
  };
  return (a.rows == b.rows || (have_rows && *a.rows == *b.rows)) && values(a) == values(b);
}

void mark_behind(const ConstraintRows& rows, std::span<const double> u, std::vector<RowHistory>& history) {
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (!is_bond(rows.law[r]) && (rows.gap_at(r, u) < 0.0 || rows.has_entered[r]))
      history[static_cast<std::size_t>(rows.slot[r])].facet = rows.facet[r];
}

void take_history(const ContactResponse& response, std::span<const double> u, std::vector<RowHistory>& history) {
  history = response.history;
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows.offset[r] < 0.0)
      history[static_cast<std::size_t>(rows.slot[r])].offset =
          std::min(0.0, rows.offset[r] + std::max(0.0, rows.gap_at(r, u)));
  mark_behind(rows, u, history);
}

}  // namespace carom
