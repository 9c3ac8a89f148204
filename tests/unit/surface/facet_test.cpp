// Geometry of facets: shape functions, normals, closest points, intersections with lines.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "math/vec3.hpp"
#include "surface/bilinear_patch.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facet_projection.hpp"

namespace carom::contact_facet_test {
namespace {

constexpr double round_off = 1e-13;  // some hundred operations on numbers of order 1, 2^-53 each

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937 generator_;
};

double distance(const Vec3& a, const Vec3& b) {
  return norm(subtract(a, b));
}

/// A facet of unit size with its nodes moved at random by up to `warp`; segments stay in their plane.
PlacedFacet random_facet(int size, double warp, Random& random) {
  PlacedFacet facet{{}, size};
  if (size == 2) facet.x = {{{-0.5, 0, 0}, {0.5, 0, 0}}};
  if (size == 3) facet.x = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  if (size == 4) facet.x = {{{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}};
  for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a) {
    facet.x[a] = add(facet.x[a], random.vector(warp));
    if (size == 2) facet.x[a][2] = 0.0;
  }
  return facet;
}

/// A point of the facet, fractions in [0, 1].
ParentPoint parent_point(int size, double s, double t) {
  if (size == 4) return {2 * s - 1, 2 * t - 1};
  if (size == 3) return {s, t * (1 - s)};
  return {2 * s - 1, 0};
}

/// Least distance over a grid of (n + 1)^2 points of the facet: never below the distance of the facet.
double sampled_distance(const PlacedFacet& facet, const Vec3& x, int n) {
  double least = INFINITY;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const ParentPoint point = parent_point(facet.size, static_cast<double>(i) / n, static_cast<double>(j) / n);
      least = std::min(least, distance(x, facet_position(facet, point.xi, point.eta)));
    }
  }
  return least;
}

TEST(FacetGeometry, ShapeFunctionsSumToOneAndInterpolateTheNodes) {
  Random random(1);
  for (const int size : {1, 2, 3, 4}) {
    const PlacedFacet facet = random_facet(size, 0.3, random);
    const FacetShape shape = facet_shape(size, 0.3, -0.2);
    EXPECT_NEAR(shape.N[0] + shape.N[1] + shape.N[2] + shape.N[3], 1.0, round_off);
    const FacetShape plus = facet_shape(size, 0.8, -0.2), minus = facet_shape(size, -0.2, -0.2);
    const FacetShape up = facet_shape(size, 0.3, 0.3), down = facet_shape(size, 0.3, -0.7);
    for (std::size_t a = 0; a < 4; ++a) {  // linear in each coordinate: differences are exact for any step
      EXPECT_NEAR(shape.dN_dxi[a], plus.N[a] - minus.N[a], round_off);
      EXPECT_NEAR(shape.dN_deta[a], up.N[a] - down.N[a], round_off);
    }
    const std::array<ParentPoint, 4> nodes = size == 3
                                                 ? std::array<ParentPoint, 4>{{{0, 0}, {1, 0}, {0, 1}}}
                                                 : std::array<ParentPoint, 4>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a)
      EXPECT_NEAR(distance(facet_position(facet, nodes[a].xi, nodes[a].eta), facet.x[a]), 0.0, round_off);
  }
}

TEST(FacetGeometry, NormalsPointOutwardsAndJacobiansGiveTheMeasure) {
  // The lower edge of a counter-clockwise cell points to +x; its outward normal is -y (facet.hpp).
  const PlacedFacet segment{{{{1, 2, 0}, {4, 2, 0}}}, 2};
  const FacetFrame on_segment = facet_frame(segment, 0.0, 0.0);
  EXPECT_EQ(on_segment.normal, (Vec3{0, -1, 0}));
  EXPECT_EQ(2.0 * on_segment.jacobian, 3.0);
  EXPECT_EQ(measure(segment), 3.0);
  const PlacedFacet triangle{{{{0, 0, 1}, {2, 0, 1}, {0, 3, 1}}}, 3};
  EXPECT_EQ(facet_frame(triangle, 0.2, 0.2).normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(0.5 * facet_frame(triangle, 0.2, 0.2).jacobian, 3.0);
  EXPECT_EQ(measure(triangle), 3.0);
  const PlacedFacet quad{{{{0, 0, 0}, {0, 2, 0}, {0, 3, 1}, {0, 1, 1}}}, 4};  // parallelogram, base 2, height 1, in y-z
  EXPECT_NEAR(distance(facet_frame(quad, 0.4, -0.7).normal, {1, 0, 0}), 0.0, round_off);
  EXPECT_NEAR(4.0 * facet_frame(quad, 0.4, -0.7).jacobian, 2.0, round_off);
  EXPECT_NEAR(measure(quad), 2.0, round_off);
  EXPECT_EQ(measure({{{{1, 1, 1}}}, 1}), 1.0);
}

TEST(FacetGeometry, CollapsedEdgeTakesTheNormalOfTheCentre) {
  const PlacedFacet quad{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}}, 4};
  EXPECT_EQ(facet_frame(quad, 0.3, 1.0).normal, (Vec3{0, 0, 1}));
}

