// Cells that a step has turned inside out.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "build/simulation.hpp"

namespace carom {

/// "cell 12 of part \"rubber\" at (0.1, 0, 2) has turned inside out: ..." with a remedy, for the first finite-strain
/// cell that is there with det F <= 0 at a quadrature point at displacement u; "" where there is none.
std::string inside_out(const Simulation& simulation, std::span<const double> u,
                       std::span<const std::uint8_t> alive = {});

}  // namespace carom
