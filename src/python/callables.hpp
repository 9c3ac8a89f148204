// Functions of time that are Python's.
#pragma once

#include <exception>
#include <functional>
#include <string>

#include "math/called_function.hpp"
#include "model/own_contact_law.hpp"
#include "python/bindings.hpp"

namespace carom::python {

/// The callable as a function of C++, which takes the lock of the interpreter for every call. What it raises, and what
/// is no number, comes out as a CallFailure; Ctrl-C is put off to the end of the step. `name`: for messages.
std::function<double(double)> called(const std::string& name, py::object callable);

/// Likewise a law of friction, which is called with arrays over the rows.
FrictionLaw called_friction(const std::string& contact, py::object callable);

/// What `make` makes; what a callable has raised comes out as it was raised.
template <class Make>
auto with_errors_of_callables(const Make& make) {
  try {
    return make();
  } catch (const CallFailure& failure) {
    std::rethrow_exception(failure.error);
  }
}

/// Has Ctrl-C been put off since this was asked last?
bool take_interrupt();

}  // namespace carom::python