/// The skin of the box [0, a] x [0, b] x [0, c], node number x + 2 y + 4 z, normals outwards.
struct BoxSkin {
  std::vector<Vec3> x;
  std::vector<Facet> facets;
  explicit BoxSkin(const Vec3& size) {
    for (int n = 0; n < 8; ++n) x.push_back({size[0] * (n & 1), size[1] * (n >> 1 & 1), size[2] * (n >> 2)});
    for (const std::array<Index, 4>& node :
         {std::array<Index, 4>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
      facets.push_back({node, 4});
  }
};

TEST(FacetGeometry, NodalNormalsWeighFacetsByArea) {
  // Faces of areas bc, ca, ab meet at a corner, and each gives it a quarter.
  const BoxSkin box({1, 2, 3});
  std::vector<Vec3> normals;
  nodal_normals(box.facets, box.x, normals);
  EXPECT_NEAR(distance(normals[7], normalized({6, 3, 2})), 0.0, round_off);
  EXPECT_NEAR(distance(normals[0], normalized({-6, -3, -2})), 0.0, round_off);
  // Two segments of lengths 3 and 1 at a right angle; triangles of areas 1 (in x-y) and 2 (in y-z).
  const std::vector<Vec3> x{{-3, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  nodal_normals(std::vector<Facet>{{{0, 1}, 2}, {{1, 2}, 2}}, x, normals);
  EXPECT_NEAR(distance(normals[1], normalized({1, -3, 0})), 0.0, round_off);
  const std::vector<Vec3> y{{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, 2}};
  nodal_normals(std::vector<Facet>{{{0, 2, 1}, 3}, {{0, 1, 3}, 3}}, y, normals);
  EXPECT_NEAR(distance(normals[1], normalized({2, 0, 1})), 0.0, round_off);
  // A sheet folded on itself has no normal.
  nodal_normals(std::vector<Facet>{{{0, 2, 1}, 3}, {{0, 1, 2}, 3}}, y, normals);
  EXPECT_EQ(normals[1], Vec3{});
}

TEST(Projection, IsTheGlobalMinimumAgainstBruteForce) {
  Random random(2);
  for (const int size : {1, 2, 3, 4}) {
    for (int trial = 0; trial < 300; ++trial) {
      // Up to a warp of 0.5, where quadrilaterals are folded, and to distances of many sizes.
      const PlacedFacet facet = random_facet(size, random(0.0, 0.5), random);
      const Vec3 x = random.vector(trial % 3 == 0 ? 5.0 : 1.0);
      const Projection found = project(facet, x);
      EXPECT_NEAR(distance(found.point, facet_position(facet, found.xi, found.eta)), 0.0, round_off);
      EXPECT_NEAR(found.distance, distance(x, found.point), round_off);
      EXPECT_NEAR(found.gap, dot(subtract(x, found.point), found.normal), round_off);
      const double sampled = sampled_distance(facet, x, size == 1 ? 1 : 60);
      EXPECT_LE(found.distance, sampled + round_off);
      // Edges are at most sqrt(6) long; the nearest sample is half a 60th of two of them away, or less.
      EXPECT_GE(found.distance, sampled - std::sqrt(6.0) / 60);
      for (const double n : found.N) EXPECT_GE(n, -round_off);
    }
  }
}

TEST(Projection, NewtonAndStationaryPointsGiveTheSameDistance) {
  Random random(3);
  for (int trial = 0; trial < 3000; ++trial) {
    const PlacedFacet facet = random_facet(4, random(0.0, 0.5), random);
    const BilinearPatch patch(facet);
    const Vec3 x = random.vector(trial % 2 == 0 ? 0.7 : 4.0);
    const ParentPoint one = closest_point(patch, x), other = closest_of_stationary_points(patch, x);
    // The roots of the quintic are good to the root of the round-off at least; the distance is stationary there.
    EXPECT_NEAR(distance(x, patch.at(one.xi, one.eta)), distance(x, patch.at(other.xi, other.eta)), 1e-12);
  }
}

TEST(Projection, PointAboveTheCentreOfASaddleFindsBothArms) {
  // Nodes up, down, up, down: z = -w xi eta. From (0, 0, -h) far below, the closest points lie at the two low corners
  // or on the line xi = eta: |x|^2 = 2 s^2 / 4 + (h - w s^2)^2 has s^2 = (2 w h - 1 / 2) / (2 w^2) where that is in [0,
  // 1].
  const double w = 0.5, h = 0.6;
  const PlacedFacet saddle{{{{-0.5, -0.5, -w}, {0.5, -0.5, w}, {0.5, 0.5, -w}, {-0.5, 0.5, w}}}, 4};
  const Projection found = project(saddle, {0, 0, -h});
  const double s_2 = (2 * w * h - 0.5) / (2 * w * w);
  EXPECT_NEAR(found.xi * found.xi, s_2, 1e-12);
  EXPECT_NEAR(found.xi, found.eta, 1e-12);
  EXPECT_NEAR(found.distance, std::sqrt(0.5 * s_2 + std::pow(h - w * s_2, 2)), round_off);
}

TEST(Projection, SaysWhereThePointLies) {
  struct Expectation {
    PlacedFacet facet;
    Vec3 x;
    ProjectionSite site;
    int feature;
  };
  const PlacedFacet segment{{{{0, 0, 0}, {1, 0, 0}}}, 2}, triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 3},
      quad{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 4};
  const auto inside = ProjectionSite::interior, edge = ProjectionSite::edge, vertex = ProjectionSite::vertex;
  const std::vector<Expectation> expectations{{{{{{1, 1, 1}}}, 1}, {0, 0, 0}, vertex, 0},
                                              {segment, {0.3, 2, 0}, inside, -1},
                                              {segment, {-1, 2, 0}, vertex, 0},
                                              {segment, {2, 2, 0}, vertex, 1},
                                              {triangle, {0.2, 0.2, 1}, inside, -1},
                                              {triangle, {-1, -1, 1}, vertex, 0},
                                              {triangle, {2, 0, 1}, vertex, 1},
                                              {triangle, {0, 2, 1}, vertex, 2},
                                              {triangle, {0.5, -1, 1}, edge, 0},
                                              {triangle, {1, 1, 1}, edge, 1},
                                              {triangle, {-1, 0.5, 1}, edge, 2},
                                              {quad, {0.5, 0.7, 1}, inside, -1},
                                              {quad, {-1, -2, 1}, vertex, 0},
                                              {quad, {2, -2, 1}, vertex, 1},
                                              {quad, {2, 3, 1}, vertex, 2},
                                              {quad, {-1, 3, 1}, vertex, 3},
                                              {quad, {0.5, -1, 1}, edge, 0},
                                              {quad, {2, 0.5, 1}, edge, 1},
                                              {quad, {0.5, 2, 1}, edge, 2},
                                              {quad, {-1, 0.5, 1}, edge, 3}};
  for (const Expectation& e : expectations) {
    SCOPED_TRACE(testing::Message() << e.facet.size << " nodes, x = " << e.x[0] << ", " << e.x[1]);
    const Projection found = project(e.facet, e.x);
    EXPECT_EQ(found.site, e.site);
    EXPECT_EQ(found.feature, e.feature);
  }
}

TEST(Projection, CollapsedQuadrilateralIsATriangle) {
  Random random(4);
  const PlacedFacet triangle = random_facet(3, 0.2, random);
  const PlacedFacet quad{{triangle.x[0], triangle.x[1], triangle.x[2], triangle.x[2]}, 4};
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x = random.vector(1.5);
    const Projection one = project(quad, x), other = project(triangle, x);
    EXPECT_NEAR(one.distance, other.distance, 1e-12);
    EXPECT_NEAR(distance(one.normal, other.normal), 0.0, 1e-12);
  }
}

TEST(Projection, GradientOfTheGapIsTheNormalTimesTheShapeFunctions) {
  Random random(5);
  const double step = 1e-6;  // central differences: truncation 1e-12 / (curvature radius)^2, round-off 1e-16 / 1e-6
  for (const int size : {2, 3, 4}) {
    for (int trial = 0; trial < 50; ++trial) {
      const PlacedFacet facet = random_facet(size, 0.15, random);
      const ParentPoint at = parent_point(size, random(0.2, 0.8), random(0.2, 0.8));
      const FacetFrame frame = facet_frame(facet, at.xi, at.eta);
      const Vec3 x = add(frame.position, scaled(frame.normal, random(-0.1, 0.1)));
      const Projection found = project(facet, x);
      ASSERT_EQ(found.site, ProjectionSite::interior);
      for (std::size_t i = 0; i < (size == 2 ? 2U : 3U); ++i) {
        Vec3 plus = x, minus = x;
        plus[i] += step;
        minus[i] -= step;
        EXPECT_NEAR((project(facet, plus).gap - project(facet, minus).gap) / (2 * step), found.normal[i], 1e-8);
        for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a) {
          PlacedFacet far = facet, near = facet;
          far.x[a][i] += step;
          near.x[a][i] -= step;
          EXPECT_NEAR((project(far, x).gap - project(near, x).gap) / (2 * step), -found.N[a] * found.normal[i], 1e-8);
        }
      }
    }
  }
}

TEST(SignedDistance, GradientHoldsOnEdgesAndVertices) {
  Random random(6);
  const double step = 1e-6;  // as above
  for (const int size : {3, 4}) {
    for (int trial = 0; trial < 50; ++trial) {
      const PlacedFacet facet = random_facet(size, 0.05, random);
      const Vec3 x{trial % 2 == 0 ? -1.0 : 0.2, -1.0, random(0.1, 0.5)};
      const Vec3 average{0, 0, 1};
      const auto gap = [&](const PlacedFacet& f, const Vec3& y) {
        return signed_distance(project(f, y), y, average, 0.0).gap;
      };
      const Projection found = project(facet, x);
      ASSERT_NE(found.site, ProjectionSite::interior);
      const Vec3 normal = signed_distance(found, x, average, 0.0).normal;
      for (std::size_t i = 0; i < 3; ++i) {
        Vec3 plus = x, minus = x;
        plus[i] += step;
        minus[i] -= step;
        EXPECT_NEAR((gap(facet, plus) - gap(facet, minus)) / (2 * step), normal[i], 1e-8);
        for (std::size_t a = 0; a < static_cast<std::size_t>(size); ++a) {
          PlacedFacet far = facet, near = facet;
          far.x[a][i] += step;
          near.x[a][i] -= step;
          EXPECT_NEAR((gap(far, x) - gap(near, x)) / (2 * step), -found.N[a] * normal[i], 1e-8);
        }
      }
    }
  }
}

/// Closest facet's signed distance to a surface by search over all facets.
SignedDistance surface_distance(const std::vector<Facet>& facets, const std::vector<Vec3>& x,
                                const std::vector<Vec3>& normals, const Vec3& y, double tiny) {
  Projection closest;
  closest.distance = INFINITY;
  std::size_t best = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Projection found = project(place(facets[f], x), y);
    if (found.distance < closest.distance) {
      closest = found;
      best = f;
    }
  }
  return signed_distance(closest, y, averaged_normal(closest, facets[best], normals), tiny);
}

