// Chains of dependent multiplications and additions, as many as keep every unit busy.
#pragma once

#include <cstddef>

namespace carom {

inline constexpr int peak_chains = 12;  ///< at least latency times units; with factor and addend within 16 registers

/// x <- factor x + 1 in each lane of each chain, `rounds` times; fused where the instruction set can.
double peak_v2(std::size_t rounds, double factor);
double peak_v3(std::size_t rounds, double factor);
double peak_v4(std::size_t rounds, double factor);

}  // namespace carom
