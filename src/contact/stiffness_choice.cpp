#include "contact/stiffness_choice.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/types.hpp"
#include "math/vec3.hpp"
#include "mesh/cell_topology.hpp"
#include "model/outer_facets.hpp"
#include "model/wave_modulus.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {

PartCells::PartCells(const Model& model) : model_(model), mesh_(*model.mesh), begin_(mesh_.node_count() + 1, 0) {
  std::vector<bool> is_outer(mesh_.node_count());
  const auto skin = outer_facets(model);
  for (const OuterFacet& outer : *skin)
    for (const Index n : outer.facet) is_outer[static_cast<std::size_t>(n)] = true;
  const auto each = [&](auto&& visit) {
    for (const Part& part : model.parts) {
      for (const Index cell : part.cells) {
        for (const Index n : nodes_of({&part, cell}))
          if (is_outer[static_cast<std::size_t>(n)]) visit(static_cast<std::size_t>(n), Cell{&part, cell});
      }
    }
  };
  each([&](std::size_t n, const Cell&) { ++begin_[n + 1]; });
  for (std::size_t n = 0; n < mesh_.node_count(); ++n) begin_[n + 1] += begin_[n];
  cells_.resize(begin_.back());
  std::vector<std::size_t> next = begin_;
  each([&](std::size_t n, const Cell& cell) { cells_[next[n]++] = cell; });
}

std::optional<Backing> PartCells::behind(const Facet& facet) const {
  std::optional<Backing> softest;
  const auto first = static_cast<std::size_t>(facet[0]);
  for (std::size_t k = begin_[first]; k < begin_[first + 1]; ++k) {
    const std::span<const Index> nodes = nodes_of(cells_[k]);
    const auto held = [&](Index n) { return std::ranges::find(nodes, n) != nodes.end(); };
    if (!std::all_of(facet.begin(), facet.end(), held)) continue;
    const Backing backing = backing_of(cells_[k], facet);
    if (!(backing.height > 0.0)) continue;
    if (!softest || backing.stiffness() < softest->stiffness()) softest = backing;
  }
  return softest;
}

std::span<const Index> PartCells::nodes_of(const Cell& cell) const {
  const auto size = static_cast<std::size_t>(node_count(cell.part->type));
  return std::span(mesh_.block(cell.part->type)->connectivity)
      .subspan(size * static_cast<std::size_t>(cell.number), size);
}

namespace {

/// How many times the mean distance of all corners from the facet that of the corners is which are not on it: 2 of a
/// hexahedron, 4 of a tetrahedron. Half of that in a quadratic cell, where there are nodes in the middle.
double share_of_height(CellType type, std::span<const Index> nodes, const Facet& facet) {
  const auto corners = static_cast<double>(corner_count(type));
  for (const CellFace& face : cell_faces(type)) {
    const std::span<const LocalNode> of_face = face.nodes();
    const auto holds = [&](Index n) {
      return std::any_of(of_face.begin(), of_face.end(), [&](LocalNode a) { return nodes[a] == n; });
    };
    if (!std::all_of(facet.begin(), facet.end(), holds)) continue;
    const double others = corners - static_cast<double>(face.corners().size());
    return static_cast<double>(nodes.size()) > corners ? 0.5 * corners / others : corners / others;
  }
  return 0.0;
}

}  // namespace

Backing PartCells::backing_of(const Cell& cell, const Facet& facet) const {
  const Part& part = *cell.part;
  const std::span<const Index> nodes = nodes_of(cell);
  const std::span<const Index> corners = nodes.first(static_cast<std::size_t>(corner_count(part.type)));
  Vec3 centroid{};
  for (const Index n : corners)
    centroid = add(centroid, scaled(mesh_.coordinates[static_cast<std::size_t>(n)], 1.0 / corners.size()));
  const PlacedFacet placed = place(facet, mesh_.coordinates);
  const ParentPoint centre = facet_centre(facet.size);
  const FacetFrame frame = facet_frame(placed, centre.xi, centre.eta);
  const Vec3 inward = subtract(centroid, frame.position);
  const double mean = facet.size == 1 ? norm(inward) : std::abs(dot(inward, frame.normal));
  double size = measure(placed);
  if (part.section == Section::axisymmetric) size *= 2.0 * std::numbers::pi * frame.position[0];
  if (part.section != Section::axisymmetric && part.section != Section::solid) size *= part.thickness;
  return {wave_modulus(part), share_of_height(part.type, nodes, facet) * mean, size};
}

void refuse_choice(const std::string& contact) {
  throw std::invalid_argument(fmt::format(
      "contact \"{}\": its stiffness cannot be chosen, since no cell of a part is behind it; give a stiffness",
      contact));
}

Side side_of(const PartCells& cells, std::span<const Facet> facets, const std::string& contact) {
  Side side;
  for (const Facet& facet : facets) {
    if (const auto backing = cells.behind(facet)) side.add(*backing);
  }
  if (!(side.measure > 0.0)) refuse_choice(contact);
  return side;
}

StiffnessChoice bar_choice(const Model& model, const std::vector<std::span<const BarSide>>& sides) {
  StiffnessChoice choice;
  choice.per = "of the section over the side of the bars";
  choice.node_measure = std::numeric_limits<double>::infinity();
  for (const std::span<const BarSide> bars : sides) {
    Side& side = choice.sides.emplace_back();
    double sections = 0.0;
    for (const BarSide& bar : bars) {
      const Part& part = model.parts[static_cast<std::size_t>(bar.part)];
      const double length = norm(subtract(model.mesh->coordinates[bar.node[1]], model.mesh->coordinates[bar.node[0]]));
      side.add({wave_modulus(part), length, 2.0 * bar.radius * length});
      sections += part.thickness;
    }
    choice.node_measure = std::min(choice.node_measure, sections / side.measure);
  }
  return choice;
}

}  // namespace carom
