// What the writers and readers of HDF5 files share.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

#include "base/hdf5_lock.hpp"

namespace carom {

/// A descriptor or a handle of HDF5 that is given back.
template <class T, auto close>
class Handle {
 public:
  explicit Handle(T value) : value_(value) {}
  ~Handle() {
    if (value_ >= 0) close(value_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator T() const { return value_; }  // NOLINT(google-explicit-constructor): stands for the number itself
  /// What closing says.
  auto release() { return close(std::exchange(value_, T{-1})); }

 private:
  T value_;
};

/// HDF5 keeps its complaints to itself, since every call is looked at, and serves this thread alone.
class QuietHdf5 {
 public:
  QuietHdf5() {
    H5Eget_auto2(H5E_DEFAULT, &report_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, report_, data_); }
  QuietHdf5(const QuietHdf5&) = delete;
  QuietHdf5& operator=(const QuietHdf5&) = delete;

 private:
  std::lock_guard<std::recursive_mutex> alone_{hdf5_lock()};
  H5E_auto2_t report_ = nullptr;
  void* data_ = nullptr;
};

namespace hdf5 {

using File = Handle<hid_t, H5Fclose>;
using Group = Handle<hid_t, H5Gclose>;
using Object = Handle<hid_t, H5Oclose>;
using Plist = Handle<hid_t, H5Pclose>;
using Space = Handle<hid_t, H5Sclose>;
using Set = Handle<hid_t, H5Dclose>;
using Attribute = Handle<hid_t, H5Aclose>;
using Type = Handle<hid_t, H5Tclose>;

/// Of files in the folder of results. Locks of the file system are not needed, since that folder is locked, and not
/// there on some.
inline Plist file_access() {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
#if H5_VERSION_GE(1, 10, 7)
  H5Pset_file_locking(access, false, true);
#endif
  return Plist(access);
}

}  // namespace hdf5
}  // namespace carom
