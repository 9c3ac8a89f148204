// Rows of bars that touch rigid obstacles and each other with their sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact/bar_pair_rows.hpp"
#include "contact_rows_fixture.hpp"

namespace carom::contact_bars_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // positions below 10, some ten operations
// Central differences with steps h of gaps of curvature below 100: error 1e-16 * 10 / h + 100^2 h^2 / 6.
constexpr double step = 1e-6, slope_error = 1e-8;

/// A chain of bars through some points against a shape.
struct Chain {
  Scene scene;
  std::vector<Index> node;
  Index carrier = 0;

  Chain(const RigidShape& shape, const std::vector<Vec3>& points, double radius, bool is_exact = false) {
    for (const Vec3& x : points) node.push_back(scene.add_node(x));
    carrier = scene.add_node({0.3, 0.2, 0.1});
    ObstacleContact contact;
    contact.name = "obstacle";
    contact.shape = shape;
    contact.law.eps_N = 1.0;
    contact.law.hold = is_exact ? RowHold::multipliers : RowHold::springs;
    contact.carrier = carrier;
    for (std::size_t i = 0; i + 1 < node.size(); ++i) contact.bars.push_back({{node[i], node[i + 1]}, radius, 0});
    scene.finish().contacts.emplace_back(contact);
  }
  std::shared_ptr<const ConstraintRows> rows() const {
    return ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero());
  }
  double least_gap() const {
    const auto all = rows();
    double least = INFINITY;
    for (std::size_t r = 0; r < all->size(); ++r) least = std::min(least, all->gap_at(r, scene.zero()));
    return least;
  }
};

const std::vector<Vec3> zigzag{{-3.0, 0.4, 2.5}, {-1.0, -0.3, 1.9}, {1.2, 0.2, 2.2}, {2.5, 0.5, 2.0}};
const std::vector<RigidShape> shapes{Plane{{0, 0, 1}, {0, 0.6, 0.8}}, Sphere{{0, 0, 0}, 1.5},
                                     Sphere{{0, 0, 0}, 8.0, true}, Cylinder{{0, 0, 0}, {0, 1, 0}, 1.7},
                                     Box{{-1, -1, -1}, {1, 1, 1.5}}};

// By the bars' radius nearer than their axes; a point of the axis is on a row within half a piece of it.
TEST(Bars, TouchAtTheirRadius) {
  const double radius = 0.2;
  const std::vector<Vec3> along{{-3.0, 0.0, 2.0}, {3.0, 0.0, 2.0}};
  EXPECT_NEAR(Chain(Plane{{0, 0, 1}, {0, 0, 1}}, along, radius).least_gap(), 0.8, round_off);
  EXPECT_NEAR(Chain(Cylinder{{0, 0, 0}, {0, 1, 0}, 1.5}, along, radius).least_gap(), 0.3, 1.7 / 128.0);
  EXPECT_NEAR(Chain(Box{{-1, -1, -1}, {1, 1, 1}}, along, radius).least_gap(), 0.8, round_off);
  EXPECT_NEAR(Chain(Sphere{{0, 0, 0}, 5.0, true}, along, radius).least_gap(), 4.8 - std::sqrt(13.0), round_off);
  // Between its nodes, whatever the place: within a 128th of the radii.
  for (double x = -2.5; x < 2.6; x += 0.1) {
    const double gap = Chain(Sphere{{x, 0, 0}, 0.4}, along, radius).least_gap();
    EXPECT_GE(gap, 1.4 - round_off);
    EXPECT_LE(gap, 1.4 + 0.6 / 128.0);
  }
}

TEST(Bars, HaveNormalsThatAreTheGradientOfTheGap) {
  Random random(3);
  for (const RigidShape& shape : shapes) {
    const Chain chain(shape, zigzag, 0.1);
    const ContactGeometry contact(chain.scene.model);
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<double> u = with_displacement(chain.scene.zero(), chain.carrier, random.vector(0.04));
      for (const Index n : chain.node) u = with_displacement(u, n, random.vector(0.04));
      EXPECT_LT(gradient_error(contact, u, step), slope_error) << shape.index();
    }
  }
}

TEST(Bars, LeaveNoForceAndStandForTheirSides) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < zigzag.size(); ++i) length += norm(subtract(zigzag[i + 1], zigzag[i]));
  for (const RigidShape& shape : shapes) {
    const Chain chain(shape, zigzag, 0.1);
    const auto rows = chain.rows();
    EXPECT_NEAR(std::accumulate(rows->measure.begin(), rows->measure.end(), 0.0), 0.2 * length, round_off);
    for (std::size_t r = 0; r < rows->size(); ++r)
      EXPECT_LT(norm(resultant(chain.scene, *rows, r, {1.0, 2.0, -3.0}, chain.scene.zero()).force), round_off);
  }
}

// More rows than two on the two nodes of a bar would depend on each other.
TEST(Bars, AreHeldAtOnePointBetweenTheirNodes) {
  const std::vector<Vec3> over{{-3.0, 0.0, 1.6}, {3.0, 0.0, 1.6}}, beside{{0.0, -3.0, 1.6}, {0.0, 3.0, 1.6}};
  const Cylinder drum{{0, 0, 0}, {0, 1, 0}, 1.5};
  EXPECT_EQ(Chain(drum, over, 0.1, true).rows()->size(), 3U);
  EXPECT_EQ(Chain(drum, beside, 0.1, true).rows()->size(), 2U);  // along the axis its nodes say all
  EXPECT_NEAR(Chain(drum, over, 0.1, true).least_gap(), 0.0, 1.6 / 128.0);
}

