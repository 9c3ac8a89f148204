#include "mesh/skin.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

#include "mesh/cell_topology.hpp"
#include "mesh/orientation.hpp"

namespace carom {

namespace {

/// A face by its sorted nodes, and where it came from (6 * cell + side).
struct Face {
  std::array<Index, 4> sorted;
  std::int64_t origin;
};

std::vector<Face> faces_of(const Mesh& mesh, const CellBlock& hexas) {
  std::vector<Face> faces;
  faces.reserve(6 * hexas.size());
  for (std::size_t cell = 0; cell < hexas.size(); ++cell) {
    const std::span<const Index> nodes(&hexas.connectivity[8 * cell], 8);
    if (has_zero_thickness(mesh, CellType::hexa8, nodes)) continue;
    for (std::size_t side = 0; side < 6; ++side) {
      Face face{{}, static_cast<std::int64_t>(6 * cell + side)};
      for (std::size_t i = 0; i < 4; ++i) face.sorted[i] = nodes[hexa8_faces[side][i]];
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  }
  return faces;
}

}  // namespace

std::vector<std::array<Index, 4>> skin(const Mesh& mesh) {
  const CellBlock* hexas = mesh.block(CellType::hexa8);
  if (hexas == nullptr) return {};
  std::vector<Face> faces = faces_of(mesh, *hexas);
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.sorted < b.sorted; });
  std::vector<std::int64_t> outer;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t end = i + 1;
    while (end < faces.size() && faces[end].sorted == faces[i].sorted) ++end;
    if (end == i + 1) outer.push_back(faces[i].origin);
    i = end;
  }
  std::sort(outer.begin(), outer.end());
  std::vector<std::array<Index, 4>> result;
  result.reserve(outer.size());
  for (const std::int64_t origin : outer) {
    const auto cell = static_cast<std::size_t>(origin / 6), side = static_cast<std::size_t>(origin % 6);
    std::array<Index, 4> face{};
    for (std::size_t i = 0; i < 4; ++i) face[i] = hexas->connectivity[8 * cell + hexa8_faces[side][i]];
    result.push_back(face);
  }
  return result;
}

}  // namespace carom
