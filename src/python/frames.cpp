// Frames of a results folder, and what fields are.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstring>

#include "output/quantities.hpp"
#include "output/units.hpp"
#include "python/bindings.hpp"
#include "python/compute.hpp"
#include "view/frame_file.hpp"

namespace carom::python {

namespace {

py::dtype type_of(NumberType type) {
  switch (type) {
    case NumberType::float64:
      return py::dtype::of<double>();
    case NumberType::float32:
      return py::dtype::of<float>();
    case NumberType::int32:
      return py::dtype::of<std::int32_t>();
    case NumberType::int64:
      return py::dtype::of<std::int64_t>();
    case NumberType::uint8:
      return py::dtype::of<std::uint8_t>();
  }
  return {};
}

/// The values of an array, as they are stored.
py::array values_of(const StoredArray& stored) {
  std::span<const std::byte> bytes;
  {
    const py::gil_scoped_release release;
    const Computing computing(1);
    bytes = stored.bytes();
  }
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(stored.entries())};
  if (stored.components > 1) shape.push_back(stored.components);
  py::array out(type_of(stored.type), shape);
  std::memcpy(out.mutable_data(), bytes.data(), bytes.size());
  return out;
}

py::array array_of(const FrameFile& frame, const std::string& name) {
  for (const StoredArray* found : {frame.point_field(name), frame.cell_field(name)})
    if (found != nullptr) return values_of(StoredArray(*found));  // its bytes go with it
  throw py::key_error(name);
}

std::map<std::string, bool> arrays_of(const FrameFile& frame) {
  std::map<std::string, bool> at_nodes;
  for (const StoredArray& field : frame.point_fields()) at_nodes[field.name] = true;
  for (const StoredArray& field : frame.cell_fields()) at_nodes[field.name] = false;
  return at_nodes;
}

std::vector<std::pair<double, std::string>> frames_of(const std::string& folder) {
  std::vector<std::pair<double, std::string>> frames;
  for (const FrameEntry& frame : read_frames(folder)) frames.emplace_back(frame.time, folder + "/" + frame.file);
  return frames;
}

std::string unit_of(const std::string& column, const std::string& units) {
  const std::optional<Units> known = parse_units_comment(units);
  return known ? unit_of_column(*known, column) : "";
}

/// Is it at nodes, its components, its unit and what it means; of a variable that a law remembers its name alone is
/// known.
py::tuple kind_of(const std::string& name, const std::string& units) {
  const Quantity* quantity = find_quantity(name);
  const std::optional<Units> known = parse_units_comment(units);
  const Form form = quantity != nullptr ? quantity->form : Form::scalar;
  std::vector<std::string> names;
  for (const std::string_view component : component_names(form))
    if (!component.empty()) names.emplace_back(component);
  return py::make_tuple(quantity != nullptr && quantity->place == Place::nodes, names,
                        known ? unit_of_field(*known, name) : "",
                        quantity != nullptr  ? std::string(quantity->meaning)
                        : name == ghost_type ? std::string("not 0 of cells that have gone")
                                             : std::string("remembered by the law"));
}

}  // namespace

void bind_frames(py::module_& module) {
  py::class_<FrameFile>(module, "FrameFile", "The fields of one instant in a file of a results folder.")
      .def(py::init([](const std::string& path) {
             const py::gil_scoped_release release;
             const Computing computing(1);
             return std::make_unique<FrameFile>(path);
           }),
           py::arg("path"))
      .def_property_readonly("fields", &arrays_of, "Whether an array is at nodes (else at cells), by its name.")
      .def("array", &array_of, py::arg("name"), "The values of an array, as they are stored.")
      .def_property_readonly(
          "mesh",
          [](const FrameFile& frame) {
            const py::gil_scoped_release release;
            const Computing computing(1);
            return std::make_shared<Mesh>(frame.mesh());
          },
          "The mesh, whose cell_numbers are the positions of the cells in the file.");
  module.def("frames_of", &frames_of, py::arg("folder"), "Times and files of the frames of a results folder.");
  module.def("unit_of_column", &unit_of, py::arg("column"), py::arg("units"),
             "Unit of a column of a table, by the comment of a table.");
  module.def("kind_of", &kind_of, py::arg("name"), py::arg("units"),
             "Is a field at nodes, its components, its unit by the comment of a table, what it means.");
}

}  // namespace carom::python
