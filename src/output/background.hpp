// Work that is done beside the computation.
#pragma once

#include <future>
#include <utility>

namespace carom {

/// One job at a time on a thread of its own: the next waits for the one before. What a job throws comes out of the call
/// that waits for it; nothing does of the destructor, which waits, too.
class Background {
 public:
  template <class Job>
  void start(Job job) {
    finish();
    running_ = std::async(std::launch::async, std::move(job));
  }
  /// Returns when nothing is left to do.
  void finish() {
    if (running_.valid()) running_.get();
  }

 private:
  std::future<void> running_;
};

}  // namespace carom