TEST(Bars, ThatAreTooLongToSeeAnObstacleAreRefused) {
  EXPECT_THROW(Chain(Sphere{{0, 0, 0}, 0.01}, {{-3.0, 0.0, 2.0}, {3.0, 0.0, 2.0}}, 0.001).rows(),
               std::invalid_argument);
}

/// The least distance over a fine grid of both segments.
double least_on_grid(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  constexpr int n = 400;
  double least = INFINITY;
  for (int i = 0; i <= n; ++i) {
    const Vec3 x = add(a[0], scaled(subtract(a[1], a[0]), double(i) / n));
    for (int j = 0; j <= n; ++j)
      least = std::min(least, norm(subtract(x, add(b[0], scaled(subtract(b[1], b[0]), double(j) / n)))));
  }
  return least;
}

// No point of the grid is nearer; one is within half of its width, of lengths up to 3.5.
TEST(Segments, AreClosestWhereTheFormulasSay) {
  Random random(7);
  for (int trial = 0; trial < 40; ++trial) {
    const std::array<Vec3, 2> a{random.vector(1.0), random.vector(1.0)};
    std::array<Vec3, 2> b{random.vector(1.0), random.vector(1.0)};
    if (trial % 4 == 0) b[1] = add(b[0], scaled(subtract(a[1], a[0]), random(-1.0, 1.0)));  // parallel
    const SegmentPair pair = closest_points(a, b);
    const double grid = least_on_grid(a, b);
    EXPECT_LE(pair.distance, grid + round_off);
    EXPECT_GE(pair.distance, grid - 3.5 / 400.0);
    const Vec3 x = add(scaled(a[0], 1.0 - pair.s), scaled(a[1], pair.s)),
               y = add(scaled(b[0], 1.0 - pair.t), scaled(b[1], pair.t));
    EXPECT_LT(norm(subtract(subtract(x, y), scaled(pair.normal, pair.distance))), round_off);
  }
}

/// Two chains that cross above each other, or one chain with itself.
Model two_chains(Scene& scene, const std::vector<Vec3>& first, const std::vector<Vec3>& second, bool self,
                 bool is_exact = false) {
  PairContact pair;
  pair.name = "bars";
  pair.law.eps_N = 1.0;
  pair.law.hold = is_exact ? RowHold::multipliers : RowHold::springs;
  pair.self = self;
  const auto bars = [&](const std::vector<Vec3>& points) {
    std::vector<BarSide> made;
    Index last = -1;
    for (const Vec3& x : points) {
      const Index next = scene.add_node(x);
      if (last >= 0) made.push_back({{last, next}, 0.1, 0});
      last = next;
    }
    return made;
  };
  pair.slave_bars = bars(first);
  pair.master_bars = bars(second);
  if (self) {
    pair.slave_bars.insert(pair.slave_bars.end(), pair.master_bars.begin(), pair.master_bars.end());
    pair.master_bars = pair.slave_bars;
  }
  scene.finish().contacts.emplace_back(pair);
  return scene.model;
}

const std::vector<Vec3> low{{-1.0, 0.1, 0.0}, {0.1, 0.0, 0.0}, {1.0, -0.1, 0.0}},
    high{{0.0, -1.0, 0.25}, {0.2, 0.3, 0.24}, {-0.1, 1.0, 0.25}};

// The row's forces lie on the line between the axes: neither resultant nor moment.
TEST(BarPairs, HaveExactGradientsAndNoMoment) {
  for (const bool self : {false, true}) {
    Scene scene;
    const Model model = two_chains(scene, low, high, self);
    const ContactGeometry contact(model);
    Random random(5);
    for (int trial = 0; trial < 5; ++trial) {
      std::vector<double> u = scene.zero();
      for (Index n = 0; n < 6; ++n) u = with_displacement(u, n, random.vector(0.03));
      const auto rows = contact.rows_at(u, u);
      ASSERT_EQ(rows->size(), 4U);
      EXPECT_LT(gradient_error(contact, u, step), slope_error);
      for (std::size_t r = 0; r < rows->size(); ++r) {
        const Resultant sum = resultant(scene, *rows, r, {1.0, 0.0, 0.0}, u);
        EXPECT_LT(norm(sum.force), round_off);
        EXPECT_LT(norm(sum.moment), round_off);
      }
    }
  }
}

TEST(BarPairs, TouchAtTheSumOfTheirRadii) {
  Scene scene;
  const Model model = two_chains(scene, {{-1, 0, 0}, {1, 0, 0}}, {{0.3, -1, 0.5}, {0.3, 1, 0.5}}, false);
  EXPECT_NEAR(gap_of(ContactGeometry(model), scene.zero(), 0), 0.3, round_off);
}

// Bars of one chain do not see those that they hang together with; multipliers hold a common node once.
TEST(BarPairs, LeaveOutWhatHangsTogetherAndWhatIsSeenTwice) {
  Scene chain;
  const std::vector<Vec3> short_bars{{0, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}, {0.15, 0, 0}, {0.2, 0, 0}};
  EXPECT_EQ(ContactGeometry(two_chains(chain, short_bars, {{5, 0, 0}, {6, 0, 0}}, true))
                .rows_at(chain.zero(), chain.zero())
                ->size(),
            0U);
  for (const bool is_exact : {false, true}) {
    Scene over_node;
    const Model model =
        two_chains(over_node, {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, {{0, -1, 0.3}, {0, 1, 0.3}}, false, is_exact);
    EXPECT_EQ(ContactGeometry(model).rows_at(over_node.zero(), over_node.zero())->size(), is_exact ? 1U : 2U);
  }
}

}  // namespace
}  // namespace carom::contact_bars_test
