// One ordering by METIS at a time.
#pragma once

#include <mutex>

namespace carom {

/// METIS draws from random numbers that the whole process shares, from the same seed in each call: two calls at the
/// same time would give orderings that depend on which is faster. Whoever calls METIS holds this.
inline std::mutex metis_turn;

}  // namespace carom
