// What the quadrature points of the bodies remember: their history variables, and what beside cells does.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solid/solid.hpp"

namespace carom {

/// How many numbers: their order is that of the kernels and depends on the instruction set. None for elastic bodies.
std::size_t history_size(const Solid& solid);
/// Those of bodies at rest.
std::vector<double> initial_history(const Solid& solid);
/// The same numbers in an order that depends on the mesh and the laws alone, and back: cell by cell, part after part.
/// Throws std::invalid_argument where they are not as many as the bodies remember.
std::vector<double> history_by_cell(const Solid& solid, std::span<const double> history);
std::vector<double> history_of_lanes(const Solid& solid, std::span<const double> by_cell);
/// Every rank gives all the history of its cells, after steps in which it has stayed with the ranks (PointStep::nodes).
void complete_history(const Solid& solid, std::span<double> history);
/// They give it to the first rank alone.
void collect_history(const Solid& solid, std::span<double> history);
/// Gives the memory back of the history of cells that this rank does not compute.
void release_history(const Solid& solid, std::span<double> history);
/// Zeroes what the points of the cells that have gone (alive: 0, by cell) remember.
void forget_gone(const Solid& solid, std::span<const std::uint8_t> alive, std::span<double> history);

}  // namespace carom
