// Work that may crash, hang or ask for too much memory, done in a child process.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace carom {

/// What the child wrote, and how it ended.
struct IsolatedResult {
  std::string output;
  std::string failure;  ///< "" after a good end, else e.g. "it was stopped by the signal 'Segmentation fault'"
};

struct IsolationLimits {
  std::size_t memory_bytes;  ///< that the child may take beyond what the process has already
  std::size_t output_bytes;
  unsigned cpu_seconds;
};

/// Forks, runs work(fd) in the child, which writes its result to the file descriptor fd, and collects it. The child
/// shares nothing with the caller but a copy of its memory: whatever it does, the caller goes on.
/// An exception that leaves work counts as a failure. Open files and exit handlers of the caller are not touched.
IsolatedResult run_isolated(const IsolationLimits& limits, const std::function<void(int fd)>& work);

/// Writes all bytes to fd; throws std::system_error when it does not take them.
void write_all(int fd, const void* data, std::size_t size);

}  // namespace carom
