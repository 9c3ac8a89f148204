#include "solid/quadratic_faces.hpp"

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "element/shape_table.hpp"
#include "element/shapes/quad8.hpp"
#include "element/shapes/tria6.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "mesh/skin.hpp"

namespace carom {

namespace {

/// LINE3: ends at -1 and 1, middle.
struct Line3 {
  static constexpr int nodes = 3, dimension = 1;
  template <class T>
  static constexpr void values(const T xi[1], T N[3]) {
    N[0] = 0.5 * xi[0] * (xi[0] - 1.0);
    N[1] = 0.5 * xi[0] * (xi[0] + 1.0);
    N[2] = 1.0 - xi[0] * xi[0];
  }
};

/// QUAD9: products of Line3's, corners, middles of the edges, centre.
struct Quad9 {
  static constexpr int nodes = 9, dimension = 2;
  template <class T>
  static constexpr void values(const T xi[2], T N[9]) {
    constexpr int along_xi[9] = {0, 1, 1, 0, 2, 1, 2, 0, 2}, along_eta[9] = {0, 0, 1, 1, 0, 2, 1, 2, 2};
    T a[3], b[3];
    Line3::values(xi, a);
    Line3::values(xi + 1, b);
    for (int n = 0; n < 9; ++n) N[n] = a[along_xi[n]] * b[along_eta[n]];
  }
};

using Positions = std::array<Vec3, 9>;

/// Of a face in space.
template <class Shape, int count>
Positions integrate(const ShapeTable<count, Shape::nodes, 2>& at, const Positions& x) {
  Positions sum{};
  for (int p = 0; p < count; ++p) {
    Vec3 tangent[2]{};
    for (int a = 0; a < Shape::nodes; ++a)
      for (int k = 0; k < 2; ++k) tangent[k] = add(tangent[k], scaled(x[static_cast<std::size_t>(a)], at.dN[p][a][k]));
    const Vec3 normal = scaled(cross(tangent[0], tangent[1]), at.weight[p]);
    for (int a = 0; a < Shape::nodes; ++a) {
      Vec3& of_node = sum[static_cast<std::size_t>(a)];
      of_node = add(of_node, scaled(normal, at.N[p][a]));
    }
  }
  return sum;
}

Positions integrate_edge(const Positions& x, Section section, double thickness) {
  static constexpr auto at = tabulate<Line3>(gauss_rule<3>());
  Positions sum{};
  for (int p = 0; p < at.points; ++p) {
    Vec3 place{}, tangent{};
    for (std::size_t a = 0; a < 3; ++a) {
      place = add(place, scaled(x[a], at.N[p][a]));
      tangent = add(tangent, scaled(x[a], at.dN[p][a][0]));
    }
    const double width = section == Section::axisymmetric ? 2.0 * std::numbers::pi * place[0] : thickness;
    const Vec3 normal = scaled(Vec3{tangent[1], -tangent[0], 0.0}, at.weight[p] * width);
    for (std::size_t a = 0; a < 3; ++a) sum[a] = add(sum[a], scaled(normal, at.N[p][a]));
  }
  return sum;
}

}  // namespace

std::vector<QuadraticFace> take_quadratic_faces(const Mesh& mesh, std::vector<Facet>& facets) {
  const auto is_quadratic = [](CellType type) { return has_quadratic_faces(type) && dimension(type) > 1; };
  if (std::none_of(mesh.blocks.begin(), mesh.blocks.end(), [&](const CellBlock& b) { return is_quadratic(b.type); }))
    return {};
  std::set<std::array<Index, 4>> wanted, taken;
  for (const Facet& facet : facets) wanted.insert(facet.node);
  std::set<std::pair<CellRef, int>> known;
  std::vector<QuadraticFace> faces;
  for (const OuterFacet& outer : outer_facets(mesh)) {
    const CellBlock& block = mesh.blocks[static_cast<std::size_t>(outer.cell.block)];
    if (!is_quadratic(block.type) || !wanted.contains(outer.facet.node)) continue;
    taken.insert(outer.facet.node);
    if (!known.insert({outer.cell, outer.face}).second) continue;
    const CellFace& face = cell_faces(block.type)[static_cast<std::size_t>(outer.face)];
    const auto first = static_cast<std::size_t>(node_count(block.type)) * static_cast<std::size_t>(outer.cell.cell);
    QuadraticFace& whole = faces.emplace_back(QuadraticFace{face.type, {}});
    for (std::size_t a = 0; a < face.nodes().size(); ++a) whole.node[a] = block.connectivity[first + face.nodes()[a]];
  }
  std::erase_if(facets, [&](const Facet& facet) { return taken.contains(facet.node); });
  return faces;
}

std::array<Vec3, 9> nodal_area_vectors(const QuadraticFace& face, const Mesh& mesh, Section section, double thickness) {
  Positions x{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(node_count(face.type)); ++a)
    x[a] = mesh.coordinates[static_cast<std::size_t>(face.node[a])];
  static constexpr auto at_tria6 = tabulate<Tria6>(triangle_rule<6>());
  static constexpr auto at_quad8 = tabulate<Quad8>(square_rule<3>());
  static constexpr auto at_quad9 = tabulate<Quad9>(square_rule<3>());
  if (face.type == CellType::tria6) return integrate<Tria6>(at_tria6, x);
  if (face.type == CellType::quad8) return integrate<Quad8>(at_quad8, x);
  if (face.type == CellType::quad9) return integrate<Quad9>(at_quad9, x);
  return integrate_edge(x, section, thickness);
}

}  // namespace carom
