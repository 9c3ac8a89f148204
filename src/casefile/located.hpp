// A value that knows where it was written.
#pragma once

#include "base/errors.hpp"

namespace carom {

/// A value and the place where the user wrote it (or where its section begins, when it is a default).
template <class T>
struct Located {
  T value{};
  Location where;

  const T& operator*() const { return value; }
  const T* operator->() const { return &value; }
};

}  // namespace carom
