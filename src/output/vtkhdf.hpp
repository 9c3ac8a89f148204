// Frames as HDF5 files in VTK's own layout, "VTKHDF" 1.0 of UnstructuredGrid (docs.vtk.org, "VTK File Formats").
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "output/frame.hpp"
#include "output/frame_format.hpp"

namespace carom {

/// Writes a mesh file fields/<body>.vtkhdf, and then frames beside it that name its arrays by links (external links of
/// HDF5): each file is a whole unstructured grid for who reads it. Arrays are cut into pieces, shuffled and deflated.
std::unique_ptr<FrameWriter> make_vtkhdf_writer(const std::string& folder, std::string_view body, FrameMesh mesh);

/// Besides what VTK reads: the cells as one array, each with XDMF's number of its type before its points.
constexpr const char* mixed_topology = "MixedTopology";

/// An array of such a file.
struct VtkHdfArray {
  std::string group, name;  ///< "PointData", "CellData", or "" of the mesh
  std::string file{};       ///< in the same folder, that holds it; "": this one
  int components = 1;       ///< 1 too where it is a plain list
  std::size_t entries = 0;
  NumberType type{};

  std::string path() const { return group.empty() ? name : group + "/" + name; }
};

/// The arrays, by groups, as they have been written. Throws std::runtime_error, which names the file and what is wrong
/// with it, as read_vtkhdf does.
std::vector<VtkHdfArray> vtkhdf_arrays(const std::string& path);
/// The numbers of an array, as they are in memory.
std::vector<std::byte> read_vtkhdf(const std::string& path, const VtkHdfArray& array);

}  // namespace carom
