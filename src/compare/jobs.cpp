#include "compare/jobs.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <system_error>
#include <thread>

#include "base/errors.hpp"

namespace carom::compare {

namespace {

/// Output of the child goes to the file, its input is empty.
class Redirection {
 public:
  explicit Redirection(const std::string& log) {
    const int fd = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (fd < 0) throw OutputError(log, std::generic_category().message(errno));
    close(fd);
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_APPEND, 0);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~Redirection() { posix_spawn_file_actions_destroy(&actions_); }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

pid_t start(const Job& job) {
  std::vector<char*> arguments;
  for (const std::string& argument : job.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const Redirection redirection(job.log);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, arguments[0], redirection.get(), nullptr, arguments.data(), environ);
  if (error != 0) throw std::system_error(error, std::generic_category(), "cannot start " + job.arguments[0]);
  return pid;
}

using Running = std::map<pid_t, std::size_t>;  ///< process to position of its job

void end_all(const Running& running) {
  for (const auto& entry : running) kill(entry.first, SIGTERM);
}

}  // namespace

ExitCodes run_jobs(const std::vector<Job>& jobs, int at_once, const std::atomic<bool>& stop,
                   const std::function<void(std::size_t, int)>& finished) {
  ExitCodes codes(jobs.size(), -1);
  Running running;
  std::size_t next = 0;
  bool stopped = false;
  while (!running.empty() || (next < jobs.size() && !stop.load())) {
    while (next < jobs.size() && !stop.load() && running.size() < static_cast<std::size_t>(at_once)) {
      try {
        running.emplace(start(jobs[next]), next);
      } catch (...) {
        end_all(running);
        for (const auto& entry : running) waitpid(entry.first, nullptr, 0);
        throw;
      }
      ++next;
    }
    if (stop.load() && !stopped) {
      end_all(running);
      stopped = true;
    }
    for (auto entry = running.begin(); entry != running.end();) {
      int status = 0;
      if (waitpid(entry->first, &status, WNOHANG) == 0) {
        ++entry;
        continue;
      }
      const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      codes[entry->second] = code;
      finished(entry->second, code);
      entry = running.erase(entry);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return codes;
}

}  // namespace carom::compare
