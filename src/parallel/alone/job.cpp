// A job of one process.
#include "parallel/job.hpp"

namespace carom {

int run_job(int /*argc*/, char** /*argv*/, const std::function<JobEnd()>& body,
            const std::function<void(std::string)>& tell) {
  JobEnd end = body();
  if (!end.error.empty()) tell(std::move(end.error));
  return end.code;
}

Ranks& job_ranks() {
  return ranks();
}

}  // namespace carom
