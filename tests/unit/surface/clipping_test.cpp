// Overlaps of facets: areas, consistent integrals, parent coordinates, degenerate positions.
#include "surface/clipping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "math/gauss_legendre.hpp"
#include "math/vec3.hpp"
#include "surface/facet_geometry.hpp"

namespace carom::contact_clipping_test {
namespace {

constexpr double round_off =
    1e-13;  // sums of some thousand weights below 1, 2^-53 each, relative to an area of order 1

/// With 7 points a triangle; returns their number.
int add_overlap(const PlacedFacet& slave, const PlacedFacet& master, std::vector<OverlapPoint>& points) {
  const std::size_t before = points.size();
  const OverlapColumn column(slave);
  carom::add_overlap(column, column.seen(master), {}, points);
  return static_cast<int>(points.size() - before);
}

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }

 private:
  std::mt19937 generator_;
};

/// A rotated and shifted plane in which flat facets are laid.
struct Plane {
  Vec3 origin, e_1, e_2, normal;

  explicit Plane(Random& random) : origin(random.vector(10.0)), normal(normalized(random.vector(1.0))) {
    e_1 = normalized(cross(normal, random.vector(1.0)));
    e_2 = cross(normal, e_1);
  }
  Vec3 at(double s, double t, double height = 0.0) const {
    return add(add(origin, scaled(normal, height)), add(scaled(e_1, s), scaled(e_2, t)));
  }
};

PlacedFacet flat(const Plane& plane, const std::vector<std::array<double, 2>>& corners, double height = 0.0) {
  PlacedFacet facet{{}, static_cast<int>(corners.size())};
  for (std::size_t a = 0; a < corners.size(); ++a) facet.x[a] = plane.at(corners[a][0], corners[a][1], height);
  return facet;
}

double sum_of_weights(const std::vector<OverlapPoint>& points) {
  double sum = 0.0;
  for (const OverlapPoint& point : points) sum += point.weight;
  return sum;
}

double overlap_area(const PlacedFacet& slave, const PlacedFacet& master) {
  std::vector<OverlapPoint> points;
  const int count = add_overlap(slave, master, points);
  EXPECT_EQ(static_cast<std::size_t>(count), points.size());
  return sum_of_weights(points);
}

/// Masters that cover [-1.5, 1.5]^2 of the plane with n x n quadrilaterals or twice as many triangles: turned by 0.3
/// rad against the plane's axes, inner nodes moved at random, facing the slave, on a tilted plane above it.
std::vector<PlacedFacet> covering_grid(const Plane& plane, int n, bool triangles, Random& random) {
  std::vector<Vec3> x;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double r = inner ? 0.6 / n : 0.0;
      const double u = 5.0 * i / n - 2.5 + random(-r, r), v = 5.0 * j / n - 2.5 + random(-r, r);
      const double s = std::cos(0.3) * u - std::sin(0.3) * v, t = std::sin(0.3) * u + std::cos(0.3) * v;
      x.push_back(plane.at(s, t, 0.4 + 0.1 * s - 0.2 * t));
    }
  }
  std::vector<PlacedFacet> grid;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto a = static_cast<std::size_t>(j * (n + 1) + i), b = a + 1, d = b + static_cast<std::size_t>(n),
                 c = d + 1;
      if (triangles) {
        grid.push_back({{x[a], x[d], x[b]}, 3});
        grid.push_back({{x[b], x[d], x[c]}, 3});
      } else {
        grid.push_back({{x[a], x[d], x[c], x[b]}, 4});
      }
    }
  }
  return grid;
}

std::vector<OverlapPoint> overlaps(const PlacedFacet& slave, const std::vector<PlacedFacet>& masters) {
  std::vector<OverlapPoint> points;
  for (const PlacedFacet& master : masters) add_overlap(slave, master, points);
  return points;
}