TEST(SignedDistance, OfABoxHasNoHolesAtEdgesAndCorners) {
  const Vec3 half{0.5, 1.0, 1.5};
  BoxSkin box({1, 2, 3});
  std::vector<Vec3> normals, turned;
  nodal_normals(box.facets, box.x, normals);
  BoxSkin room = box;  // the same box as a hollow: every point outside of it is inside of the body
  for (Facet& facet : room.facets) std::swap(facet.node[1], facet.node[3]);
  nodal_normals(room.facets, room.x, turned);
  Random random(7);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 y = add(half, random.vector(2.5));
    // Closed form of a box's signed distance: |max(q, 0)| + min(max q_i, 0) with q = |y - centre| - half.
    Vec3 outside{};
    double deepest = -INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
      const double q = std::abs(y[i] - half[i]) - half[i];
      outside[i] = std::max(q, 0.0);
      deepest = std::max(deepest, q);
    }
    const double exact = norm(outside) + std::min(deepest, 0.0);
    const SignedDistance convex = surface_distance(box.facets, box.x, normals, y, 0.0);
    EXPECT_NEAR(convex.gap, exact, round_off);
    EXPECT_NEAR(norm(convex.normal), 1.0, round_off);
    for (std::size_t i = 0; deepest > 0.0 && i < 3; ++i)
      EXPECT_NEAR(convex.normal[i], std::copysign(outside[i] / exact, y[i] - half[i]), 1e-10);
    EXPECT_NEAR(surface_distance(room.facets, room.x, turned, y, 0.0).gap, -exact, round_off);
  }
}

