#include "march/shared_state.hpp"

#include "solid/point_history.hpp"

namespace carom {

void complete(const Solid& solid, const Holding* nodes, State& state) {
  if (nodes == nullptr || nodes->is_whole()) return;
  for (std::vector<double>* values : {&state.q, &state.v, &state.a, &state.forces.internal})
    if (values->size() == 3 * nodes->size()) nodes->complete(*values);  // a step may have ended before it had them
  complete_history(solid, state.points);
}

void SharedState::complete(std::span<const Index> nodes) const {
  if (nodes_ == nullptr) return;
  for (std::vector<double>* values : {&state_->q, &state_->v, &state_->a}) nodes_->complete(*values, nodes);
}

void SharedState::complete_displacements(std::span<const Index> nodes) const {
  if (nodes_ != nullptr) nodes_->complete(state_->q, nodes);
}

}  // namespace carom
