// Small bodies of every section for the tests of the solid.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "cell_meshes.hpp"
#include "linalg/conjugate_gradients.hpp"
#include "solid/element_table.hpp"
#include "solid_fixture.hpp"

namespace carom::test {

/// Mesh of one block of cells.
inline Mesh mesh_of(CellType type, std::vector<Vec3> coordinates, std::vector<Index> connectivity) {
  Mesh mesh;
  mesh.coordinates = std::move(coordinates);
  mesh.node_numbers.resize(mesh.coordinates.size());
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), std::int64_t{1});
  CellBlock block{type, std::move(connectivity), {}};
  block.file_numbers.resize(block.connectivity.size() / static_cast<std::size_t>(node_count(type)));
  std::iota(block.file_numbers.begin(), block.file_numbers.end(), std::int64_t{1});
  mesh.blocks.push_back(std::move(block));
  return mesh;
}

/// QUAD4 over [x, x + n] x [0, m] in unit squares; inner nodes moved by up to `distortion` (seeded).
inline Mesh quad_mesh(int n, int m, double distortion, double x = 1.0) {
  std::vector<Vec3> coordinates;
  const auto move = random_vector(2 * static_cast<std::size_t>((n + 1) * (m + 1)), 11);
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < m;
      const double step = inside ? distortion : 0.0;
      const double* by = move.data() + 2 * coordinates.size();
      coordinates.push_back({x + i + step * by[0], j + step * by[1], 0.0});
    }
  std::vector<Index> connectivity;
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = i + j * (n + 1), b = a + n + 1;
      connectivity.insert(connectivity.end(), {a, a + 1, b + 1, b});
    }
  return mesh_of(CellType::quad4, std::move(coordinates), std::move(connectivity));
}

/// A truss of six bars over the edges of a skew tetrahedron.
inline Mesh truss_mesh() {
  return mesh_of(CellType::line2, {{0, 0, 0}, {1.2, 0.1, 0}, {0.3, 1.1, -0.1}, {0.4, 0.3, 0.9}},
                 {0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3});
}

inline CellType cells_of(Section section) {
  return section == Section::solid ? CellType::hexa8 : section == Section::bar ? CellType::line2 : CellType::quad4;
}

/// One part of all cells of the element's type.
inline Model body(Mesh mesh, const Element& element, const Material& material, double thickness = 0.7) {
  Model model;
  Part part{.name = "body",
            .cells = {},
            .material = material,
            .type = element.type,
            .section = element.section,
            .thickness = thickness,
            .formulation = element.formulation};
  part.cells.resize(mesh.block(part.type)->size());
  std::iota(part.cells.begin(), part.cells.end(), Index{0});
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts.push_back(std::move(part));
  return model;
}

/// One part of all cells of the mesh's block of the section's type, integrated fully.
inline Model body(Mesh mesh, Section section, const Material& material, double thickness = 0.7) {
  return body(std::move(mesh), *find_element(cells_of(section), section, Formulation::full), material, thickness);
}

inline Mesh distorted_mesh(Section section) {
  if (section == Section::solid) return block_mesh({2, 2, 2}, 0.2);
  return section == Section::bar ? truss_mesh() : quad_mesh(3, 3, 0.2);
}

/// Distorted cells of a type; those with nodes between their corners are curved as well.
inline Mesh distorted_mesh(CellType type, int divisions = 0) {
  if (dimension(type) == 1) return truss_mesh();
  const int m = divisions > 0 ? divisions : dimension(type) == 3 ? 2 : 3;
  Mesh mesh = with_cells(dimension(type) == 3 ? block_mesh({m, m, m}, 0.15) : quad_mesh(m, m, 0.15), type);
  const CellBlock& block = *mesh.block(type);
  const auto size = static_cast<std::size_t>(node_count(type)), corners = static_cast<std::size_t>(corner_count(type));
  const auto move = random_vector(3 * mesh.node_count(), 12);
  for (std::size_t k = 0; k < block.connectivity.size(); ++k) {
    const auto n = static_cast<std::size_t>(block.connectivity[k]);
    for (std::size_t i = 0; k % size >= corners && i < static_cast<std::size_t>(dimension(type)); ++i)
      mesh.coordinates[n][i] += 0.01 * move[3 * n + i];
  }
  return mesh;
}

/// How far nodes of a distorted mesh may move at random without inverting a cell: less where they are nearer.
inline double largest_move(CellType type) {
  return type == CellType::pyra13 ? 0.04 : type == CellType::penta15 ? 0.07 : 0.1;
}

/// One distorted cell.
inline Mesh one_cell(CellType type) {
  if (dimension(type) == 1) return mesh_of(type, {{0, 0, 0}, {0.6, 0.5, 0.7}}, {0, 1});
  const Mesh all = distorted_mesh(type);
  const CellBlock& block = *all.block(type);
  std::vector<Vec3> x;
  std::vector<Index> nodes;
  for (Index a = 0; a < node_count(type); ++a) {
    nodes.push_back(a);
    x.push_back(all.coordinates[static_cast<std::size_t>(block.connectivity[static_cast<std::size_t>(a)])]);
  }
  return mesh_of(type, std::move(x), std::move(nodes));
}