TEST(SignedDistance, TakesTheAveragedNormalWhereTheDirectionIsLost) {
  const BoxSkin box({1, 1, 1});
  std::vector<Vec3> normals;
  nodal_normals(box.facets, box.x, normals);
  const Vec3 diagonal = normalized({1, 1, 1}), bisector = normalized({1, 1, 0});
  const SignedDistance corner = surface_distance(box.facets, box.x, normals, {1, 1, 1}, 1e-8);
  EXPECT_NEAR(distance(corner.normal, diagonal), 0.0, round_off);
  EXPECT_EQ(corner.gap, 0.0);
  const SignedDistance edge = surface_distance(box.facets, box.x, normals, {1 + 1e-9, 1 + 1e-9, 0.5}, 1e-8);
  EXPECT_NEAR(distance(edge.normal, bisector), 0.0, round_off);
  EXPECT_NEAR(edge.gap, std::sqrt(2.0) * 1e-9, 3e-16);  // 1 + 1e-9 is rounded to 1.1e-16
}

TEST(Intersect, FindsThePointOfTheFacetOnTheLine) {
  Random random(8);
  for (const int size : {2, 3, 4}) {
    for (int trial = 0; trial < 1000; ++trial) {
      const PlacedFacet facet = random_facet(size, 0.2, random);
      const ParentPoint at = parent_point(size, random(0.0, 1.0), random(0.0, 1.0));
      const FacetFrame frame = facet_frame(facet, at.xi, at.eta);
      Vec3 direction = random.vector(1.0);
      if (size == 2) direction[2] = 0.0;
      direction = normalized(direction);
      if (std::abs(dot(direction, frame.normal)) < 0.05) continue;  // grazing: ill-conditioned
      const double length = random(-2.0, 2.0);
      const Vec3 start = subtract(frame.position, scaled(direction, length));
      const std::optional<RayHit> hit = intersect(facet, start, direction);
      ASSERT_TRUE(hit);
      // A line may meet a warped quadrilateral twice; the hit is on both and not farther than the one it was made from.
      EXPECT_LE(std::abs(hit->distance), std::abs(length) + 1e-11);
      const Vec3 on_line = add(start, scaled(direction, hit->distance));
      EXPECT_NEAR(distance(on_line, facet_position(facet, hit->xi, hit->eta)), 0.0, 1e-11);
      if (size == 4) continue;
      EXPECT_NEAR(hit->distance, length, 1e-11);
    }
  }
}

