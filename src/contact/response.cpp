#include "contact/response.hpp"

namespace carom {

void ContactResponse::add_force(std::span<double> f) const {
  for (std::size_t r = 0; r < force.size(); ++r) {
    if (status[r] != RowStatus::open) rows->scatter(r, force[r], f);
  }
}

void take_history(const ContactResponse& response, State& state) {
  state.contact = response.history;
  const ConstraintRows& rows = *response.rows;
  for (std::size_t r = 0; r < rows.size(); ++r)
    if (rows.gap_at(r, state.q) < 0.0) state.contact[static_cast<std::size_t>(rows.slot[r])].facet = rows.facet[r];
}

}  // namespace carom
