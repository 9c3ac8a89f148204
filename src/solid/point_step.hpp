// What an evaluation of the solids needs beside the displacement.
#pragma once

#include <cstdint>
#include <span>

#include "kernels/energies.hpp"
#include "parallel/holding.hpp"

namespace carom {

/// The step that ends at the displacement: its length, for laws with rates, and the history of the quadrature points at
/// its beginning (initial_history). Empty: the points at rest. is_over: the history is that at its end, and the
/// forces and stresses are those that the step has ended with. is_static: a step of statics, in which artificial
/// viscosity rests. alive: by solid cell, 0 where it has gone (Topology::alive; empty: all are there). What has gone
/// takes no part, and its history is that of rest. nodes: what of
/// the displacement is right and what of the forces is wanted, on several ranks; null: all.
struct PointStep {
  double dt = 0.0;
  std::span<const double> history;
  bool is_over = false;
  bool is_static = false;
  std::span<const std::uint8_t> alive{};
  const Holding* nodes = nullptr;
};

}  // namespace carom
