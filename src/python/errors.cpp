// Errors of Carom as exceptions of Python.
#include "base/errors.hpp"

#include "math/called_function.hpp"
#include "output/checkpoint_file.hpp"
#include "python/bindings.hpp"
#include "python/python_run.hpp"

namespace carom::python {

namespace {

/// Sets an exception of the class carom.errors.<name> with these attributes.
template <class... Attributes>
void raise(const char* name, const char* message, const Attributes&... attributes) {
  const py::object type = py::module_::import("carom.errors").attr(name);
  const py::object error = type(message);
  (py::setattr(error, attributes.first, py::cast(attributes.second)), ...);
  PyErr_SetObject(type.ptr(), error.ptr());
}

void translate(std::exception_ptr thrown) {
  const auto named = [](const char* name, auto value) { return std::pair(name, std::move(value)); };
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const CaseError& e) {
    raise("CaseError", e.what(), named("file", e.where().file), named("line", e.where().line),
          named("column", e.where().column), named("key", e.key()), named("found", e.found()),
          named("expected", e.expected()), named("suggestion", e.suggestion()));
  } catch (const RunError& e) {
    raise("RunError", e.what(), named("step", e.step()), named("time", e.time()));
  } catch (const FailedRun& e) {
    raise("RunError", e.what(), named("step", e.step), named("time", e.time));
  } catch (const OutputError& e) {
    raise("OutputError", e.what(), named("path", e.path()));
  } catch (const CheckpointError& e) {
    raise("CheckpointError", e.what());
  }
}

}  // namespace

void bind_errors(py::module_& /*module*/) {
  py::register_exception_translator(translate);
}

}  // namespace carom::python
