#include "parallel/threads.hpp"

#include <omp.h>

namespace carom {

int set_threads(int count) {
  omp_set_dynamic(0);
  omp_set_num_threads(count > 0 ? count : omp_get_num_procs());
  return thread_count();
}

int thread_count() {
  return omp_get_max_threads();
}

double dot(std::span<const double> a, std::span<const double> b) {
  return parallel_sum(a.size(), [&](std::size_t i) { return a[i] * b[i]; });
}

}  // namespace carom