/// Convex: four points on an ellipse, counter-clockwise.
std::vector<std::array<double, 2>> random_convex(int size, double radius, Random& random) {
  std::vector<std::array<double, 2>> corners;
  const double a = radius * random(0.5, 1.0), b = radius * random(0.5, 1.0), s = random(-0.3, 0.3),
               t = random(-0.3, 0.3);
  const double start = random(0.0, 6.0);
  for (int k = 0; k < size; ++k) {
    const double angle = start + (k + random(-0.3, 0.3)) * 2 * M_PI / size;
    corners.push_back({s + a * std::cos(angle), t + b * std::sin(angle)});
  }
  return corners;
}

TEST(Overlap, AreasOverACoveringGridSumUpToTheFacet) {
  Random random(1);
  for (const int size : {3, 4}) {
    for (const bool triangles : {false, true}) {
      for (int trial = 0; trial < 20; ++trial) {
        const Plane plane(random);
        const PlacedFacet slave = flat(plane, random_convex(size, 1.0, random));
        const std::vector<PlacedFacet> grid = covering_grid(plane, 3 + trial % 9, triangles, random);
        EXPECT_NEAR(sum_of_weights(overlaps(slave, grid)) / measure(slave), 1.0, round_off);
      }
    }
  }
}

TEST(Overlap, PointsLieOnBothFacetsAndSeeTheGap) {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Plane plane(random);
    const PlacedFacet slave = flat(plane, random_convex(3 + trial % 2, 1.0, random));
    for (const PlacedFacet& master : covering_grid(plane, 4, trial % 4 < 2, random)) {
      std::vector<OverlapPoint> points;
      add_overlap(slave, master, points);
      for (const OverlapPoint& point : points) {
        const Vec3 x = facet_position(slave, point.slave.xi, point.slave.eta);
        const Vec3 y = facet_position(master, point.master.xi, point.master.eta);
        EXPECT_NEAR(norm(subtract(add(x, scaled(plane.normal, point.gap)), y)), 0.0, 1e-12);
        const Vec3 r = subtract(x, plane.origin);  // the tilted plane of covering_grid
        EXPECT_NEAR(point.gap, 0.4 + 0.1 * dot(r, plane.e_1) - 0.2 * dot(r, plane.e_2), 1e-12);
        for (const auto& [facet, at] : {std::pair{slave, point.slave}, std::pair{master, point.master}}) {
          const FacetShape shape = facet_shape(facet.size, at.xi, at.eta);
          EXPECT_NEAR(shape.N[0] + shape.N[1] + shape.N[2] + shape.N[3], 1.0, round_off);
          for (const double n : shape.N) EXPECT_GE(n, 0.0);
        }
        EXPECT_GT(point.weight, 0.0);
      }
    }
  }
}

/// Integral of N_a N_b over the slave by the points of its overlaps.
std::array<std::array<double, 4>, 4> mass_of(const PlacedFacet& slave, const std::vector<OverlapPoint>& points) {
  std::array<std::array<double, 4>, 4> mass{};
  for (const OverlapPoint& point : points) {
    const FacetShape shape = facet_shape(slave.size, point.slave.xi, point.slave.eta);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) mass[a][b] += point.weight * shape.N[a] * shape.N[b];
  }
  return mass;
}

TEST(Overlap, IntegratesTheConsistentMassOfAffineFacets) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const Plane plane(random);
    const std::vector<PlacedFacet> grid = covering_grid(plane, 5, trial % 2 == 0, random);
    // Triangle: A / 12 (1 + delta_ab). Parallelogram: A / 36 times 4, 2, 1 for the node, its neighbour, the opposite.
    const PlacedFacet triangle = flat(plane, random_convex(3, 1.0, random));
    const double s = random(-0.4, 0.4), t = random(0.3, 0.6);
    const PlacedFacet quad = flat(plane, {{-0.5 - s, -t}, {0.5 - s, -t}, {0.5 + s, t}, {-0.5 + s, t}});
    const auto of_triangle = mass_of(triangle, overlaps(triangle, grid)), of_quad = mass_of(quad, overlaps(quad, grid));
    constexpr std::array<double, 4> factor{4.0, 2.0, 1.0, 2.0};
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const double exact = a < 3 && b < 3 ? measure(triangle) / 12.0 * (a == b ? 2.0 : 1.0) : 0.0;
        EXPECT_NEAR(of_triangle[a][b], exact, 1e-12);
        EXPECT_NEAR(of_quad[a][b], measure(quad) / 36.0 * factor[(a + 4 - b) % 4], 1e-12);
      }
    }
  }
}

