#include "mesh/isolated_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace carom {

namespace {

/// Address space in use, in bytes; 0 when the system does not tell.
std::size_t address_space() {
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  unsigned long pages = 0;
  const int read = std::fscanf(file, "%lu", &pages);
  std::fclose(file);
  return read == 1 ? pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

void limit(int resource, rlim_t value) {
  rlimit current{};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &current) != 0) return;
  if (current.rlim_max != RLIM_INFINITY && value > current.rlim_max) value = current.rlim_max;
  current.rlim_cur = value;
  setrlimit(static_cast<__rlimit_resource_t>(resource), &current);
}

/// Limits, default signals (a crash is to end the child quietly) and no output on the terminal.
void confine(const IsolationLimits& limits) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTERM, SIGINT, SIGXCPU, SIGALRM, SIGPIPE})
    std::signal(signal, SIG_DFL);
  const std::size_t used = address_space();
  if (used > 0) limit(RLIMIT_AS, used + limits.memory_bytes);
  limit(RLIMIT_CPU, limits.cpu_seconds);
  limit(RLIMIT_CORE, 0);
  const int null = open("/dev/null", O_RDWR);
  if (null < 0) return;
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, fd);
}

[[noreturn]] void run_child(const IsolationLimits& limits, const std::function<void(int)>& work, int fd) {
  confine(limits);
  try {
    work(fd);
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

/// Reads until the other end closes; false when more than `most` bytes come.
bool collect(int fd, std::size_t most, std::string& output) {
  std::string buffer(1 << 16, '\0');
  for (;;) {
    const ssize_t count = read(fd, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0;
    if (output.size() + static_cast<std::size_t>(count) > most) return false;
    output.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

std::string describe(int status, const IsolationLimits& limits) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return fmt::format("it did not end within {} s", limits.cpu_seconds);
  if (WIFSIGNALED(status)) return fmt::format("it was stopped by the signal '{}'", strsignal(WTERMSIG(status)));
  return "it ended early";
}

}  // namespace

void write_all(int fd, const void* data, std::size_t size) {
  const char* bytes = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t count = write(fd, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw std::system_error(errno, std::generic_category(), "write");
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
}

IsolatedResult run_isolated(const IsolationLimits& limits, const std::function<void(int fd)>& work) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) return {"", fmt::format("no pipe: {}", std::strerror(errno))};
  const pid_t child = fork();
  if (child < 0) {
    const std::string reason = std::strerror(errno);
    close(pipe_ends[0]);
    close(pipe_ends[1]);
    return {"", "no child process: " + reason};
  }
  if (child == 0) {
    close(pipe_ends[0]);
    run_child(limits, work, pipe_ends[1]);
  }
  close(pipe_ends[1]);
  IsolatedResult result;
  const bool whole = collect(pipe_ends[0], limits.output_bytes, result.output);
  close(pipe_ends[0]);
  if (!whole) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.failure = whole ? describe(status, limits) : "it holds more data than its size allows";
  return result;
}

}  // namespace carom
