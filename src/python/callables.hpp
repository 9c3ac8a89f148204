// Functions of time that are Python's.
#pragma once

#include <functional>
#include <string>

#include "python/bindings.hpp"

namespace carom::python {

/// The callable as a function of C++, which takes the lock of the interpreter for every call. What it raises, and what
/// is no number, comes out as a CallFailure; Ctrl-C is put off to the end of the step. `name`: for messages.
std::function<double(double)> called(const std::string& name, py::object callable);

/// Has Ctrl-C been put off since this was asked last?
bool take_interrupt();

}  // namespace carom::python
