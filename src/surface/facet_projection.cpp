#include "surface/facet_projection.hpp"

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "surface/bilinear_patch.hpp"

namespace carom {
namespace {

/// Where a projection lies: an edge or a node of the facet, or -1 for its inside.
struct Site {
  ProjectionSite site = ProjectionSite::interior;
  int feature = -1;
};

Projection finish(const PlacedFacet& facet, const Vec3& x, double xi, double eta, const Site& site) {
  const FacetShape shape = facet_shape(facet.size, xi, eta);
  const FacetFrame frame = facet_frame(facet, shape);
  const Vec3 r = subtract(x, frame.position);
  return {xi,
          eta,
          shape.N,
          frame.position,
          frame.a_1,
          frame.a_2,
          frame.normal,
          dot(r, frame.normal),
          std::sqrt(dot(r, r)),
          site.site,
          site.feature};
}

Projection project_on_segment(const PlacedFacet& facet, const Vec3& x) {
  const Vec3 d = subtract(facet.x[1], facet.x[0]);
  const double s = std::clamp(dot(subtract(x, facet.x[0]), d) / dot(d, d), 0.0, 1.0);
  if (s == 0.0) return finish(facet, x, -1.0, 0.0, {ProjectionSite::vertex, 0});
  if (s == 1.0) return finish(facet, x, 1.0, 0.0, {ProjectionSite::vertex, 1});
  return finish(facet, x, 2.0 * s - 1.0, 0.0, {});
}

/// Ericson 2005, section 5.1.5: the Voronoi regions of the vertices, then of the edges, then of the face.
Projection project_on_triangle(const PlacedFacet& facet, const Vec3& x) {
  const auto& [a, b, c, unused] = facet.x;
  const Vec3 ab = subtract(b, a), ac = subtract(c, a);
  const Vec3 ap = subtract(x, a), bp = subtract(x, b), cp = subtract(x, c);
  const double d_1 = dot(ab, ap), d_2 = dot(ac, ap);
  if (d_1 <= 0.0 && d_2 <= 0.0) return finish(facet, x, 0.0, 0.0, {ProjectionSite::vertex, 0});
  const double d_3 = dot(ab, bp), d_4 = dot(ac, bp);
  if (d_3 >= 0.0 && d_4 <= d_3) return finish(facet, x, 1.0, 0.0, {ProjectionSite::vertex, 1});
  const double d_5 = dot(ab, cp), d_6 = dot(ac, cp);
  if (d_6 >= 0.0 && d_5 <= d_6) return finish(facet, x, 0.0, 1.0, {ProjectionSite::vertex, 2});
  const double v_c = d_1 * d_4 - d_3 * d_2;
  if (v_c <= 0.0 && d_1 >= 0.0 && d_3 <= 0.0)
    return finish(facet, x, d_1 / (d_1 - d_3), 0.0, {ProjectionSite::edge, 0});
  const double v_b = d_5 * d_2 - d_1 * d_6;
  if (v_b <= 0.0 && d_2 >= 0.0 && d_6 <= 0.0)
    return finish(facet, x, 0.0, d_2 / (d_2 - d_6), {ProjectionSite::edge, 2});
  const double v_a = d_3 * d_6 - d_5 * d_4;
  if (v_a <= 0.0 && d_4 >= d_3 && d_5 >= d_6) {
    const double w = (d_4 - d_3) / ((d_4 - d_3) + (d_5 - d_6));
    return finish(facet, x, 1.0 - w, w, {ProjectionSite::edge, 1});
  }
  const double sum = v_a + v_b + v_c;
  return finish(facet, x, v_b / sum, v_c / sum, {});
}

Site site_on_quad(const ParentPoint& point) {
  const bool on_xi = std::abs(point.xi) == 1.0, on_eta = std::abs(point.eta) == 1.0;
  if (on_xi && on_eta) {
    if (point.eta < 0.0) return {ProjectionSite::vertex, point.xi < 0.0 ? 0 : 1};
    return {ProjectionSite::vertex, point.xi < 0.0 ? 3 : 2};
  }
  if (on_xi) return {ProjectionSite::edge, point.xi < 0.0 ? 3 : 1};
  if (on_eta) return {ProjectionSite::edge, point.eta < 0.0 ? 0 : 2};
  return {};
}

/// det [u v w]
double triple(const Vec3& u, const Vec3& v, const Vec3& w) {
  return dot(u, cross(v, w));
}

/// Parallel to the facet within round-off: the volume of the three directions against the product of their lengths.
constexpr double parallel = 1e-14;

/// Cramer's rule for x_0 + xi e_1 + eta e_2 = start + distance * direction.
std::optional<RayHit> solve_line(const Vec3& x_0, const Vec3& e_1, const Vec3& e_2, const Vec3& start,
                                 const Vec3& direction) {
  const double det = triple(e_1, e_2, direction);
  if (!(det * det > parallel * parallel * dot(e_1, e_1) * dot(e_2, e_2))) return std::nullopt;
  const Vec3 r = subtract(start, x_0);
  return RayHit{triple(r, e_2, direction) / det, triple(e_1, r, direction) / det, -triple(e_1, e_2, r) / det};
}

std::optional<RayHit> intersect_segment(const PlacedFacet& facet, const Vec3& start, const Vec3& direction,
                                        double slack) {
  const Vec3 centre = scaled(add(facet.x[0], facet.x[1]), 0.5), half = scaled(subtract(facet.x[1], facet.x[0]), 0.5);
  std::optional<RayHit> hit = solve_line(centre, half, {0.0, 0.0, 1.0}, start, direction);
  if (!hit || std::abs(hit->xi) > 1.0 + slack) return std::nullopt;
  hit->eta = 0.0;
  return hit;
}

std::optional<RayHit> intersect_triangle(const PlacedFacet& facet, const Vec3& start, const Vec3& direction,
                                         double slack) {
  const std::optional<RayHit> hit =
      solve_line(facet.x[0], subtract(facet.x[1], facet.x[0]), subtract(facet.x[2], facet.x[0]), start, direction);
  if (!hit || hit->xi < -slack || hit->eta < -slack || hit->xi + hit->eta > 1.0 + slack) return std::nullopt;
  return hit;
}

std::optional<RayHit> intersect_quad(const PlacedFacet& facet, const Vec3& start, const Vec3& direction, double slack) {
  // In axes with z along the line and the origin at its start.
  const bool along_x = std::abs(direction[0]) > 0.5;
  const Vec3 e_1 = normalized(cross(direction, along_x ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0}));
  const Vec3 e_2 = cross(direction, e_1);
  PlacedFacet seen{{}, 4};
  for (std::size_t a = 0; a < 4; ++a) {
    const Vec3 r = subtract(facet.x[a], start);
    seen.x[a] = {dot(r, e_1), dot(r, e_2), dot(r, direction)};
  }
  const BilinearPatch patch(seen);
  std::array<ParentPoint, 2> points;
  const int count = points_over(patch, 0.0, 0.0, points);
  std::optional<RayHit> best;
  for (int i = 0; i < count; ++i) {
    const auto [xi, eta] = points[static_cast<std::size_t>(i)];
    if (std::abs(xi) > 1.0 + slack || std::abs(eta) > 1.0 + slack) continue;
    const double distance = patch.at(xi, eta)[2];
    if (!best || std::abs(distance) < std::abs(best->distance)) best = RayHit{xi, eta, distance};
  }
  return best;
}

}  // namespace

