// Meshes with fields as VTK unstructured grids (.vtu).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// One field: `components` values per point or cell, entry after entry, of the type that they have. 3 components are a
/// vector, 6 a symmetric tensor in VTK's order xx, yy, zz, xy, yz, zx.
struct VtuField {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<Index>, std::vector<std::int64_t>,
               std::vector<std::uint8_t>>
      values;
};

/// Cells in any order: the points of each in VTK's order (vtk_cell_type), one after the other, and per cell where they
/// end and VTK's number of its type.
struct VtuCells {
  std::vector<Index> connectivity;
  std::vector<Index> ends;
  std::vector<std::uint8_t> types;

  /// points: in our order.
  void add(std::span<const Index> points, CellType type);
};

/// Writes points (n) and cells with their fields as raw appended little-endian data with UInt64 headers, uncompressed.
/// The file appears under its name only when it is complete. Copies none of the arrays.
/// Precondition: fields have components x (points or cells) values. Throws OutputError.
void write_vtu(const std::string& path, std::span<const Vec3> points, const VtuCells& cells,
               std::span<const VtuField> point_fields, std::span<const VtuField> cell_fields);

}  // namespace carom