TEST(Intersect, MissesWhatLiesBesideOrAlongTheLine) {
  const PlacedFacet segment{{{{0, 0, 0}, {1, 0, 0}}}, 2}, triangle{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 3},
      quad{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, 4},
      warped{{{{0, 0, 0}, {1, 0, 0.2}, {1, 1, 0}, {0, 1, 0.2}}}, 4};
  EXPECT_FALSE(intersect(segment, {-0.1, 5, 0}, {0, -1, 0}));
  EXPECT_FALSE(intersect(segment, {0.2, 0.3, 0}, {1, 0, 0}));
  for (const PlacedFacet& facet : {triangle, quad, warped}) {
    EXPECT_FALSE(intersect(facet, {-0.1, 0.5, 5}, {0, 0, -1}));
    EXPECT_FALSE(intersect(facet, {0.2, 0.3, 1}, {1, 0, 0}));  // passes above
  }
  EXPECT_FALSE(intersect(triangle, {0.6, 0.6, 1}, {0, 0, 1}));
  EXPECT_TRUE(intersect(triangle, {0.4, 0.4, 1}, {0, 0, 1}));
}

TEST(Intersect, LinesThroughACommonEdgeDoNotSlipThrough) {
  Random random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const PlacedFacet quad = random_facet(4, 0.2, random);
    // A triangle behind the edge from node 1 to node 2.
    const PlacedFacet triangle{{quad.x[2], quad.x[1], add({1.5, 0, 0}, random.vector(0.2))}, 3};
    const Vec3 on_edge = facet_position(quad, 1.0, random(-1.0, 1.0));
    const Vec3 direction = normalized(add({0, 0, 1}, random.vector(0.3)));
    const Vec3 start = subtract(on_edge, direction);
    EXPECT_TRUE(intersect(quad, start, direction) || intersect(triangle, start, direction));
  }
}

}  // namespace
}  // namespace carom::contact_facet_test
