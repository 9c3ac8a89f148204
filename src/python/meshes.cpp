// Meshes: views of their arrays, and texts made of arrays.
#include <pybind11/stl.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "mesh/read_mesh.hpp"
#include "mesh/write_gmsh.hpp"
#include "parallel/threads.hpp"
#include "python/arrays.hpp"
#include "python/compute.hpp"

namespace carom::python {

namespace {

using SharedMesh = std::shared_ptr<const Mesh>;
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

[[noreturn]] void refuse(const std::string& key, const std::string& found, const std::string& expected) {
  throw CaseError({"mesh of arrays", 0, 0}, key, found, expected);
}

CellType type_named(const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < cell_traits.size(); ++i) {
    names.push_back(lower(cell_traits[i].name));
    if (names.back() == lower(name)) return static_cast<CellType>(i);
  }
  const std::string near = nearest(name, names);
  throw CaseError({"mesh of arrays", 0, 0}, "cells", "\"" + name + "\"", "a type of cells, such as \"hexa8\"",
                  near.empty() ? "" : "Did you mean \"" + near + "\"?");
}

void add_points(Mesh& mesh, const Doubles& points) {
  if (points.ndim() != 2 || points.shape(1) != 3) refuse("points", "another shape", "an array of n rows of x, y, z");
  for (py::ssize_t n = 0; n < points.shape(0); ++n) {
    const double* x = points.data(n, 0);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
      refuse("points", "row " + std::to_string(n) + ", which is not finite", "finite coordinates");
    mesh.coordinates.push_back({x[0], x[1], x[2]});
    mesh.node_numbers.push_back(n + 1);
  }
}

void add_cells(Mesh& mesh, const std::string& name, const Indices& cells, std::int64_t& number) {
  const CellType type = type_named(name);
  if (mesh.block(type) != nullptr) refuse("cells", name + " twice", "one array for each type");
  if (cells.ndim() != 2 || cells.shape(1) != node_count(type))
    refuse("cells." + name, "another shape", "an array of rows of " + std::to_string(node_count(type)) + " nodes");
  CellBlock block{type, {}, {}};
  const auto count = static_cast<std::int64_t>(mesh.node_count());
  for (py::ssize_t k = 0; k < cells.shape(0); ++k) {
    for (py::ssize_t i = 0; i < cells.shape(1); ++i) {
      const std::int64_t node = cells.at(k, i);
      if (node < 0 || node >= count)
        refuse("cells." + name, "node " + std::to_string(node) + " in row " + std::to_string(k),
               "rows of points, from 0 to " + std::to_string(count - 1));
      block.connectivity.push_back(static_cast<Index>(node));
    }
    block.file_numbers.push_back(++number);
  }
  mesh.blocks.push_back(std::move(block));
}

std::vector<Index> positions(const Indices& given, std::size_t count, const std::string& key) {
  if (given.ndim() != 1) refuse(key, "another shape", "a list of positions");
  std::vector<Index> out;
  for (py::ssize_t i = 0; i < given.shape(0); ++i) {
    if (given.at(i) < 0 || given.at(i) >= static_cast<std::int64_t>(count))
      refuse(key, std::to_string(given.at(i)), "positions from 0 to " + std::to_string(count) + " - 1");
    out.push_back(static_cast<Index>(given.at(i)));
  }
  return out;
}

/// What read_mesh takes: checked, numbered from 1.
std::string text_of(const Doubles& points, const std::vector<std::pair<std::string, Indices>>& cells,
                    const std::map<std::string, Indices>& node_groups,
                    const std::map<std::string, std::map<std::string, Indices>>& cell_groups) {
  Mesh mesh;
  mesh.report.source = "mesh of arrays";
  add_points(mesh, points);
  std::int64_t number = 0;
  for (const auto& [name, rows] : cells) add_cells(mesh, name, rows, number);
  for (const auto& [group, nodes] : node_groups)
    mesh.node_groups[group] = positions(nodes, mesh.node_count(), "node_groups." + group);
  for (const auto& [group, by_type] : cell_groups) {
    for (const auto& [name, rows] : by_type) {
      const CellType type = type_named(name);
      const CellBlock* block = mesh.block(type);
      const std::string key = "cell_groups." + group + "." + name;
      if (block == nullptr) refuse(key, "cells of a type that the mesh has not", "one of its types");
      for (const Index k : positions(rows, block->size(), key))
        mesh.cell_groups[group].push_back({static_cast<Index>(block - mesh.blocks.data()), k});
    }
  }
  return gmsh_text(mesh);
}

py::dict cells_of(const SharedMesh& mesh) {
  py::dict out;
  for (const CellBlock& block : mesh->blocks) {
    const auto width = static_cast<py::ssize_t>(node_count(block.type));
    out[py::str(lower(name(block.type)))] =
        view(block.connectivity.data(), {static_cast<py::ssize_t>(block.size()), width}, mesh);
  }
  return out;
}

py::dict cell_numbers_of(const SharedMesh& mesh) {
  py::dict out;
  for (const CellBlock& block : mesh->blocks)
    out[py::str(lower(name(block.type)))] =
        view(block.file_numbers.data(), {static_cast<py::ssize_t>(block.size())}, mesh);
  return out;
}

py::dict node_groups_of(const SharedMesh& mesh) {
  py::dict out;
  for (const auto& [group, nodes] : mesh->node_groups)
    out[py::str(group)] = view(nodes.data(), {static_cast<py::ssize_t>(nodes.size())}, mesh);
  return out;
}

py::dict cell_groups_of(const SharedMesh& mesh) {
  py::dict out;
  for (const auto& [group, cells] : mesh->cell_groups) {
    std::map<Index, std::vector<Index>> by_block;
    for (const CellRef& ref : cells) by_block[ref.block].push_back(ref.cell);
    py::dict by_type;
    for (const auto& [block, rows] : by_block)
      by_type[py::str(lower(name(mesh->blocks[static_cast<std::size_t>(block)].type)))] =
          py::array_t<Index>(static_cast<py::ssize_t>(rows.size()), rows.data());
    out[py::str(group)] = by_type;
  }
  return out;
}

py::array nodes_of(const SharedMesh& mesh, const std::string& group) {
  if (!mesh->has_group(group)) throw py::key_error(group);
  const std::vector<Index> nodes = mesh->nodes_of(group);
  return py::array_t<Index>(static_cast<py::ssize_t>(nodes.size()), nodes.data());
}

SharedMesh read(const std::string& path) {
  const py::gil_scoped_release release;
  const Computing computing(1);
  return std::make_shared<const Mesh>(read_mesh(path));
}

}  // namespace

