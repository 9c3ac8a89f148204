// What a rank knows of the state of a run that several ranks make together.
#pragma once

#include <span>

#include "parallel/holding.hpp"
#include "solid/solid.hpp"
#include "state/state.hpp"

namespace carom {

/// Gives all ranks all of a state whose nodes they have shared out (nodes: Scheme::shared_nodes; null: they have not).
/// All ranks call it.
void complete(const Solid& solid, const Holding* nodes, State& state);

/// The state of a march, for those that look at it: what they need beside the nodes that all ranks hold (of contact,
/// supports and loads) they ask for first. All ranks ask for the same.
class SharedState {
 public:
  SharedState(const Solid& solid, const Holding* nodes, State& state) : solid_(&solid), nodes_(nodes), state_(&state) {}

  /// Is there anything that a rank does not know?
  bool is_partial() const { return nodes_ != nullptr && !nodes_->is_whole(); }
  /// All of it, on all ranks.
  void complete() const { carom::complete(*solid_, nodes_, *state_); }
  /// Displacements, velocities and accelerations of some nodes, on all ranks.
  void complete(std::span<const Index> nodes) const;
  /// Displacements alone.
  void complete_displacements(std::span<const Index> nodes) const;
  /// All of it, on the first rank alone, which writes the results.
  void collect() const;
  /// Velocities alone.
  void collect_velocities() const;
  /// Gives the memory back of what this rank does not hold.
  void release() const;

 private:
  const Solid* solid_;
  const Holding* nodes_;
  State* state_;
};

}  // namespace carom
