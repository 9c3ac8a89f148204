// Rows of obstacles that turn: gaps, their gradients, and the balance of forces and moments.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "contact_rows_fixture.hpp"
#include "turning_body_fixture.hpp"

namespace carom::contact_turning_obstacles_test {
namespace {

using namespace test;

// Central differences with steps of 1e-6 of gaps of curvature below 100: 1e-16 * 10 / 1e-6 + 100^2 1e-12 / 6.
constexpr double step = 1e-6, slope_error = 1e-8;

struct Placed {
  RigidShape shape;
  Vec3 x;
};

/// A node near every kind of shape, away from its kinks.
std::vector<Placed> shapes() {
  const Box box{{-1, -2, -3}, {1, 2, 3}};
  return {{Plane{{0, 0, 1}, {0, 0.6, 0.8}}, {0.7, 0.1, 1.2}},
          {Sphere{{0.1, 0.1, 0.1}, 2.0}, {1.3, 1.4, 0.7}},
          {Sphere{{0.1, 0.1, 0.1}, 2.0, true}, {1.3, 0.4, 0.7}},
          {Cylinder{{0.1, 0.1, 0}, {0.6, 0.8, 0}, 1.0}, {0.4, 0.2, 1.2}},
          {Cylinder{{0.1, 0.1, 0}, {0, 0, 1}, 3.0, true}, {1.4, 0.5, 0.9}},
          {box, {0.5, 2.3, 1.0}},
          {box, {1.3, 2.4, 1.0}},
          {box, {1.3, 2.4, 3.5}},
          {box, {0.9, 0.5, 0.5}}};
}

/// A node against a shape that hangs on a body whose axes are not those of space.
struct Turning {
  Scene scene;
  Index node = 0;
  TurningBody body = make_turning_body(2.0, {0.2, -0.1, 0.3}, {1.0, 1.2, 1.4}, {0.1, -0.05, 0.07});

  explicit Turning(const Vec3& x) : node(scene.add_node(x)) { add_nodes(scene.mesh, body); }
  void close(const RigidShape& shape, RowMeasure measure = RowMeasure::per_node) {
    ObstacleContact contact;
    contact.name = "hammer";
    contact.shape = shape;
    contact.measure = measure;
    contact.nodes = {node};
    contact.law.eps_N = 1.0;
    contact.body = 0;
    scene.finish().contacts.emplace_back(contact);
    scene.model.turning_bodies.push_back(body);
  }

  /// All nodes turned by angle about n through the origin, and shifted.
  std::vector<double> turned(const Vec3& n, double angle, const Vec3& shift) const {
    std::vector<double> u;
    for (const Vec3& X : scene.mesh.coordinates) {
      const Vec3 x = add(scaled(X, std::cos(angle)),
                         add(scaled(cross(n, X), std::sin(angle)), scaled(n, dot(n, X) * (1.0 - std::cos(angle)))));
      for (std::size_t c = 0; c < 3; ++c) u.push_back(x[c] + shift[c] - X[c]);
    }
    return u;
  }
};

const Vec3 axis{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};

TEST(TurningObstacles, CarryTheGapWithThem) {
  for (const Placed& p : shapes()) {
    Turning t(p.x);
    t.close(p.shape);
    const ContactGeometry contact(t.scene.model);
    EXPECT_FALSE(contact.is_fixed());
    const double gap = gap_of(contact, t.scene.zero(), 0);
    EXPECT_GT(std::abs(gap), 0.05);
    // positions below 10, some twenty operations
    for (const double angle : {0.3, 2.0, 4.0})
      EXPECT_NEAR(gap_of(contact, t.turned(axis, angle, {1.0, -2.0, 0.5}), 0), gap, 1e-13);
  }
}

// With the nodes of the body moved at random, so that it is strained by percents as well.
TEST(TurningObstacles, HaveRowsThatAreTheGradientOfTheGap) {
  Random random(11);
  for (const Placed& p : shapes()) {
    Turning t(p.x);
    t.close(p.shape);
    const ContactGeometry contact(t.scene.model);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<double> u = t.turned(axis, random(0.0, 6.0), random.vector(2.0));
      for (std::size_t n = 0; n < t.scene.mesh.coordinates.size(); ++n)
        u = with_displacement(u, static_cast<Index>(n), random.vector(0.01));
      EXPECT_LT(gradient_error(contact, u, step), slope_error) << testing::PrintToString(p.x);
    }
  }
}

TEST(TurningObstacles, HaveRowsWithoutResultantAndMoment) {
  Random random(13);
  for (const Placed& p : shapes()) {
    Turning t(p.x);
    t.close(p.shape);
    const ContactGeometry contact(t.scene.model);
    std::vector<double> u = t.turned(axis, 2.3, {1.0, -2.0, 0.5});
    for (const Index n : t.body.nodes) u = with_displacement(u, n, random.vector(0.05));
    const auto rows = contact.rows_at(u, u);
    ASSERT_EQ(rows->size(), 1U);
    EXPECT_EQ(rows->behind[0], 4);
    const Resultant sum = resultant(t.scene, *rows, 0, {1.0, 2.0, -3.0}, u);
    EXPECT_LT(norm(sum.force), 1e-13);
    EXPECT_LT(norm(sum.moment), 1e-12);
  }
}

// The skin of a box as a surface against the box in closed form, turned alike.
TEST(TurningObstacles, RigidSurfacesTurnLikeTheirShape) {
  Random random(17);
  Turning by_surface({0, 0, 0}), by_shape({0, 0, 0});
  by_surface.close(RigidSurface{{by_surface.scene.add_box({-1, -1, -1}, {1, 1, 1}, 2)}});
  by_shape.close(Box{{-1, -1, -1}, {1, 1, 1}});
  const ContactGeometry surface(by_surface.scene.model), shape(by_shape.scene.model);
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const double angle = random(0.0, 6.0);
    const Vec3 shift = random.vector(3.0), x = random.vector(1.4);
    std::vector<double> u = by_surface.turned(axis, angle, shift), v = by_shape.turned(axis, angle, shift);
    u = with_displacement(u, by_surface.node, x);
    v = with_displacement(v, by_shape.node, x);
    const double expected = gap_of(shape, v, 0);
    if (expected > 1.0) continue;  // farther than the search looks
    EXPECT_NEAR(gap_of(surface, u, 0), expected, 1e-13);
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

}  // namespace
}  // namespace carom::contact_turning_obstacles_test