void bind_meshes(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>>(module, "MeshData", "Arrays of a mesh; views, read-only.")
      .def_property_readonly(
          "points",
          [](const std::shared_ptr<Mesh>& m) {
            return view(m->coordinates.data()->data(), {static_cast<py::ssize_t>(m->node_count()), 3}, SharedMesh(m));
          },
          "Coordinates, one row for each node.")
      .def_property_readonly(
          "node_numbers",
          [](const std::shared_ptr<Mesh>& m) {
            return view(m->node_numbers.data(), {static_cast<py::ssize_t>(m->node_count())}, SharedMesh(m));
          },
          "Numbers of the nodes in the mesh file.")
      .def_property_readonly(
          "cells", [](const std::shared_ptr<Mesh>& m) { return cells_of(m); }, "Rows of nodes by type of the cells.")
      .def_property_readonly(
          "cell_numbers", [](const std::shared_ptr<Mesh>& m) { return cell_numbers_of(m); },
          "Numbers of the cells in the mesh file, by type.")
      .def_property_readonly(
          "node_groups", [](const std::shared_ptr<Mesh>& m) { return node_groups_of(m); }, "Nodes by group.")
      .def_property_readonly(
          "cell_groups", [](const std::shared_ptr<Mesh>& m) { return cell_groups_of(m); },
          "Positions of cells by group and type.")
      .def(
          "nodes_of", [](const std::shared_ptr<Mesh>& m, const std::string& g) { return nodes_of(m, g); },
          py::arg("group"), "Nodes of a node group and of the cells of a cell group of this name.");
  module.def(
      "read_mesh", [](const std::string& path) { return std::const_pointer_cast<Mesh>(read(path)); }, py::arg("path"),
      "Mesh of a file.");
  module.def("mesh_text", &text_of, py::arg("points"), py::arg("cells"), py::arg("node_groups"), py::arg("cell_groups"),
             "Arrays as the text of a Gmsh file.");
}

}  // namespace carom::python
