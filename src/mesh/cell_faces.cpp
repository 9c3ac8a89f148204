// Edges, faces and VTK's numbers of the cell types.
#include <algorithm>

#include "mesh/cell_topology.hpp"

namespace carom {

namespace {

using Edge = std::array<LocalNode, 2>;

constexpr std::array<Edge, 1> kLineEdges{{{0, 1}}};
constexpr std::array<Edge, 3> kTriaEdges{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Edge, 4> kQuadEdges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Edge, 6> kTetraEdges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 8> kPyraEdges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<Edge, 9> kPentaEdges{{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 12> kHexaEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

constexpr CellFace point(LocalNode a) {
  return {CellType::point1, {a}};
}
constexpr CellFace line(LocalNode a, LocalNode b) {
  return {CellType::line2, {a, b}};
}
constexpr CellFace tria(LocalNode a, LocalNode b, LocalNode c) {
  return {CellType::tria3, {a, b, c}};
}
constexpr CellFace quad(LocalNode a, LocalNode b, LocalNode c, LocalNode d) {
  return {CellType::quad4, {a, b, c, d}};
}

constexpr std::array<CellFace, 2> kLineFaces{point(0), point(1)};
constexpr std::array<CellFace, 3> kTria3Faces{line(0, 1), line(1, 2), line(2, 0)};
constexpr std::array<CellFace, 4> kQuad4Faces{line(0, 1), line(1, 2), line(2, 3), line(3, 0)};
constexpr std::array<CellFace, 4> kTetra4Faces{tria(0, 2, 1), tria(0, 1, 3), tria(1, 2, 3), tria(2, 0, 3)};
constexpr std::array<CellFace, 5> kPyra5Faces{quad(0, 3, 2, 1), tria(0, 1, 4), tria(1, 2, 4), tria(2, 3, 4),
                                              tria(3, 0, 4)};
constexpr std::array<CellFace, 5> kPenta6Faces{tria(0, 2, 1), tria(3, 4, 5), quad(0, 1, 4, 3), quad(1, 2, 5, 4),
                                               quad(2, 0, 3, 5)};
constexpr std::array<CellFace, 6> kHexa8Faces{quad(0, 3, 2, 1), quad(4, 5, 6, 7), quad(0, 1, 5, 4),
                                              quad(1, 2, 6, 5), quad(2, 3, 7, 6), quad(3, 0, 4, 7)};

/// The linear faces of a cell with `corners` corners, with the middles of their edges.
template <std::size_t n>
constexpr std::array<CellFace, n> quadratic(std::array<CellFace, n> faces, std::span<const Edge> edges,
                                            LocalNode corners) {
  for (CellFace& face : faces) {
    const std::size_t size = face.type == CellType::line2 ? 2 : (face.type == CellType::tria3 ? 3 : 4);
    face.type = size == 2 ? CellType::line3 : (size == 3 ? CellType::tria6 : CellType::quad8);
    for (std::size_t i = 0; i < (size == 2 ? 1 : size); ++i) {
      const LocalNode a = face.node[i], b = face.node[(i + 1) % size];
      for (std::size_t e = 0; e < edges.size(); ++e)
        if ((edges[e][0] == a && edges[e][1] == b) || (edges[e][0] == b && edges[e][1] == a))
          face.node[size + i] = static_cast<LocalNode>(corners + e);
    }
  }
  return faces;
}

/// HEXA20's with the centres 20 to 25, which stand at -x, +x, -y, +y, -z, +z of the parent cell.
constexpr std::array<CellFace, 6> with_centres(std::array<CellFace, 6> faces) {
  constexpr std::array<LocalNode, 6> centre{24, 25, 22, 21, 23, 20};
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f].type = CellType::quad9;
    faces[f].node[8] = centre[f];
  }
  return faces;
}

constexpr auto kTria6Faces = quadratic(kTria3Faces, kTriaEdges, 3);
constexpr auto kQuad8Faces = quadratic(kQuad4Faces, kQuadEdges, 4);
constexpr auto kTetra10Faces = quadratic(kTetra4Faces, kTetraEdges, 4);
constexpr auto kPyra13Faces = quadratic(kPyra5Faces, kPyraEdges, 5);
constexpr auto kPenta15Faces = quadratic(kPenta6Faces, kPentaEdges, 6);
constexpr auto kHexa20Faces = quadratic(kHexa8Faces, kHexaEdges, 8);
constexpr auto kHexa27Faces = with_centres(kHexa20Faces);

constexpr std::array<FacePiece, 1> kPointPieces{{{{0}, 1}}};
constexpr std::array<FacePiece, 1> kLine2Pieces{{{{0, 1}, 2}}};
constexpr std::array<FacePiece, 2> kLine3Pieces{{{{0, 2}, 2}, {{2, 1}, 2}}};
constexpr std::array<FacePiece, 1> kTria3Pieces{{{{0, 1, 2}, 3}}};
constexpr std::array<FacePiece, 4> kTria6Pieces{{{{0, 3, 5}, 3}, {{3, 1, 4}, 3}, {{5, 4, 2}, 3}, {{3, 4, 5}, 3}}};
constexpr std::array<FacePiece, 1> kQuad4Pieces{{{{0, 1, 2, 3}, 4}}};
constexpr std::array<FacePiece, 5> kQuad8Pieces{
    {{{0, 4, 7}, 3}, {{4, 1, 5}, 3}, {{5, 2, 6}, 3}, {{7, 6, 3}, 3}, {{4, 5, 6, 7}, 4}}};
constexpr std::array<FacePiece, 4> kQuad9Pieces{
    {{{0, 4, 8, 7}, 4}, {{4, 1, 5, 8}, 4}, {{8, 5, 2, 6}, 4}, {{7, 8, 6, 3}, 4}}};

struct Shape {
  std::span<const Edge> edges;
  std::span<const CellFace> faces;
  std::span<const FacePiece> pieces;
  std::uint8_t vtk;
};

/// In the order of CellType.
constexpr std::array<Shape, 17> kShapes{{{{}, {}, kPointPieces, 1},
                                         {kLineEdges, kLineFaces, kLine2Pieces, 3},
                                         {kLineEdges, kLineFaces, kLine3Pieces, 21},
                                         {kTriaEdges, kTria3Faces, kTria3Pieces, 5},
                                         {kTriaEdges, kTria6Faces, kTria6Pieces, 22},
                                         {kQuadEdges, kQuad4Faces, kQuad4Pieces, 9},
                                         {kQuadEdges, kQuad8Faces, kQuad8Pieces, 23},
                                         {kQuadEdges, kQuad8Faces, kQuad9Pieces, 28},
                                         {kTetraEdges, kTetra4Faces, {}, 10},
                                         {kTetraEdges, kTetra10Faces, {}, 24},
                                         {kPyraEdges, kPyra5Faces, {}, 14},
                                         {kPyraEdges, kPyra13Faces, {}, 27},
                                         {kPentaEdges, kPenta6Faces, {}, 13},
                                         {kPentaEdges, kPenta15Faces, {}, 26},
                                         {kHexaEdges, kHexa8Faces, {}, 12},
                                         {kHexaEdges, kHexa20Faces, {}, 25},
                                         {kHexaEdges, kHexa27Faces, {}, 29}}};

const Shape& shape(CellType type) {
  return kShapes.at(static_cast<std::size_t>(type));
}

}  // namespace

CellType linear_type(CellType type) {
  CellType linear = type;
  for (std::size_t t = kShapes.size(); t-- > 0;)
    if (dimension(CellType(t)) == dimension(type) && corner_count(CellType(t)) == corner_count(type))
      linear = CellType(t);  // declared before those of higher order
  return linear;
}
std::span<const std::array<LocalNode, 2>> cell_edges(CellType type) {
  return shape(type).edges;
}
std::span<const CellFace> cell_faces(CellType type) {
  return shape(type).faces;
}
std::span<const FacePiece> face_pieces(CellType type) {
  return shape(type).pieces;
}
bool has_quadratic_faces(CellType type) {
  return node_count(type) > corner_count(type) && type != CellType::tetra10;
}
VtkCellType vtk_cell_type(CellType type) {
  const bool is_wedge = type == CellType::penta6 || type == CellType::penta15;
  return {shape(type).vtk, is_wedge ? mirrored_order(type) : std::span<const LocalNode>{}};
}

}  // namespace carom
