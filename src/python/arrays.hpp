// Arrays of numpy that look at memory of Carom.
#pragma once

#include <pybind11/numpy.h>

#include <memory>
#include <vector>

#include "python/bindings.hpp"

namespace carom::python {

/// A read-only array over `data`, which `owner` holds: it is let go of with the last array that looks at it.
template <class T, class Owner>
py::array view(const T* data, std::vector<py::ssize_t> shape, std::shared_ptr<Owner> owner) {
  auto* held = new std::shared_ptr<Owner>(std::move(owner));
  const py::capsule base(held, [](void* p) { delete static_cast<std::shared_ptr<Owner>*>(p); });
  py::array array(py::dtype::of<T>(), std::move(shape), data, base);
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace carom::python
