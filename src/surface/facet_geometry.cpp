#include "surface/facet_geometry.hpp"

#include <cmath>

#include "element/quad4.hpp"
#include "math/vec3.hpp"

namespace carom {
namespace {

/// Below this part of the Jacobian at the centre a quadrilateral counts as collapsed at the point: far above the
/// round-off of the cross product, far below any cell that a solver accepts.
constexpr double collapsed = 1e-10;

/// Integral of N_a n dGamma over a facet, for each of its nodes.
std::array<Vec3, 4> node_area_vectors(const PlacedFacet& facet) {
  std::array<Vec3, 4> vectors{};
  if (facet.size == 4) {
    for (const quad4::FacePoint& point : quad4::face_points(facet.x)) {
      for (std::size_t a = 0; a < 4; ++a) vectors[a] = add(vectors[a], scaled(point.normal_dA, point.N[a]));
    }
  } else if (facet.size == 3) {
    vectors.fill(scaled(cross(subtract(facet.x[1], facet.x[0]), subtract(facet.x[2], facet.x[0])), 1.0 / 6.0));
  } else if (facet.size == 2) {
    const Vec3 d = subtract(facet.x[1], facet.x[0]);
    vectors.fill({0.5 * d[1], -0.5 * d[0], 0.0});
  }
  return vectors;
}

}  // namespace

ParentPoint facet_centre(int size) {
  if (size == 3) return {1.0 / 3.0, 1.0 / 3.0};
  return {0.0, 0.0};
}

Vec3 facet_position(const PlacedFacet& facet, double xi, double eta) {
  const FacetShape shape = facet_shape(facet.size, xi, eta);
  Vec3 position{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
    position = add(position, scaled(facet.x[a], shape.N[a]));
  return position;
}

FacetFrame facet_tangents(const PlacedFacet& facet, const FacetShape& shape) {
  FacetFrame frame;
  const auto sum = [&](std::size_t size) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t a = 0; a < size; ++a) {
        frame.position[i] += shape.N[a] * facet.x[a][i];
        frame.a_1[i] += shape.dN_dxi[a] * facet.x[a][i];
        frame.a_2[i] += shape.dN_deta[a] * facet.x[a][i];
      }
    }
  };
  if (facet.size == 4)
    sum(4);  // known to the compiler
  else
    sum(static_cast<std::size_t>(facet.size));
  if (facet.size == 2) frame.a_2 = {0.0, 0.0, 1.0};
  return frame;
}

FacetFrame facet_frame(const PlacedFacet& facet, const FacetShape& shape) {
  FacetFrame frame = facet_tangents(facet, shape);
  if (facet.size == 1) {
    frame.jacobian = 1.0;
    return frame;
  }
  const Vec3 area = cross(frame.a_1, frame.a_2);
  frame.jacobian = std::sqrt(dot(area, area));
  if (facet.size == 4) {
    const Vec3 centre = scaled(cross(subtract(facet.x[2], facet.x[0]), subtract(facet.x[3], facet.x[1])), 0.125);
    if (frame.jacobian * frame.jacobian < collapsed * collapsed * dot(centre, centre)) {
      frame.normal = normalized(centre);
      return frame;
    }
  }
  frame.normal = scaled(area, 1.0 / frame.jacobian);
  return frame;
}

double measure(const PlacedFacet& facet) {
  if (facet.size == 4) return quad4::area(facet.x);
  if (facet.size == 3) return 0.5 * norm(cross(subtract(facet.x[1], facet.x[0]), subtract(facet.x[2], facet.x[0])));
  if (facet.size == 2) return norm(subtract(facet.x[1], facet.x[0]));
  return 1.0;
}

double facet_size(const PlacedFacet& facet) {
  const double extent = measure(facet);
  return facet.size == 2 ? extent : std::sqrt(extent);
}

void nodal_normals(std::span<const Facet> surface, std::span<const Vec3> coordinates, std::vector<Vec3>& normals) {
  normals.resize(coordinates.size());
  for (const Facet& facet : surface)
    for (const Index node : facet) normals[node] = {};
  for (const Facet& facet : surface) {
    const std::array<Vec3, 4> vectors = node_area_vectors(place(facet, coordinates));
    for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
      normals[facet[a]] = add(normals[facet[a]], vectors[a]);
  }
  for (const Facet& facet : surface) {
    for (const Index node : facet) {
      const double length = norm(normals[node]);
      if (length > 0.0) normals[node] = scaled(normals[node], 1.0 / length);
    }
  }
}

}  // namespace carom
