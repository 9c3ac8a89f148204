// Which facets of a pair look at each other, against two boxes and a ball by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/vec3.hpp"
#include "mesh/skin.hpp"
#include "mesh/structured_block.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facing_facets.hpp"

namespace carom::contact_facing_test {
namespace {

/// A box of 2 x 3 x 4 cells of 1 above one of 3 x 3 x 2 cells, apart by `gap`; the pair has the whole skins.
struct TwoBoxes {
  Model model;
  PairContact pair;

  explicit TwoBoxes(double gap = 0.5) {
    StructuredBlock lower, upper;
    lower.size = {3.0, 3.0, 2.0};
    lower.divisions = {3, 3, 2};
    upper.origin = {0.3, 0.1, 2.0 + gap};
    upper.size = {2.0, 3.0, 4.0};
    upper.divisions = {2, 3, 4};
    auto mesh = std::make_shared<Mesh>(make_structured_blocks({lower, upper}));
    for (const Facet& facet : skin(*mesh))
      (facet[0] < Index{4 * 4 * 3} ? pair.master : pair.slave).facets.push_back(facet);
    model.mesh = mesh;
  }
  void place_nodes(const auto& map) {
    auto mesh = std::make_shared<Mesh>(*model.mesh);
    for (Vec3& x : mesh->coordinates) x = map(x);
    model.mesh = mesh;
  }
};

/// By an angle about the axis (1, 2, 2) / 3 (Rodrigues' formula), then far away.
Vec3 turned(const Vec3& x) {
  const Vec3 axis{1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0};
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Vec3 y = add(add(scaled(x, c), scaled(cross(axis, x), s)), scaled(axis, (1.0 - c) * dot(axis, x)));
  return add(y, {100.0, -70.0, 20.0});
}

TEST(FacingFacets, OfTwoBoxesAreTheFacesBetweenThem) {
  TwoBoxes boxes;
  ASSERT_EQ(boxes.pair.slave.facets.size(), 52U);
  ASSERT_EQ(boxes.pair.master.facets.size(), 42U);
  const FacingFacets facing = facing_facets(boxes.model, boxes.pair);
  EXPECT_EQ(facing.slave.size(), 6U);
  EXPECT_EQ(facing.master.size(), 9U);
  for (const Facet& facet : facing.slave)
    for (const Index n : facet) EXPECT_EQ(boxes.model.mesh->coordinates[static_cast<std::size_t>(n)][2], 2.5);
  boxes.place_nodes(turned);
  const FacingFacets same = facing_facets(boxes.model, boxes.pair);
  EXPECT_EQ(same.slave, facing.slave);
  EXPECT_EQ(same.master, facing.master);
}

TEST(FacingFacets, StayWhereBodiesOverlapALittle) {
  const TwoBoxes boxes(-0.1);
  const FacingFacets facing = facing_facets(boxes.model, boxes.pair);
  EXPECT_EQ(facing.slave.size(), 6U);
  EXPECT_EQ(facing.master.size(), 9U);
}

TEST(FacingFacets, AreLookedForAtTheInitialDisplacement) {
  TwoBoxes boxes;  // the upper box begins under the lower one
  InitialState below;
  for (Index n = 4 * 4 * 3; n < static_cast<Index>(boxes.model.mesh->node_count()); ++n) below.nodes.push_back(n);
  below.displacement.assign(below.nodes.size(), {0.0, 0.0, -8.0});
  boxes.model.initial.push_back(below);
  const FacingFacets facing = facing_facets(boxes.model, boxes.pair);
  ASSERT_EQ(facing.slave.size(), 6U);
  EXPECT_EQ(boxes.model.mesh->coordinates[static_cast<std::size_t>(facing.slave[0][0])][2], 6.5);
  EXPECT_EQ(boxes.model.mesh->coordinates[static_cast<std::size_t>(facing.master[0][0])][2], 0.0);
}

// What is inside out shows nothing to the other side: then every facet counts; so do those of a body with itself.
TEST(FacingFacets, AreAllWhereNoneLookAtEachOtherAndOfABodyWithItself) {
  TwoBoxes boxes;
  std::erase_if(boxes.pair.slave.facets, [&](const Facet& facet) {
    const PlacedFacet placed = place(facet, boxes.model.mesh->coordinates);
    return facet_frame(placed, 0.0, 0.0).normal[2] < 0.5;
  });
  EXPECT_EQ(facing_facets(boxes.model, boxes.pair).slave.size(), 6U);
  EXPECT_EQ(facing_facets(boxes.model, boxes.pair).master.size(), 42U);
  TwoBoxes one;
  one.pair.self = true;
  EXPECT_EQ(facing_facets(one.model, one.pair).slave.size(), 52U);
}

// The groups by normals only save comparisons: every pair of facets of a ball of skewed facets and a box, by brute
// force.
TEST(FacingFacets, AreThoseOfBruteForce) {
  TwoBoxes boxes;
  boxes.place_nodes([](const Vec3& x) {
    if (x[2] < 2.2) return x;
    const Vec3 r = subtract(x, {1.3, 1.6, 4.5});  // the upper box bulges into something round
    return add({1.3, 1.6, 4.5}, scaled(r, 2.0 / (0.3 + norm(r))));
  });
  const FacingFacets facing = facing_facets(boxes.model, boxes.pair);
  const std::vector<Vec3>& x = boxes.model.mesh->coordinates;
  const auto before = [&](const Facet& a, const Facet& b) {  // the foremost node of b before a's plane, over the slack
    const PlacedFacet at = place(a, x), of = place(b, x);
    const FacetFrame frame = facet_frame(at, 0.0, 0.0), other = facet_frame(of, 0.0, 0.0);
    double size_a = 0.0, size_b = 0.0, most = -1e300;
    for (std::size_t i = 0; i < 4; ++i) {
      size_a = std::max(size_a, norm(subtract(at.x[i], frame.position)));
      size_b = std::max(size_b, norm(subtract(of.x[i], other.position)));
      most = std::max(most, dot(frame.normal, subtract(of.x[i], frame.position)));
    }
    return most > -0.25 * (size_a + size_b) && dot(frame.normal, other.normal) < -0.1;
  };
  std::vector<Facet> slave;
  for (const Facet& a : boxes.pair.slave.facets) {
    if (std::any_of(boxes.pair.master.facets.begin(), boxes.pair.master.facets.end(),
                    [&](const Facet& b) { return before(a, b) && before(b, a); }))
      slave.push_back(a);
  }
  EXPECT_EQ(facing.slave, slave);
  EXPECT_GT(slave.size(), 6U);
  EXPECT_LT(slave.size(), 52U);
}

}  // namespace
}  // namespace carom::contact_facing_test
