// Rows of rigid obstacles: gaps in closed form, their gradients, measures, carriers.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "contact_rows_fixture.hpp"

namespace carom::contact_obstacles_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // positions below 10, some ten operations
// Central differences with steps h of gaps of curvature below 100: error 1e-16 * 10 / h + 100^2 h^2 / 6.
constexpr double step = 1e-6, slope_error = 1e-8;

ObstacleContact touching(const RigidShape& shape, const std::vector<Index>& nodes) {
  ObstacleContact contact;
  contact.name = "obstacle";
  contact.shape = shape;
  contact.measure = RowMeasure::per_node;
  contact.nodes = nodes;
  contact.law.eps_N = 1.0;
  return contact;
}

/// One node at x against a shape, with a carrier when it moves.
struct OneNode {
  Scene scene;
  Index node = 0, carrier = 0;

  OneNode(const RigidShape& shape, const Vec3& x, bool moves = false) {
    node = scene.add_node(x);
    carrier = scene.add_node({0.3, 0.2, 0.1});
    ObstacleContact contact = touching(shape, {node});
    if (moves) contact.carrier = carrier;
    scene.finish().contacts.emplace_back(contact);
  }
  double gap(const std::vector<double>& u) const { return gap_of(ContactGeometry(scene.model), u, 0); }
};

struct Expected {
  RigidShape shape;
  Vec3 x;
  double gap;
};

/// Gaps from elementary geometry: 3-4-5 and 2-3-6-7 triangles and boxes.
std::vector<Expected> gaps_by_hand() {
  const Box box{{0, 0, 0}, {2, 4, 6}};
  return {
      {Plane{{0, 0, 1}, {0, 0.6, 0.8}}, {7, 1, 2}, 1.4},
      {Sphere{{1, 1, 1}, 2.0}, {3, 4, 7}, 5.0},
      {Sphere{{1, 1, 1}, 2.0}, {1, 1, 2.5}, -0.5},
      {Sphere{{1, 1, 1}, 8.0, true}, {3, 4, 7}, 1.0},
      {Sphere{{1, 1, 1}, 2.0, true}, {3, 4, 7}, -5.0},
      {Cylinder{{1, 1, 0}, {0, 0, 1}, 2.0}, {4, 5, 9}, 3.0},
      {Cylinder{{1, 1, 0}, {0, 0, 1}, 6.0}, {4, 5, -9}, -1.0},
      {Cylinder{{1, 1, 0}, {0, 0, 1}, 6.0, true}, {4, 5, 9}, 1.0},
      {Cylinder{{0, 0, 0}, {0.6, 0.8, 0}, 1.0}, {-4, 3, 12}, 12.0},
      {box, {1, 2, 7}, 1.0},      // face
      {box, {5, 8, 3}, 5.0},      // edge
      {box, {-2, -3, 12}, 7.0},   // corner
      {box, {0.5, 2, 3}, -0.5},   // inside
      {box, {1.2, 3.9, 3}, -0.1}  // inside, another face
  };
}

TEST(RigidShapes, HaveTheGapsOfElementaryGeometry) {
  for (const Expected& e : gaps_by_hand()) {
    const OneNode one(e.shape, e.x);
    EXPECT_NEAR(one.gap(one.scene.zero()), e.gap, round_off) << testing::PrintToString(e.x);
  }
}

TEST(RigidShapes, HaveNormalsThatAreTheGradientOfTheGap) {
  Random random(3);
  for (const Expected& e : gaps_by_hand()) {
    const OneNode one(e.shape, e.x, true);
    const ContactGeometry contact(one.scene.model);
    for (int trial = 0; trial < 10; ++trial) {
      std::vector<double> u = with_displacement(one.scene.zero(), one.node, random.vector(0.04));
      u = with_displacement(u, one.carrier, random.vector(0.04));
      EXPECT_LT(gradient_error(contact, u, step), slope_error) << testing::PrintToString(e.x);
    }
  }
}

// The row's stored gap is at zero displacement, so that gap + G u is the exact gap where it was made.
TEST(RigidShapes, FollowTheirCarrier) {
  for (const Expected& e : gaps_by_hand()) {
    const OneNode one(e.shape, e.x, true);
    const Vec3 shift{0.7, -0.4, 0.9};
    std::vector<double> u = with_displacement(one.scene.zero(), one.carrier, shift);
    u = with_displacement(u, one.node, shift);
    EXPECT_NEAR(one.gap(u), e.gap, round_off) << testing::PrintToString(e.x);
    const auto rows = ContactGeometry(one.scene.model).rows_at(u, u);
    const Resultant sum = resultant(one.scene, *rows, 0, {1.0, 2.0, -3.0}, u);
    EXPECT_LT(norm(sum.force), round_off);
  }
}

TEST(RigidShapes, OnlyPlanesAreFixed) {
  for (const Expected& e : gaps_by_hand()) {
    const OneNode one(e.shape, e.x, true);
    EXPECT_EQ(ContactGeometry(one.scene.model).is_fixed(), std::holds_alternative<Plane>(e.shape));
  }
}

double total_measure(const Surface& surface, Scene& scene) {
  ObstacleContact contact;
  contact.name = "obstacle";
  contact.surface = surface;
  scene.finish().contacts.emplace_back(contact);
  const auto rows = ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero());
  return std::accumulate(rows->measure.begin(), rows->measure.end(), 0.0);
}