TEST(Overlap, OfAWarpedSlaveGivesItsTrueArea) {
  const PlacedFacet slave{{{{-0.5, -0.4, 0.1}, {0.6, -0.5, -0.1}, {0.5, 0.5, 0.1}, {-0.5, 0.6, -0.1}}}, 4};
  double area = 0.0;  // the integral of |a_1 x a_2| by 20 x 20 Gauss points: smooth, converged to round-off
  for (const QuadraturePoint& p : gauss_legendre(20))
    for (const QuadraturePoint& q : gauss_legendre(20))
      area += p.weight * q.weight * facet_frame(slave, p.x, q.x).jacobian;
  Random random(4);
  Plane plane(random);
  plane.origin = {0, 0, 0};
  plane.e_1 = {1, 0, 0};
  plane.e_2 = {0, 1, 0};
  plane.normal = {0, 0, 1};
  // The integrand is not a polynomial: the rule of degree 5 leaves an error of order 6 in the size of the triangles.
  const double coarse = sum_of_weights(overlaps(slave, covering_grid(plane, 3, false, random))) - area;
  const double fine = sum_of_weights(overlaps(slave, covering_grid(plane, 24, false, random))) - area;
  EXPECT_LT(std::abs(coarse), 1e-6);
  EXPECT_LT(std::abs(fine), 1e-10);
}

TEST(Overlap, DegeneratePositions) {
  Random random(5);
  const Plane plane(random);
  using Corners = std::vector<std::array<double, 2>>;
  const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, facing{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const auto moved = [](Corners corners, double s, double t, double scale) {
    for (auto& c : corners) c = {s + scale * c[0], t + scale * c[1]};
    return corners;
  };
  const PlacedFacet slave = flat(plane, square);
  const auto area = [&](const Corners& corners) { return overlap_area(slave, flat(plane, corners, 0.1)); };
  EXPECT_NEAR(area(facing), 1.0, round_off);                           // identical, face to face
  EXPECT_NEAR(area(square), 1.0, round_off);                           // identical, one behind the other
  EXPECT_NEAR(area(moved(facing, -1, -1, 3)), 1.0, round_off);         // slave contained
  EXPECT_NEAR(area(moved(facing, 0.25, 0.25, 0.5)), 0.25, round_off);  // master contained
  EXPECT_NEAR(area(moved(facing, 0.3, 0.4, 1)), 0.42, round_off);      // corner on corner
  EXPECT_NEAR(area(moved(facing, 0.5, 0.5, 1e-3)), 1e-6, round_off);   // a thousandth of the size
  EXPECT_NEAR(area({{0.5, -0.5}, {-0.5, 0.5}, {0.5, 1.5}, {1.5, 0.5}}), 1.0, round_off);  // its corners on the edges
  std::vector<OverlapPoint> points;
  for (const Corners& corners : {moved(facing, 1, 0, 1), moved(facing, 0, -1, 1), moved(facing, 1, 1, 1),
                                 moved(facing, 3, 0, 1), moved(facing, 1, 0.3, 1)})
    EXPECT_EQ(add_overlap(slave, flat(plane, corners, 0.1), points), 0);  // touching an edge, a corner, or nothing
  const PlacedFacet edge_on{{plane.at(0.2, 0.2), plane.at(0.8, 0.2), plane.at(0.8, 0.2, 1), plane.at(0.2, 0.2, 1)}, 4};
  EXPECT_EQ(add_overlap(slave, edge_on, points), 0);
  EXPECT_TRUE(points.empty());
  // A master tilted by 60 degrees covers half of its area.
  const double h = std::sqrt(0.75) / 2;
  const PlacedFacet tilted{{plane.at(0.2, 0.2), plane.at(0.45, 0.2, h), plane.at(0.45, 0.7, h), plane.at(0.2, 0.7)}, 4};
  EXPECT_NEAR(overlap_area(slave, tilted), 0.125, round_off);
}

TEST(Overlap, SlaveThatIsNotConvexIsSplit) {
  // An arrowhead: the square's corner (1, 1) drawn in to (0.45, 0.45), its area by the shoelace formula 0.45. The
  // Jacobian at its centre is still positive.
  const PlacedFacet arrow{{{{0, 0, 0}, {1, 0, 0}, {0.45, 0.45, 0}, {0, 1, 0}}}, 4};
  const PlacedFacet cover{{{{-1, -1, 1}, {-1, 2, 1}, {2, 2, 1}, {2, -1, 1}}}, 4};
  EXPECT_NEAR(overlap_area(arrow, cover), 0.45, round_off);
  EXPECT_NEAR(overlap_area(cover, arrow), 0.45, round_off);
}

/// Area of the intersection of two convex polygons by another way than clipping: the corners of each that lie in the
/// other and all crossings of edges, sorted by angle about their mean, by the shoelace formula.
double intersection_area(const std::vector<std::array<double, 2>>& a, const std::vector<std::array<double, 2>>& b) {
  std::vector<std::array<double, 2>> corners;
  const auto side = [](const auto& p, const auto& q, const auto& r) {
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
  };
  const auto collect = [&](const auto& from, const auto& in) {
    for (const auto& p : from) {
      bool inside = true;
      for (std::size_t i = 0; i < in.size(); ++i) inside = inside && side(in[i], in[(i + 1) % in.size()], p) >= 0.0;
      if (inside) corners.push_back(p);
    }
  };
  collect(a, b);
  collect(b, a);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const auto &p = a[i], &q = a[(i + 1) % a.size()], &r = b[j], &s = b[(j + 1) % b.size()];
      const double one = side(r, s, p), two = side(r, s, q), three = side(p, q, r), four = side(p, q, s);
      if (one * two >= 0.0 || three * four >= 0.0) continue;
      corners.push_back({p[0] + one / (one - two) * (q[0] - p[0]), p[1] + one / (one - two) * (q[1] - p[1])});
    }
  }
  if (corners.size() < 3) return 0.0;
  std::array<double, 2> mean{};
  for (const auto& c : corners) mean = {mean[0] + c[0] / corners.size(), mean[1] + c[1] / corners.size()};
  std::sort(corners.begin(), corners.end(), [&](const auto& p, const auto& q) {
    return std::atan2(p[1] - mean[1], p[0] - mean[0]) < std::atan2(q[1] - mean[1], q[0] - mean[0]);
  });
  double twice = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) twice += side(mean, corners[i], corners[(i + 1) % corners.size()]);
  return 0.5 * twice;
}

