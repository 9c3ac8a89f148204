#include "contact/response.hpp"

namespace carom {

void ContactResponse::add_force(std::span<double> f) const {
  for (std::size_t r = 0; r < force.size(); ++r) {
    if (status[r] != RowStatus::open) rows->scatter(r, force[r], f);
  }
}

}  // namespace carom