/// Four hexahedra, or four quadrilaterals, in cells of a type.
inline Mesh few_cells(CellType type) {
  return with_cells(dimension(type) == 3 ? block_mesh({2, 2, 1}, 0.0) : quad_mesh(2, 2, 0.15), type);
}

/// One element with one law, as a test parameter.
struct Body {
  Element element;
  Material material;
  Section section = element.section;
};

inline std::string name_of(const Body& body) {
  static const char* const sections[] = {"Solid", "PlaneStrain", "PlaneStress", "Axisymmetric", "Bar"};
  static const char* const formulations[] = {"", "MeanDilatation", "OnePoint", "Stabilised", "Reduced", "Nodal"};
  static const char* const laws[] = {"LinearElastic", "StVenantKirchhoff", "NeoHookean", "J2SmallStrain", "J2"};
  return sections[static_cast<std::size_t>(body.section)] + std::string(name(body.element.type)) +
         formulations[static_cast<std::size_t>(body.element.formulation)] + laws[index_of(*body.material.law)];
}

/// The elasticity of unit_material that yields at a strain of 2 % and hardens; law: "j2" or "j2_small_strain".
inline Material yielding(std::string_view law) {
  return Material(
      law, unit_material.rho,
      {{"E", unit_material.E}, {"nu", unit_material.nu}, {"yield_stress", 0.04}, {"hardening_modulus", 1.0}});
}

inline std::vector<Material> all_materials() {
  return {unit_material, StVenantKirchhoff{unit_material}, NeoHookean{unit_material}, yielding("j2_small_strain"),
          yielding("j2")};
}

inline bool remembers(const Body& body) {
  return !body.material.law->history.empty();
}

inline std::vector<Body> all_bodies() {
  std::vector<Body> bodies;
  for (const Element& element : elements())
    for (const Material& material : all_materials()) bodies.push_back({element, material});
  return bodies;
}

/// A body of distorted cells of the element.
inline Model body(const Body& of) {
  return body(distorted_mesh(of.element.type), of.element, of.material);
}

inline bool is_finite_strain(const Body& body) {
  return body.material.law->measure == Measure::green_lagrange;
}

/// Displacement components that strain the cells.
inline std::size_t components(Section section) {
  return section == Section::solid || section == Section::bar ? 3 : 2;
}

inline double dot(const std::vector<double>& x, const std::vector<double>& y) {
  return std::inner_product(x.begin(), x.end(), y.begin(), 0.0);
}

/// scale x + y
inline std::vector<double> sum(double scale, const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<double> result(y);
  for (std::size_t i = 0; i < x.size(); ++i) result[i] += scale * x[i];
  return result;
}

/// Solves K u = f at rest with some dofs held at zero.
inline std::vector<double> solve(const Solid& solid, const std::vector<double>& f, const std::vector<bool>& held,
                                 double tolerance = 1e-13) {
  const std::vector<double> rest(f.size(), 0.0);
  auto inverse = solid.tangent_diagonal(rest);
  std::vector<double> u(f.size(), 0.0), b(f);
  for (std::size_t d = 0; d < f.size(); ++d) {
    inverse[d] = held[d] ? 0.0 : 1.0 / inverse[d];
    if (held[d]) b[d] = 0.0;
  }
  const LinearOperator K = [&](std::span<const double> x, std::span<double> y) {
    solid.tangent_action(rest, x, y);
    for (std::size_t d = 0; d < y.size(); ++d)
      if (held[d]) y[d] = x[d];
  };
  EXPECT_TRUE(ConjugateGradients().solve(K, inverse, b, u, tolerance, 0.0, 20000).converged);
  return u;
}

/// Displacements u_0 on the dofs that are held, and where a linear solid is in equilibrium with them on the others.
inline std::vector<double> relaxed(const Solid& solid, const std::vector<double>& u_0, const std::vector<bool>& held,
                                   double tolerance = 1e-9) {
  return sum(-1.0, solve(solid, internal_force(solid, u_0), held, tolerance), u_0);
}

/// K(u) x is the central difference of F along x.
inline void expect_tangent_is_derivative(const Solid& solid, const std::vector<double>& u, const std::vector<double>& x,
                                         const PointStep& step) {
  const double h = 1e-6;  // truncation h^2 F''' / 6 of strains of some 10 %, round-off 1e-14 / h
  std::vector<double> plus(u.size()), minus(u.size()), Kx(u.size());
  solid.internal_force(sum(h, x, u), plus, step);
  solid.internal_force(sum(-h, x, u), minus, step);
  solid.tangent_action(u, x, Kx, step);
  for (std::size_t d = 0; d < u.size(); ++d)
    EXPECT_NEAR((plus[d] - minus[d]) / (2 * h), Kx[d], 1e-6 * largest(Kx)) << d;
}

}  // namespace carom::test