Projection project(const PlacedFacet& facet, const Vec3& x) {
  if (facet.size == 1) return finish(facet, x, 0.0, 0.0, {ProjectionSite::vertex, 0});
  if (facet.size == 2) return project_on_segment(facet, x);
  if (facet.size == 3) return project_on_triangle(facet, x);
  const ParentPoint point = closest_point(BilinearPatch(facet), x);
  return finish(facet, x, point.xi, point.eta, site_on_quad(point));
}

SignedDistance signed_distance(const Projection& closest, const Vec3& x, const Vec3& average, double tiny) {
  if (closest.site == ProjectionSite::interior) return {closest.normal, closest.gap};
  const Vec3 r = subtract(x, closest.point);
  const double along = dot(r, average);
  if (closest.distance <= tiny) return {average, along};
  const double gap = along < 0.0 ? -closest.distance : closest.distance;
  return {scaled(r, 1.0 / gap), gap};
}

Vec3 averaged_normal(const Projection& projection, const Facet& facet, std::span<const Vec3> normals) {
  Vec3 sum{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(facet.size); ++a)
    sum = add(sum, scaled(normals[facet[a]], projection.N[a]));
  const double length = norm(sum);
  return length > 0.0 ? scaled(sum, 1.0 / length) : projection.normal;
}

std::optional<RayHit> intersect(const PlacedFacet& facet, const Vec3& start, const Vec3& direction, double slack) {
  if (facet.size == 2) return intersect_segment(facet, start, direction, slack);
  if (facet.size == 3) return intersect_triangle(facet, start, direction, slack);
  return intersect_quad(facet, start, direction, slack);
}

ParentPoint perpendicular_foot(const PlacedFacet& facet, const Vec3& x, ParentPoint at) {
  constexpr double settled = 1e-9;  // step after which, shrinking as its square, none is left
  Vec3 twist{};                     // d2x / (dxi deta)
  if (facet.size == 4) twist = scaled(subtract(add(facet.x[0], facet.x[2]), add(facet.x[1], facet.x[3])), 0.25);
  for (int i = 0; i < 20; ++i) {
    const FacetFrame frame = facet_tangents(facet, facet_shape(facet.size, at.xi, at.eta));
    const Vec3 r = subtract(x, frame.position);
    const double a11 = dot(frame.a_1, frame.a_1), a22 = dot(frame.a_2, frame.a_2);
    const double a12 = dot(frame.a_1, frame.a_2) - dot(r, twist);
    const double b1 = dot(frame.a_1, r), b2 = dot(frame.a_2, r), det = a11 * a22 - a12 * a12;
    if (!(det > 0.0)) break;
    const double dxi = (a22 * b1 - a12 * b2) / det, deta = (a11 * b2 - a12 * b1) / det;
    at.xi += dxi;
    if (facet.size > 2) at.eta += deta;
    if (std::abs(dxi) + std::abs(deta) < settled) break;
  }
  return at;
}

}  // namespace carom
