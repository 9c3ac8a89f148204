// One thread at a time in HDF5.
#pragma once

#include <mutex>

namespace carom {

/// Debian's HDF5 is not built for several threads: whoever calls it holds this lock from the first call to the last.
inline std::recursive_mutex& hdf5_lock() {
  static std::recursive_mutex lock;
  return lock;
}

}  // namespace carom
