// Nodes at sharp edges and corners against the formula of sharp_nodes.hpp.
#include "contact/sharp_nodes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact_rows_fixture.hpp"
#include "surface/surface_point.hpp"

namespace carom::contact_sharp_nodes_test {
namespace {

using namespace test;

// A wedge, of which one side lies flat on the face x = 0 and which points into the face above it: f_h = 0 towards the
// former, 1 towards the latter. At a depth of 1 and 1.5 behind the other face S(2 - 1.5) = 1/2, so that f^2 = 1 - 1/2.
TEST(SharpNodes, StandByHalfWhereAnotherFaceIsHalfAsFarAgain) {
  Scene scene;
  const Index n = scene.add_node({-1.5, 0, -1}), m = scene.add_node({-1.5, 1, -1}), up = scene.add_node({-1.5, 0, 0}),
              m_up = scene.add_node({-1.5, 1, 0}), out = scene.add_node({-0.5, 0, 0}),
              m_out = scene.add_node({-0.5, 1, 0});
  const std::vector<Facet> wedge{{{n, up, m_up, m}, 4}, {{n, m, m_out, out}, 4}};
  const Facet side{
      {scene.add_node({0, -1, -2}), scene.add_node({0, 1, -2}), scene.add_node({0, 1, 0}), scene.add_node({0, -1, 0})},
      4};
  const SharpNodes nodes(scene.finish(), wedge);
  ASSERT_TRUE(nodes.has(n));
  SurfacePoint met;
  met.gap = -1.0;
  met.feet.resize(1);
  met.feet[0].facet_normal = {0, 0, 1};
  std::vector<SurfacePoint> sides;
  EXPECT_EQ(nodes.stand(n, met, sides, scene.mesh.coordinates).factor, 1.0);
  const Projection p = project(place(side, scene.mesh.coordinates), scene.mesh.coordinates[n]);
  take_only(0, p, {p.normal, p.gap}, sides.emplace_back());
  EXPECT_NEAR(nodes.stand(n, met, sides, scene.mesh.coordinates).factor, std::sqrt(0.5), 1e-15);
}

// The lower corner of a box that leans by less than 20 degrees, before the upper side of another one: its factor is
// between 0 and 1, and is held, since an open row has no force that its change could work against.
TEST(SharpNodes, BeforeAFaceHaveTheFaceNormalTimesAFactorThatIsHeld) {
  Scene scene;
  const std::vector<Facet> lower = scene.add_box({0, 0, 0}, {10, 10, 10}, 2);
  const auto first = static_cast<Index>(scene.mesh.coordinates.size());
  const std::vector<Facet> upper = scene.add_box({0, 0, 0}, {3, 3, 3}, 2);
  const double a = 0.15, b = 0.2, height = 0.05;
  Index corner = -1;
  for (auto n = static_cast<std::size_t>(first); n < scene.mesh.coordinates.size(); ++n) {
    Vec3& x = scene.mesh.coordinates[n];
    if (norm(x) == 0.0) corner = static_cast<Index>(n);
    x = {x[0] * std::cos(a) - x[2] * std::sin(a), x[1], x[0] * std::sin(a) + x[2] * std::cos(a)};
    x = {4.0 + x[0], 4.0 + x[1] * std::cos(b) - x[2] * std::sin(b),
         10.0 + height + x[1] * std::sin(b) + x[2] * std::cos(b)};
  }
  PairContact contact;
  contact.method = PairMethod::faces;
  contact.slave = {upper};
  contact.master = {lower};
  contact.law.eps_N = 1.0;
  scene.finish().contacts.emplace_back(contact);
  const std::vector<double> u = scene.zero();
  const auto rows = ContactGeometry(scene.model).rows_at(u, u);
  int found = 0;
  for (std::size_t r = 0; r < rows->size(); ++r) {
    const auto k = static_cast<std::size_t>(rows->begin[r]);
    if (rows->node[k] != corner || rows->begin[r + 1] - rows->begin[r] - rows->behind[r] != 1) continue;
    ++found;
    const double factor = rows->gap_at(r, u) / height;
    EXPECT_GT(factor, 0.1);
    EXPECT_LT(factor, 0.9);
    EXPECT_LT(norm(subtract(rows->block[k][0], {0, 0, factor})), 1e-12);
  }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace carom::contact_sharp_nodes_test
