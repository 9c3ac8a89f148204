// Meshes with fields as VTK unstructured grids (.vtu).
#pragma once

#include <string>

#include "output/frame.hpp"

namespace carom {

/// Writes a mesh with its fields and those of an instant as raw appended little-endian data with UInt64 headers,
/// uncompressed. The file appears under its name only when it is complete. Copies none of the arrays.
/// Precondition: fields have components x (points or cells) values. Throws OutputError.
void write_vtu(const std::string& path, const FrameMesh& mesh, const FieldFrame& frame = {});

}  // namespace carom
