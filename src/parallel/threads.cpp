#include "parallel/threads.hpp"

namespace carom {

double dot(std::span<const double> a, std::span<const double> b) {
  return parallel_sum(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

}  // namespace carom
