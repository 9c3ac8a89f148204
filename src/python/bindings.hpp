// What the files of the extension share.
#pragma once

#include <pybind11/pybind11.h>

namespace carom::python {

namespace py = pybind11;

// Each adds its part to the module.
void bind_errors(py::module_& module);
void bind_cases(py::module_& module);
void bind_meshes(py::module_& module);
void bind_runs(py::module_& module);
void bind_frames(py::module_& module);
void bind_commands(py::module_& module);
void bind_pages(py::module_& module);

}  // namespace carom::python
