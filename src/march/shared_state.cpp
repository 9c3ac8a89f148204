#include "march/shared_state.hpp"

#include <vector>

#include "solid/point_history.hpp"

namespace carom {
namespace {

/// The vectors of a state that ranks share out.
std::vector<std::vector<double>*> shared_values(const Holding& nodes, State& state) {
  std::vector<std::vector<double>*> all{&state.q, &state.v, &state.a, &state.forces.internal,
                                        &state.forces.external.value};
  // A step may have ended before it had them, and there may be no load.
  std::erase_if(all, [&](const std::vector<double>* values) { return values->size() != 3 * nodes.size(); });
  return all;
}

}  // namespace

void complete(const Solid& solid, const Holding* nodes, State& state) {
  if (nodes == nullptr || nodes->is_whole()) return;
  for (std::vector<double>* values : shared_values(*nodes, state)) nodes->complete(*values);
  complete_history(solid, state.points);
}

void SharedState::complete(std::span<const Index> nodes) const {
  if (nodes_ == nullptr) return;
  for (std::vector<double>* values : {&state_->q, &state_->v, &state_->a}) nodes_->complete(*values, nodes);
}

void SharedState::complete_displacements(std::span<const Index> nodes) const {
  if (nodes_ != nullptr) nodes_->complete(state_->q, nodes);
}

void SharedState::collect() const {
  if (!is_partial()) return;
  for (std::vector<double>* values : shared_values(*nodes_, *state_)) nodes_->collect(*values);
  collect_history(*solid_, state_->points);
}

void SharedState::collect_velocities() const {
  if (is_partial()) nodes_->collect(state_->v);
}

void SharedState::release() const {
  if (!is_partial()) return;
  for (std::vector<double>* values : shared_values(*nodes_, *state_)) {
    nodes_->release(*values);
    nodes_->spoil(*values);
  }
  release_history(*solid_, state_->points);
}

}  // namespace carom
