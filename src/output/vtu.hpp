// Hexahedral meshes with fields as VTK unstructured grids (.vtu).
#pragma once

#include <span>
#include <string>

#include "base/types.hpp"

namespace carom {

/// One field: `components` values per point or cell, entry after entry. 3 components are a vector, 6 a symmetric tensor
/// in VTK's order xx, yy, zz, xy, yz, zx.
struct VtuField {
  std::string name;
  int components = 1;
  std::span<const double> values;
};

/// Writes points (n) and HEXA8 cells (8 point indices each) with their fields as raw appended little-endian data with
/// UInt64 headers, uncompressed. The file appears under its name only when it is complete. Copies none of the arrays.
/// Precondition: fields have components x (points or cells) values. Throws OutputError.
void write_vtu(const std::string& path, std::span<const Vec3> points, std::span<const Index> hexa8,
               std::span<const VtuField> point_fields, std::span<const VtuField> cell_fields);

}  // namespace carom
