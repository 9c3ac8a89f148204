// Small bodies of every section for the tests of the solid.
#pragma once

#include <cmath>
#include <numeric>
#include <string>

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

/// One part of all cells of the mesh's block of the section's type.
inline Model body(Mesh mesh, Section section, const Material& material, double thickness = 0.7) {
  Model model;
  Part part{.name = "body",
            .cells = {},
            .material = material,
            .type = cells_of(section),
            .section = section,
            .thickness = thickness};
  part.cells.resize(mesh.block(part.type)->size());
  std::iota(part.cells.begin(), part.cells.end(), Index{0});
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.parts.push_back(std::move(part));
  return model;
}

inline Mesh distorted_mesh(Section section) {
  if (section == Section::solid) return block_mesh({2, 2, 2}, 0.2);
  return section == Section::bar ? truss_mesh() : quad_mesh(3, 3, 0.2);
}

/// One section with one law, as a test parameter.
struct Body {
  Section section;
  Material material;
};

inline std::string name_of(const Body& body) {
  static const char* const sections[] = {"Solid", "PlaneStrain", "PlaneStress", "Axisymmetric", "Bar"};
  static const char* const laws[] = {"LinearElastic", "StVenantKirchhoff", "NeoHookean"};
  return std::string(sections[static_cast<std::size_t>(body.section)]) + laws[index_of(*body.material.law)];
}

inline std::vector<Material> all_materials() {
  return {unit_material, StVenantKirchhoff{unit_material}, NeoHookean{unit_material}};
}

inline std::vector<Body> all_bodies() {
  std::vector<Body> bodies;
  for (const Section section :
       {Section::solid, Section::plane_strain, Section::plane_stress, Section::axisymmetric, Section::bar})
    for (const Material& material : all_materials()) bodies.push_back({section, material});
  return bodies;
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

}  // namespace carom::test
