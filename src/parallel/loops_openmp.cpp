#include <omp.h>

#include <algorithm>

#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {

int set_threads(int count) {
  omp_set_dynamic(0);
  omp_set_num_threads(count > 0 ? count : std::max(1, omp_get_num_procs() / ranks().on_same_cores()));
  // One thread is one thread for libraries too, which ask for their own number (CHOLMOD: four).
  omp_set_max_active_levels(thread_count() > 1 ? 1 : 0);
  return thread_count();
}

int thread_count() {
  return omp_get_max_threads();
}

ThreadScope::ThreadScope(int count)
    : count_(omp_get_max_threads()), dynamic_(omp_get_dynamic()), levels_(omp_get_max_active_levels()) {
  set_threads(count);
}

ThreadScope::~ThreadScope() {
  omp_set_num_threads(count_);
  omp_set_dynamic(dynamic_);
  omp_set_max_active_levels(levels_);
}

void release_threads() {
  omp_pause_resource_all(omp_pause_soft);
}

void run_parts(std::size_t count, LoopPart part, const void* body) {
  const auto parts = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < parts; ++k) part(body, static_cast<std::size_t>(k));
}

}  // namespace carom
