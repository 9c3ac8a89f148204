#include "contact/buried_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/box_tree.hpp"
#include "contact/facet_geometry.hpp"
#include "element/hexa8.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

constexpr double inside = 1.0 - 1e-5;  // parent coordinates
constexpr double under = 1e-3;         // of the facet's size

/// A cell of eight nodes; a plane cell stands as a prism of thickness 2 about its plane.
using Corners = std::array<Vec3, 8>;

/// True when x lies in the cell: Newton's method for sum_a N_a(xi) x_a = x from the centre.
bool contains(const Corners& corners, const Vec3& x) {
  Vec3 xi{};
  for (int i = 0; i < 20; ++i) {
    const std::array<double, 8> N = hexa8::shape(xi);
    const std::array<Vec3, 8> dN = hexa8::shape_gradient(xi);
    Vec3 r = x;
    std::array<Vec3, 3> J{};  // dx / dxi_k
    for (std::size_t a = 0; a < 8; ++a) {
      r = subtract(r, scaled(corners[a], N[a]));
      for (std::size_t k = 0; k < 3; ++k) J[k] = add(J[k], scaled(corners[a], dN[a][k]));
    }
    const double det = dot(J[0], cross(J[1], J[2]));
    if (!(det > 0.0)) return false;
    const Vec3 step{dot(r, cross(J[1], J[2])) / det, dot(r, cross(J[2], J[0])) / det, dot(r, cross(J[0], J[1])) / det};
    xi = add(xi, step);
    const double reach = std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])});
    if (!(reach < 10.0)) return false;
    if (norm(step) < 1e-9) return reach < inside;
  }
  return false;
}

/// The cells of the parts that have an inside, at their current positions.
struct Cells {
  std::vector<CellRef> ref;
  std::vector<std::span<const Index>> nodes;
  std::vector<Corners> corners;
  std::vector<Bounds> bounds;

  Cells(const Model& model, std::span<const Vec3> x) {
    for (const Part& part : model.parts) {
      for (const Index c : part.cells) add_cell(*model.mesh, part.type, c, x);
    }
  }
  void add_cell(const Mesh& mesh, CellType type, Index c, std::span<const Vec3> x) {
    if (type != CellType::hexa8 && type != CellType::quad4) return;
    const CellBlock& block = *mesh.block(type);
    const auto n = static_cast<std::size_t>(node_count(type));
    nodes.push_back(std::span(block.connectivity).subspan(n * static_cast<std::size_t>(c), n));
    ref.push_back({static_cast<Index>(&block - mesh.blocks.data()), c});
    Corners corner;
    for (std::size_t a = 0; a < 8; ++a) corner[a] = x[nodes.back()[a % n]];
    if (n == 4)
      for (std::size_t a = 0; a < 8; ++a) corner[a][2] += a < 4 ? -1.0 : 1.0;
    corners.push_back(corner);
    bounds.emplace_back();
    for (const Vec3& at : corner) bounds.back().include(at);
  }
};

/// A point of the facet off its centre and its diagonals, a little under it.
Vec3 point_under(const PlacedFacet& facet) {
  const ParentPoint at = facet.size == 3 ? ParentPoint{0.31, 0.23} : ParentPoint{0.13, facet.size == 4 ? -0.29 : 0.0};
  const FacetFrame frame = facet_frame(facet, at.xi, at.eta);
  const double size = facet.size == 2 ? measure(facet) : std::sqrt(measure(facet));
  return subtract(frame.position, scaled(frame.normal, under * size));
}

bool owns(std::span<const Index> cell, const Facet& facet) {
  return std::all_of(facet.begin(), facet.end(),
                     [&](Index n) { return std::find(cell.begin(), cell.end(), n) != cell.end(); });
}

}  // namespace

std::vector<BuriedFacet> buried_facets(const Model& model, const PairContact& pair, std::span<const double> u) {
  std::vector<Vec3> x = model.mesh->coordinates;
  for (std::size_t n = 0; n < x.size(); ++n)
    for (std::size_t c = 0; c < 3; ++c) x[n][c] += u[3 * n + c];
  const Cells cells(model, x);
  BoxTree tree;
  tree.build(cells.bounds);
  std::vector<BuriedFacet> found;
  std::vector<Index> near;
  for (const Surface* surface : {&pair.slave, &pair.master}) {
    for (const Facet& facet : surface->facets) {
      const Vec3 at = point_under(place(facet, x));
      Bounds point;
      point.include(at);
      near.clear();
      tree.find(point, near);
      const auto inside_of = std::find_if(near.begin(), near.end(), [&](Index c) {
        return !owns(cells.nodes[c], facet) && contains(cells.corners[c], at);
      });
      if (inside_of != near.end()) found.push_back({facet, at, cells.ref[*inside_of]});
    }
    if (pair.self) break;
  }
  return found;
}

}  // namespace carom