TEST(ObstacleMeasures, SumToTheAreaOfEverySection) {
  for (const bool triangles : {false, true}) {
    Scene scene;
    const auto skewed = [](double s, double t) { return Vec3{2 * s + t, 3 * t, 0.0}; };
    EXPECT_NEAR(total_measure({scene.add_patch(3, 2, skewed, triangles)}, scene), 6.0, round_off);
  }
  const auto edges = [](Scene& scene) {  // from (1, 0) to (4, 4): length 5, mean radius 2.5
    std::vector<Facet> facets;
    Index last = scene.add_node({1, 0, 0});
    for (const double s : {0.2, 0.7, 1.0}) {
      const Index next = scene.add_node({1 + 3 * s, 4 * s, 0});
      facets.push_back({{last, next, -1, -1}, 2});
      last = next;
    }
    return facets;
  };
  Scene strip, ring, bar;
  EXPECT_NEAR(total_measure({edges(strip), Section::plane_strain, 0.5}, strip), 2.5, round_off);
  EXPECT_NEAR(total_measure({edges(ring), Section::axisymmetric}, ring), 2 * std::numbers::pi * 2.5 * 5, 1e-12);
  const Facet end{{bar.add_node({0, 0, 0}), -1, -1, -1}, 1};
  EXPECT_EQ(total_measure({{end}, Section::bar, 0.25}, bar), 0.25);
}

/// A node near the skin of a box as a rigid surface of 2 x 2 facets per side.
struct NearBox {
  Scene scene;
  Index node, carrier;
  std::unique_ptr<ContactGeometry> contact;

  NearBox() {
    node = scene.add_node({0, 0, 0});
    carrier = scene.add_node({9, 9, 9});
    const Surface skin{scene.add_box({-1, -1, -1}, {1, 1, 1}, 2)};
    ObstacleContact obstacle = touching(RigidSurface{skin}, {node});
    obstacle.carrier = carrier;
    scene.finish().contacts.emplace_back(obstacle);
    contact = std::make_unique<ContactGeometry>(scene.model);
  }
};

// The box in closed form is the reference; facets are of size 1, which is how far the search looks.
TEST(RigidSurfaces, OfABoxHaveTheGapsOfTheBox) {
  NearBox near;
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 x = random.vector(1.5);
    const OneNode reference(Box{{-1, -1, -1}, {1, 1, 1}}, x);
    const double expected = reference.gap(reference.scene.zero());
    const double gap = gap_of(*near.contact, with_displacement(near.scene.zero(), near.node, x), 0);
    if (expected <= 1.0) {
      EXPECT_NEAR(gap, expected, round_off) << testing::PrintToString(x);
    }
  }
}

TEST(RigidSurfaces, HaveNormalsThatAreTheGradientOfTheGap) {
  NearBox near;
  Random random(7);
  int checked = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Vec3 x = random.vector(1.5);
    std::array<double, 3> to_face{};
    for (std::size_t c = 0; c < 3; ++c) to_face[c] = 1.0 - std::abs(x[c]);
    std::sort(to_face.begin(), to_face.end());
    // away from the kinks: the skeleton inside, corners outside (curvature 1 / gap)
    const bool is_inside = to_face[0] > 0.0;
    if (is_inside ? to_face[1] - to_face[0] < 0.01 : to_face[0] > -0.05) continue;
    std::vector<double> u = with_displacement(near.scene.zero(), near.node, x);
    const Vec3 shift = random.vector(3.0);
    for (const Index n : {near.node, near.carrier}) u = with_displacement(u, n, shift);
    EXPECT_LT(gradient_error(*near.contact, u, step), slope_error) << testing::PrintToString(x);
    ++checked;
  }
  EXPECT_GT(checked, 200);
}

// A step from above a thin sheet to far below it.
TEST(RigidSurfaces, AreNotCrossedWithinAStep) {
  Scene scene;
  const Index node = scene.add_node({0.3, 0.4, 0.1});
  const Surface sheet{scene.add_patch(4, 4, [](double s, double t) { return Vec3{s, t, 0}; })};
  scene.finish().contacts.emplace_back(touching(RigidSurface{sheet}, {node}));
  const ContactGeometry contact(scene.model);
  const std::vector<double> begin = scene.zero(), end = with_displacement(begin, node, {0.1, 0.1, -3.0});
  const auto rows = contact.rows_at(begin, end);
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_NEAR(rows->gap_at(0, end), -2.9, round_off);
  EXPECT_EQ(contact.rows_at(end, end)->size(), 0U);    // that it was in front is what counts
  EXPECT_EQ(contact.rows_at(end, begin)->size(), 1U);  // near again
  EXPECT_GT(contact.rows_at(end, begin)->gap_at(0, begin), 0.0);
}

TEST(InitialPenetrations, AreListedWorstFirstAndTakenOff) {
  Scene scene;
  const std::vector<Index> nodes{scene.add_node({0, 0, 0.5}), scene.add_node({1, 0, -0.25}),
                                 scene.add_node({2, 0, -0.75})};
  ObstacleContact contact = touching(Plane{}, nodes);
  contact.initial = InitialPenetration::strain_free_offset;
  scene.finish().contacts.emplace_back(contact);
  contact.initial = InitialPenetration::prestress;
  scene.model.contacts.emplace_back(contact);
  ContactGeometry geometry(scene.model);
  const std::vector<Penetration> found = geometry.initial_penetrations(scene.zero());
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].slot, 2);
  EXPECT_EQ(found[1].slot, 5);
  EXPECT_EQ(found[1].contact, 1);
  EXPECT_EQ(found[0].depth, 0.75);
  EXPECT_EQ(found[3].depth, 0.25);
  EXPECT_EQ(found[0].position, (Vec3{2, 0, -0.75}));
  geometry.set_initial(scene.zero());
  const auto rows = geometry.rows_at(scene.zero(), scene.zero());
  EXPECT_EQ(rows->gap, (std::vector<double>{0.5, 0.0, 0.0, 0.5, -0.25, -0.75}));
}

}  // namespace
}  // namespace carom::contact_obstacles_test