TEST(Overlap, OfRandomConvexFacetsAgainstAnotherFormula) {
  Random random(6);
  int disjoint = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Plane plane(random);
    const auto slave = random_convex(3 + trial % 2, 0.8, random);
    auto master = random_convex(3 + trial / 2 % 2, 0.8, random);
    const double s = random(-1.0, 1.0), t = random(-1.0, 1.0);
    for (auto& corner : master) corner = {corner[0] + s, corner[1] + t};
    const double exact = intersection_area(slave, master);
    std::reverse(master.begin(), master.end());
    EXPECT_NEAR(overlap_area(flat(plane, slave), flat(plane, master, -0.2)), exact, round_off);
    disjoint += exact == 0.0;
  }
  EXPECT_GT(disjoint, 20);
  EXPECT_LT(disjoint, 300);
}

TEST(Overlap, OfSegments) {
  // The slave has length 5; masters on a line that is tilted against it cover it in parts.
  const PlacedFacet slave{{{{1, 1, 0}, {4, 5, 0}}}, 2};
  const FacetFrame frame = facet_frame(slave, 0.0, 0.0);
  const Vec3 along = scaled(frame.a_1, 1.0 / 2.5);
  const auto master_node = [&](double s) {
    return add(frame.position, add(scaled(along, s), scaled(frame.normal, 0.3 + 0.1 * s)));
  };
  const std::vector<double> nodes{-4.0, -2.5, -1.1, 0.3, 0.35, 2.0, 7.0};
  std::vector<OverlapPoint> points;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    add_overlap(slave, {{master_node(nodes[i + 1]), master_node(nodes[i])}, 2}, points);
  EXPECT_EQ(points.size(), 5U * 3U);  // the first master ends where the slave begins
  const auto mass = mass_of(slave, points);
  EXPECT_NEAR(sum_of_weights(points), 5.0, round_off);
  EXPECT_NEAR(mass[0][0], 5.0 / 3.0, round_off);  // L / 6 times 2, 1
  EXPECT_NEAR(mass[0][1], 5.0 / 6.0, round_off);
  EXPECT_NEAR(mass[1][1], 5.0 / 3.0, round_off);
  for (const OverlapPoint& point : points) EXPECT_NEAR(point.gap, 0.3 + 0.1 * 2.5 * point.slave.xi, round_off);
  const PlacedFacet inside{{master_node(1.0), master_node(-1.0)}, 2};
  points.clear();
  add_overlap(slave, inside, points);
  EXPECT_NEAR(sum_of_weights(points), 2.0, round_off);
  for (const OverlapPoint& point : points) EXPECT_NEAR(point.master.xi, -2.5 * point.slave.xi, round_off);
  const PlacedFacet edge_on{{frame.position, add(frame.position, frame.normal)}, 2};
  EXPECT_EQ(add_overlap(slave, edge_on, points), 0);
}

