// The computer, from inside of a process that is somebody else's.
#pragma once

#include <mutex>

#include "linalg/process_environment.hpp"
#include "parallel/threads.hpp"

namespace carom::python {

/// Held while anything is computed: the libraries behind (MUMPS, METIS, HDF5) know one caller at a time, so runs in
/// several threads of Python take turns. Threads and BLAS are as the process had them before and after. To be made
/// without the lock of the interpreter.
class Computing {
 public:
  explicit Computing(int threads) : lock_(turn()), threads_(threads) {}

 private:
  /// Recursive: a function of time may step another run.
  static std::recursive_mutex& turn() {
    static std::recursive_mutex mutex;
    return mutex;
  }

  std::lock_guard<std::recursive_mutex> lock_;
  ThreadScope threads_;
  BlasScope blas_;
};

}  // namespace carom::python
