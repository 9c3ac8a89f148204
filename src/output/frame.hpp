// Meshes with fields on them: what is in a frame, whatever the format of its file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace carom {

/// In the order of FrameField::values.
enum class NumberType : std::uint8_t { float64, float32, int32, int64, uint8 };

/// One field: `components` values per point or cell, entry after entry, of the type that they have. 3 components are a
/// vector, 6 a symmetric tensor in VTK's order xx, yy, zz, xy, yz, zx.
struct FrameField {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<Index>, std::vector<std::int64_t>,
               std::vector<std::uint8_t>>
      values;
};

/// The field of cells by which VTK and ParaView leave out those that have gone (vtkDataSetAttributes::HIDDENCELL), and
/// its value for them; 0 else.
constexpr const char* ghost_type = "vtkGhostType";
constexpr std::uint8_t hidden_cell = 32;

/// Cells in any order: the points of each in VTK's order (vtk_cell_type), one after the other, and per cell where they
/// end and VTK's number of its type.
struct FrameCells {
  std::vector<Index> connectivity;
  std::vector<Index> ends;
  std::vector<std::uint8_t> types;

  /// points: in our order.
  void add(std::span<const Index> points, CellType type);
};

/// What all frames of a body have in common. The points are somebody else's.
struct FrameMesh {
  std::span<const Vec3> points;
  FrameCells cells;
  std::vector<FrameField> of_points, of_cells;  ///< numbers, parts
};

/// What is of one instant.
struct FieldFrame {
  std::vector<FrameField> points, cells;
};

}  // namespace carom
