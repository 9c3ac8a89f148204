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

}  // namespace carom
