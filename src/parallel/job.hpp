// The processes that a run is started as: one, or as many as mpirun starts. A program links one of the two.
#pragma once

#include <functional>
#include <string>

#include "parallel/ranks.hpp"

namespace carom {

/// What a process has come to.
struct JobEnd {
  int code = 0;       ///< of its exit
  std::string error;  ///< why, where nobody has said it yet
};

/// Runs body() in each process of the job and returns the exit code of this one. tell() says an error: once for one
/// that all processes have, else in the process that has it, with its number; the others are ended then.
int run_job(int argc, char** argv, const std::function<JobEnd()>& body, const std::function<void(std::string)>& tell);

/// The processes of the job as ranks; between the beginning and the end of run_job.
Ranks& job_ranks();

}  // namespace carom
