// One run at a time in a results folder.
#pragma once

#include <string>

namespace carom {

/// Makes the folder (and its parents) if it is not there and holds it (flock) for the life of the object; the system
/// lets go of it when the process ends in any way, so that nothing is left behind by a crash. Throws OutputError when
/// another process holds it. On file systems without locks there is none.
class ResultsLock {
 public:
  explicit ResultsLock(const std::string& folder);
  ~ResultsLock();
  ResultsLock(const ResultsLock&) = delete;
  ResultsLock& operator=(const ResultsLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Does a process hold the folder? False where that cannot be told.
bool is_held(const std::string& folder);

}  // namespace carom
