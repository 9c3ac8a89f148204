#include "advise/simplex_layers.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "model/outer_facets.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/half_thickness.hpp"

namespace carom {
namespace {

bool is_simplex(const Part& part) {
  return part.type == CellType::tetra4;
}

double mean_edge(const Facet& facet, const std::vector<Vec3>& x) {
  double sum = 0.0;
  for (std::size_t a = 0; a < 3; ++a) sum += norm(subtract(x[at(facet[(a + 1) % 3])], x[at(facet[a])]));
  return sum / 3.0;
}

/// The part of each cell of each block of the mesh that is a tetrahedron of one, else -1.
std::vector<std::vector<Index>> parts_of_simplices(const Model& model) {
  std::vector<std::vector<Index>> part_of;
  for (const CellBlock& block : model.mesh->blocks) part_of.emplace_back(block.size(), -1);
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    if (!is_simplex(model.parts[p])) continue;
    std::vector<Index>& of_cell = part_of[at(model.mesh->block(model.parts[p].type) - model.mesh->blocks.data())];
    for (const Index cell : model.parts[p].cells) of_cell[at(cell)] = static_cast<Index>(p);
  }
  return part_of;
}

double extent(const Part& part, const Mesh& mesh) {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  const CellBlock& block = *mesh.block(part.type);
  for (const Index cell : part.cells)
    for (const Index n : block.nodes(cell))
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], mesh.coordinates[at(n)][c]);
        high[c] = std::max(high[c], mesh.coordinates[at(n)][c]);
      }
  return norm(subtract(high, low));
}

/// Is a component that never moves the normal of a facet?
bool is_held(const Facet& facet, const Vec3& normal, const std::vector<std::array<bool, 3>>& held) {
  for (std::size_t c = 0; c < 3; ++c) {
    constexpr double along = 0.99;
    const auto is_held_node = [&](Index n) { return held[at(n)][c]; };
    if (std::abs(normal[c]) > along && std::all_of(facet.begin(), facet.end(), is_held_node)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::vector<SimplexLayer>> simplex_layers(const Model& model,
                                                      const std::vector<std::array<bool, 3>>& held) {
  const Mesh& mesh = *model.mesh;
  std::vector<std::vector<SimplexLayer>> layers(model.parts.size());
  if (std::none_of(model.parts.begin(), model.parts.end(), is_simplex)) return layers;
  std::vector<Facet> skin;
  std::vector<Index> owner;
  const std::vector<std::vector<Index>> part_of = parts_of_simplices(model);
  double sum = 0.0, count = 0.0;
  const auto all_facets = outer_facets(model);
  for (const OuterFacet& outer : *all_facets) {
    if (outer.facet.size < 3) continue;
    const ParentPoint centre = facet_centre(outer.facet.size);
    if (is_held(outer.facet, facet_frame(place(outer.facet, mesh.coordinates), centre.xi, centre.eta).normal, held))
      continue;
    skin.push_back(outer.facet);
    owner.push_back(part_of[at(outer.cell.block)][at(outer.cell.cell)]);
    if (owner.back() < 0) continue;
    sum += mean_edge(outer.facet, mesh.coordinates);
    count += 1.0;
  }
  if (count == 0.0) return layers;
  constexpr double edges = 4.0;
  const double limit = edges * sum / count;
  const std::vector<double> half = half_thickness(mesh.coordinates, skin, {}, limit);
  std::vector<double> size;
  for (const Part& part : model.parts) size.push_back(is_simplex(part) ? extent(part, mesh) : 0.0);
  for (std::size_t f = 0; f < skin.size(); ++f) {
    if (owner[f] < 0) continue;
    constexpr double slender = 5.0;
    const std::size_t p = at(owner[f]);
    const double thickness = 2.0 * half[f], edge = mean_edge(skin[f], mesh.coordinates);
    if (slender * thickness > size[p] || thickness >= std::min(limit, edges * edge)) continue;
    const FacetFrame frame = facet_frame(place(skin[f], mesh.coordinates), 1.0 / 3.0, 1.0 / 3.0);
    const Vec3 area = cross(subtract(mesh.coordinates[at(skin[f][1])], mesh.coordinates[at(skin[f][0])]),
                            subtract(mesh.coordinates[at(skin[f][2])], mesh.coordinates[at(skin[f][0])]));
    layers[p].push_back({frame.normal, 0.5 * norm(area) * half[f], edge / thickness});
  }
  return layers;
}

double simplex_bending_ratio(double edge_to_thickness, bool is_nodal) {
  const double x = edge_to_thickness;
  return is_nodal ? 1.0 + 0.2 * x * x : 1.0 + 3.1 * std::min(x, std::pow(x, 1.8));
}

}  // namespace carom
