// The loop of bench/peak.cpp, compiled once per instruction set: CAROM_PEAK names it, CAROM_LANES is the width of its
// registers.
#include <cstddef>

#include "peak.hpp"

namespace carom {

double CAROM_PEAK(std::size_t rounds, double factor) {
  using Pack = double __attribute__((vector_size(8 * CAROM_LANES)));
  Pack sum[peak_chains];
  for (int k = 0; k < peak_chains; ++k) sum[k] = Pack{} + static_cast<double>(k);
  for (std::size_t round = 0; round < rounds; ++round)
#pragma GCC unroll 16
    for (int k = 0; k < peak_chains; ++k) sum[k] = sum[k] * factor + 1.0;
  for (int k = 1; k < peak_chains; ++k) sum[0] += sum[k];
  return sum[0][0];
}

}  // namespace carom
