#include <algorithm>
#include <thread>
#include <vector>

#include "parallel/threads.hpp"

namespace carom {

namespace {

int chosen_threads = static_cast<int>(std::max(2U, std::thread::hardware_concurrency()));
thread_local bool is_inside = false;  ///< of a loop: loops within run on the thread that meets them

}  // namespace

int set_threads(int count) {
  chosen_threads = count > 0 ? count : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return chosen_threads;
}

int thread_count() {
  return chosen_threads;
}

ThreadScope::ThreadScope(int count) : count_(chosen_threads) {
  set_threads(count);
}

ThreadScope::~ThreadScope() {
  chosen_threads = count_;
}

void release_threads() {}

/// Threads of its own for every loop: for checks, not for speed.
void run_parts(std::size_t count, LoopPart part, const void* body) {
  const std::size_t threads = is_inside ? 1 : std::min(count, static_cast<std::size_t>(chosen_threads));
  const auto share = [&](std::size_t t) {
    is_inside = threads > 1;
    for (std::size_t k = t * count / threads; k < (t + 1) * count / threads; ++k) part(body, k);
  };
  if (threads <= 1) {
    for (std::size_t k = 0; k < count; ++k) part(body, k);
    return;
  }
  std::vector<std::jthread> others;
  for (std::size_t t = 1; t < threads; ++t) others.emplace_back(share, t);
  share(0);
  is_inside = false;
}

}  // namespace carom
