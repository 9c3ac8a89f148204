#include "mesh/cell_topology.hpp"

#include <algorithm>

namespace carom {

namespace {

constexpr std::array<CornerFrame, 1> kTetraFrames{{{0, 1, 2, 3}}};
constexpr std::array<CornerFrame, 4> kPyraFrames{{{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
constexpr std::array<CornerFrame, 6> kPentaFrames{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
constexpr std::array<CornerFrame, 8> kHexaFrames{
    {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}}};

constexpr std::array<LocalNode, 3> kTria3Mirror{0, 2, 1};
constexpr std::array<LocalNode, 6> kTria6Mirror{0, 2, 1, 5, 4, 3};
constexpr std::array<LocalNode, 4> kQuad4Mirror{0, 3, 2, 1};
constexpr std::array<LocalNode, 8> kQuad8Mirror{0, 3, 2, 1, 7, 6, 5, 4};
constexpr std::array<LocalNode, 9> kQuad9Mirror{0, 3, 2, 1, 7, 6, 5, 4, 8};
constexpr std::array<LocalNode, 4> kTetra4Mirror{0, 2, 1, 3};
constexpr std::array<LocalNode, 10> kTetra10Mirror{0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<LocalNode, 5> kPyra5Mirror{0, 3, 2, 1, 4};
constexpr std::array<LocalNode, 13> kPyra13Mirror{0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};
constexpr std::array<LocalNode, 6> kPenta6Mirror{0, 2, 1, 3, 5, 4};
constexpr std::array<LocalNode, 15> kPenta15Mirror{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13};
constexpr std::array<LocalNode, 8> kHexa8Mirror{0, 3, 2, 1, 4, 7, 6, 5};
constexpr std::array<LocalNode, 20> kHexa20Mirror{0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17};
constexpr std::array<LocalNode, 27> kHexa27Mirror{0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  15, 14,
                                                  13, 12, 16, 19, 18, 17, 22, 23, 20, 21, 24, 25, 26};

using Pair = std::array<LocalNode, 2>;
constexpr std::array<Pair, 4> kHexaX{{{0, 1}, {3, 2}, {4, 5}, {7, 6}}};
constexpr std::array<Pair, 4> kHexaY{{{0, 3}, {1, 2}, {4, 7}, {5, 6}}};
constexpr std::array<Pair, 4> kHexaZ{{{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
constexpr std::array<std::span<const Pair>, 3> kHexaPairings{kHexaX, kHexaY, kHexaZ};
constexpr std::array<Pair, 3> kPentaZ{{{0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<std::span<const Pair>, 1> kPentaPairings{kPentaZ};
constexpr std::array<Pair, 2> kQuadX{{{0, 1}, {3, 2}}};
constexpr std::array<Pair, 2> kQuadY{{{0, 3}, {1, 2}}};
constexpr std::array<std::span<const Pair>, 2> kQuadPairings{kQuadX, kQuadY};

}  // namespace

std::span<const CornerFrame> corner_frames(CellType type) {
  switch (type) {
    case CellType::tetra4:
    case CellType::tetra10:
      return kTetraFrames;
    case CellType::pyra5:
    case CellType::pyra13:
      return kPyraFrames;
    case CellType::penta6:
    case CellType::penta15:
      return kPentaFrames;
    case CellType::hexa8:
    case CellType::hexa20:
    case CellType::hexa27:
      return kHexaFrames;
    default:
      return {};
  }
}

std::span<const LocalNode> mirrored_order(CellType type) {
  switch (type) {
    case CellType::tria3:
      return kTria3Mirror;
    case CellType::tria6:
      return kTria6Mirror;
    case CellType::quad4:
      return kQuad4Mirror;
    case CellType::quad8:
      return kQuad8Mirror;
    case CellType::quad9:
      return kQuad9Mirror;
    case CellType::tetra4:
      return kTetra4Mirror;
    case CellType::tetra10:
      return kTetra10Mirror;
    case CellType::pyra5:
      return kPyra5Mirror;
    case CellType::pyra13:
      return kPyra13Mirror;
    case CellType::penta6:
      return kPenta6Mirror;
    case CellType::penta15:
      return kPenta15Mirror;
    case CellType::hexa8:
      return kHexa8Mirror;
    case CellType::hexa20:
      return kHexa20Mirror;
    case CellType::hexa27:
      return kHexa27Mirror;
    default:
      return {};
  }
}

std::span<const std::span<const std::array<LocalNode, 2>>> opposite_faces(CellType type) {
  switch (type) {
    case CellType::hexa8:
    case CellType::hexa20:
    case CellType::hexa27:
      return kHexaPairings;
    case CellType::penta6:
    case CellType::penta15:
      return kPentaPairings;
    case CellType::quad4:
      return kQuadPairings;
    default:
      return {};
  }
}

std::vector<std::uint8_t> node_dimensions(const Mesh& mesh) {
  std::vector<std::uint8_t> highest(mesh.node_count(), 0);
  for (const CellBlock& block : mesh.blocks) {
    const auto own = static_cast<std::uint8_t>(dimension(block.type));
    for (const Index n : block.connectivity) {
      std::uint8_t& seen = highest[static_cast<std::size_t>(n)];
      seen = std::max(seen, own);
    }
  }
  return highest;
}

bool on_boundary(std::span<const Index> nodes, CellType type, std::span<const std::uint8_t> node_dimensions) {
  const int own = dimension(type);
  return std::all_of(nodes.begin(), nodes.end(),
                     [&](Index n) { return node_dimensions[static_cast<std::size_t>(n)] > own; });
}

}  // namespace carom