// Behind, in the plane z = -0.1 under a slave of corners up to 1: the rule of three points a polygon for two triangles,
// and of three points for each triangle from the centroid where one of them is a quadrilateral.
TEST(Overlap, OfTheLowRuleHasThreePointsAPolygonOrATriangleOfIt) {
  const OverlapRule low{.is_high = false, .only_behind = true};
  const auto slave = [](int size) { return PlacedFacet{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, size}; };
  const PlacedFacet triangle{{{{-5, -5, -0.1}, {9, -5, -0.1}, {-5, 9, -0.1}}}, 3},
      quadrilateral{{{{-5, -5, -0.1}, {5, -5, -0.1}, {5, 5, -0.1}, {-5, 5, -0.1}}}, 4};
  const auto count = [&](int size, const PlacedFacet& master) {
    std::vector<OverlapPoint> points;
    const OverlapColumn column(slave(size));
    carom::add_overlap(column, column.seen(master), low, points);
    EXPECT_NEAR(sum_of_weights(points), size == 3 ? 0.5 : 1.0, round_off);
    return points.size();
  };
  EXPECT_EQ(count(3, triangle), 3U);
  EXPECT_EQ(count(4, triangle), 4U * 3U);
  EXPECT_EQ(count(3, quadrilateral), 3U * 3U);
  EXPECT_EQ(count(4, quadrilateral), 4U * 3U);
}

// The slave has length 5, s in [-2.5, 2.5]; the gap is a + b s. What it divides is kept where it is negative, whichever
// end that is; what it does not divide is kept.
TEST(Overlap, OfSegmentsIsCutWhereTheGapChangesItsSign) {
  const PlacedFacet slave{{{{1, 1, 0}, {4, 5, 0}}}, 2};
  const FacetFrame frame = facet_frame(slave, 0.0, 0.0);
  const Vec3 along = scaled(frame.a_1, 1.0 / 2.5);
  const auto length = [&](double a, double b) {
    const auto node = [&](double s) {
      return add(frame.position, add(scaled(along, s), scaled(frame.normal, a + b * s)));
    };
    std::vector<OverlapPoint> points;
    const OverlapColumn column(slave);
    carom::add_overlap(column, column.seen({{node(4.0), node(-4.0)}, 2}), {.only_behind = true}, points);
    return sum_of_weights(points);
  };
  EXPECT_NEAR(length(0.1, 0.1), 1.5, round_off);   // s < -1
  EXPECT_NEAR(length(0.1, -0.1), 1.5, round_off);  // s > 1
  EXPECT_NEAR(length(0.4, 0.04), 5.0, round_off);
  EXPECT_NEAR(length(0.4, -0.04), 5.0, round_off);
  EXPECT_NEAR(length(-0.4, 0.04), 5.0, round_off);
}

}  // namespace
}  // namespace carom::contact_clipping_test
