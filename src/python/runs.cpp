// Runs: the class that carom.Run derives from.
#include "python/python_run.hpp"

namespace carom::python {

void bind_runs(py::module_& module) {
  py::class_<Snapshot, std::shared_ptr<Snapshot>>(
      module, "Snapshot", "A run as it was at an instant, in memory: what Run.save gives and Run.restore takes.")
      .def_property_readonly(
          "time", [](const Snapshot& s) { return s.origin.time; }, "Time of the instant, in the case's unit.")
      .def_property_readonly(
          "steps", [](const Snapshot& s) { return s.origin.step; }, "Number of steps made until then.")
      .def_property_readonly(
          "nbytes", [](const Snapshot& s) { return s.values.bytes(); }, "Memory that it takes, bytes.")
      .def("__repr__",
           [](const Snapshot& s) { return "<carom.Snapshot of step " + std::to_string(s.origin.step) + ">"; });
  py::class_<PythonRun, std::shared_ptr<PythonRun>>(module, "RunBase", "What carom.Run is made on.")
      .def(py::init<const PreparedCase&, const std::string&, int>(), py::arg("case"), py::arg("folder"),
           py::arg("threads"))
      .def(py::init<const std::string&, std::optional<double>, int>(), py::arg("folder"), py::arg("end"),
           py::arg("threads"))
      .def("_advance", &PythonRun::advance, py::arg("time"), py::arg("count"))
      .def("_observe", &PythonRun::observe, py::arg("every"))
      .def("_forget", &PythonRun::forget, py::arg("every"))
      .def("_close", &PythonRun::close, py::arg("folder"))
      .def("_table", &PythonRun::table, py::arg("which"))
      .def("_contact", &PythonRun::contact)
      .def("_fields", &PythonRun::fields)
      .def("_field", &PythonRun::field, py::arg("name"))
      .def("_cells", &PythonRun::cells)
      .def("_units", &PythonRun::units)
      .def("_contact_names", &PythonRun::contact_names)
      .def("_contact_at_nodes", &PythonRun::contact_at_nodes, py::arg("name"))
      .def("_mesh", [](const PythonRun& run) { return std::const_pointer_cast<Mesh>(run.mesh()); })
      .def(
          "save", [](PythonRun& run) { return std::const_pointer_cast<Snapshot>(run.save()); },
          "The run as it is now, with its curves so far; see restore.")
      .def(
          "_restore", [](PythonRun& run, const Snapshot& snapshot) { run.restore(snapshot); }, py::arg("snapshot"))
      .def_property_readonly("time", &PythonRun::time, "Time reached, in the case's unit.")
      .def_property_readonly("steps", &PythonRun::steps, "Number of steps made so far.")
      .def_property_readonly("end", &PythonRun::end, "Time at which the run ends, in the case's unit.")
      .def_property_readonly("dt", &PythonRun::last_dt, "Length of the last step, in the case's unit; 0 before it.")
      .def_property_readonly("at_end", &PythonRun::is_over, "Whether no step is left to make.")
      .def_property_readonly("finished", &PythonRun::is_closed, "Whether finish or stop has been called.")
      .def_property_readonly("warnings", &PythonRun::warnings, "What is doubtful about the case, one text each.")
      .def_property_readonly("notes", &PythonRun::notes, "What has been chosen or mended, one text each.")
      .def_property_readonly("folder", &PythonRun::folder, "The results folder, '' where there is none.")
      .def_property_readonly(
          "displacement", [](PythonRun& run) { return run.values(0); },
          "Displacements of the nodes, (n, 3), in the case's unit of length: a read-only view, without a copy.\n\n"
          "An array shows the instant at which it was asked for: the run copies what somebody still holds when it\n"
          "steps on, so ask anew for new values, and let go of old ones.")
      .def_property_readonly(
          "velocity", [](PythonRun& run) { return run.values(1); },
          "Velocities of the nodes, (n, 3), in the case's unit; a view as displacement is.")
      .def_property_readonly(
          "acceleration", [](PythonRun& run) { return run.values(2); },
          "Accelerations of the nodes, (n, 3), in the case's unit; a view as displacement is.");
}

}  // namespace carom::python
