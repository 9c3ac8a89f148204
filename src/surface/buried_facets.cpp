#include "surface/buried_facets.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "model/bodies.hpp"
#include "surface/cell_location.hpp"
#include "surface/facet_geometry.hpp"

namespace carom {
namespace {

constexpr double within = 5e-6;  // of a cell's width
constexpr double under = 1e-3;   // of the facet's size

/// A point of the facet off its centre and its diagonals, a little under it.
Vec3 point_under(const PlacedFacet& facet) {
  const ParentPoint at = facet.size == 3 ? ParentPoint{0.31, 0.23} : ParentPoint{0.13, facet.size == 4 ? -0.29 : 0.0};
  const FacetFrame frame = facet_frame(facet, at.xi, at.eta);
  const double size = facet.size == 2 ? measure(facet) : std::sqrt(measure(facet));
  return subtract(frame.position, scaled(frame.normal, under * size));
}

}  // namespace

std::vector<BuriedFacet> buried_facets(const Model& model, const ContactDefinition& contact,
                                       std::span<const double> u) {
  const ContactParts parts = parts_of(contact);
  if (parts.other == nullptr || parts.nature != ContactNature::touches) return {};
  const std::vector<Vec3> x = current_positions(*model.mesh, u);
  const PlacedCells cells(model, u, CellsOf::all);
  const std::vector<Index> body = bodies_of_nodes(model);
  std::vector<BuriedFacet> found;
  std::vector<Index> near;
  for (const Surface* surface : {parts.own, parts.other}) {
    for (const Facet& facet : surface->facets) {
      const Vec3 at = point_under(place(facet, x));
      cells.find(at, near);
      const auto inside_of = std::find_if(near.begin(), near.end(), [&](Index c) {
        return body[static_cast<std::size_t>(cells.nodes(static_cast<std::size_t>(c))[0])] !=
                   body[static_cast<std::size_t>(facet[0])] &&
               cells.inside(static_cast<std::size_t>(c), at, within).has_value();
      });
      if (inside_of != near.end()) found.push_back({facet, at, cells.ref(static_cast<std::size_t>(*inside_of))});
    }
    if (parts.is_self) break;
  }
  return found;
}

}  // namespace carom
