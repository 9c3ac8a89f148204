// What a run says that cannot go on: where, and what helps.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "build/simulation.hpp"

namespace carom {

/// The node that moves fastest (or the first whose motion is not finite) and a solid cell that holds it.
std::string worst_place(const System& system, const State& state);

/// The keys that help where a run makes energy.
std::string energy_remedy(const Stage& stage);

/// Why the scheme of a stage makes energy on plain multipliers (touch_rebound), and what to choose instead; "" where
/// it does not.
std::string touch_remedy(const Stage& stage);

/// Why a step has failed that has come to displacement u (empty: to none): the cell that has turned inside out on the
/// way, or that has folded.
std::string with_cell(const std::string& failure, const Simulation& simulation, std::span<const double> u,
                      std::span<const std::uint8_t> alive);

/// What is wrong with a state that the run cannot go on from, and what helps: the cell that has folded, or the worst
/// place.
std::string place_and_remedy(const Simulation& simulation, const Stage& stage, const State& state);

}  // namespace carom
