// Edges: which there are, and the rows of edges that cross.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/edge_rows.hpp"
#include "contact_rows_fixture.hpp"
#include "surface/feature_edges.hpp"

namespace carom::contact_edges_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // positions below 10, some ten operations
constexpr double degree = std::numbers::pi / 180.0;
constexpr double sharp = 30.0 * degree;
constexpr Index slots = 8;  // of a segment

Vec3 turned(const Vec3& x, std::size_t axis, double angle) {
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  Vec3 out = x;
  out[i] = std::cos(angle) * x[i] - std::sin(angle) * x[j];
  out[j] = std::sin(angle) * x[i] + std::cos(angle) * x[j];
  return out;
}

/// How two bars lie on each other: both along x and rolled about their axes, the upper one then turned about z, its
/// lower edge at a height `gap` over the upper edge of the lower bar; they cross on_1 and on_2 from their middles.
struct Lie {
  double gap = -0.02;
  double crossing = 90.0 * degree;
  double roll_1 = 45.0 * degree, roll_2 = 45.0 * degree;  ///< of the upper (first surface) and the lower bar
  double on_1 = -0.4, on_2 = 0.3;
  bool self = false;
  RowHold hold = RowHold::springs;
  PairMethod method = PairMethod::two_pass;
};

/// Two bars of 4 x 1 x 1, of 4 cells along their edges.
struct Bars {
  Scene scene;
  std::vector<Facet> upper, lower;
  PairContact contact;
  std::unique_ptr<RowMaker> maker;

  explicit Bars(const Lie& lie) {
    const auto bar = [&](double roll, double crossing, double side, double height) {
      const std::size_t first = scene.mesh.coordinates.size();
      std::vector<Facet> facets = scene.add_box({-2.0, -0.5, -0.5}, {2.0, 0.5, 0.5}, 4);
      const Vec3 move = side > 0 ? Vec3{} : add({lie.on_2, 0.0, 0.0}, turned({-lie.on_1, 0.0, 0.0}, 2, crossing));
      double top = 0.0;
      for (std::size_t n = first; n < scene.mesh.coordinates.size(); ++n) {
        scene.mesh.coordinates[n] = turned(turned(scene.mesh.coordinates[n], 0, roll), 2, crossing);
        top = std::max(top, side * scene.mesh.coordinates[n][2]);
      }
      for (std::size_t n = first; n < scene.mesh.coordinates.size(); ++n)
        scene.mesh.coordinates[n] = add(scene.mesh.coordinates[n], {move[0], move[1], height - side * top});
      return facets;
    };
    lower = bar(lie.roll_2, 0.0, 1.0, 0.0);
    upper = bar(lie.roll_1, lie.crossing, -1.0, lie.gap);
    contact.name = "bars";
    contact.slave = {upper};
    contact.master = {lower};
    if (lie.self) {
      contact.self = true;
      contact.slave.facets.insert(contact.slave.facets.end(), lower.begin(), lower.end());
      contact.master = contact.slave;
    }
    contact.law.eps_N = 4.0;
    contact.law.eps_T = 2.0;
    contact.law.mu = 0.3;
    contact.law.hold = lie.hold;
    contact.method = lie.method;
    scene.finish();
    maker = edge_rows(scene.model, contact, 0, nullptr);
  }
  std::vector<Vec3> at(const std::vector<double>& u) const {
    std::vector<Vec3> x = scene.mesh.coordinates;
    for (std::size_t n = 0; n < x.size(); ++n) x[n] = add(x[n], vector_at(u, n));
    return x;
  }
  ConstraintRows rows(const std::vector<double>& u_begin, const std::vector<double>& u,
                      const std::vector<RowHistory>& history = {}) const {
    const std::vector<Vec3> x_begin = at(u_begin), x = at(u);
    std::vector<Vec3> d(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) d[n] = subtract(x[n], x_begin[n]);
    ConstraintRows made;
    maker->append({x_begin, x, d, u, history}, 0, made);
    return made;
  }
  ConstraintRows rows(const std::vector<double>& u) const { return rows(u, u); }
  ConstraintRows rows() const { return rows(scene.zero()); }
  std::vector<RowHistory> in_front() const { return std::vector<RowHistory>(maker->slots()); }
  /// The upper bar, its nodes the last, moved.
  std::vector<double> moved(const Vec3& d) const {
    std::vector<double> u = scene.zero();
    const std::size_t nodes = scene.mesh.coordinates.size();
    for (std::size_t n = nodes / 2; n < nodes; ++n)
      for (std::size_t c = 0; c < 3; ++c) u[3 * n + c] = d[c];
    return u;
  }
  /// Sum of f^2 g^2 / 2 over the rows.
  double energy(const std::vector<double>& u) const {
    const ConstraintRows made = rows(u);
    double sum = 0.0;
    for (std::size_t r = 0; r < made.size(); ++r) sum += 0.5 * std::pow(std::min(0.0, made.gap_at(r, u)), 2);
    return sum;
  }
  std::vector<double> shaken(unsigned seed) const {
    Random random(seed);
    std::vector<double> u = scene.zero();
    for (double& component : u) component = random(-0.005, 0.005);
    return u;
  }
};

TEST(FeatureEdges, AreThoseOfABox) {
  Scene scene;
  const std::vector<Facet> box = scene.add_box({0.0, 0.0, 0.0}, {3.0, 3.0, 3.0}, 3);
  const std::vector<FeatureEdge> edges = feature_edges(scene.mesh.coordinates, box, {}, sharp);
  ASSERT_EQ(edges.size(), 12U * 3U);
  for (const FeatureEdge& edge : edges) {
    EXPECT_NEAR(edge.measure, 0.5, round_off);  // two facets of 1, four nodes each
    for (const EdgeEnd& end : edge.end) EXPECT_NEAR(end.width, end.goes_on ? 0.1 : 0.02, round_off);
  }
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(),
                          [](const FeatureEdge& e) { return e.end[0].goes_on && e.end[1].goes_on; }),
            12);
  EXPECT_FALSE(has_open_edges(box));
}

TEST(FeatureEdges, AreFoundWhereTheSurfaceEnds) {
  Scene scene;
  const std::vector<Facet> box = scene.add_box({0.0, 0.0, 0.0}, {2.0, 2.0, 2.0}, 2);
  const std::vector<Facet> bottom(box.begin() + 16, box.begin() + 20);  // the fifth side is that of least z
  EXPECT_TRUE(has_open_edges(bottom));
  EXPECT_EQ(feature_edges(scene.mesh.coordinates, bottom, box, sharp).size(), 8U);
  EXPECT_TRUE(feature_edges(scene.mesh.coordinates, bottom, {}, sharp).empty());
}

// A roof of two facets, and the same seen from below: 2 x 14 degrees are smooth, 2 x 16 are sharp; a valley is not.
TEST(FeatureEdges, AreConvexAndTurnByMoreThan30Degrees) {
  for (const bool triangles : {false, true}) {
    const auto count = [&](double slope) {
      Scene scene;
      const std::vector<Facet> roof = scene.add_patch(
          2, 1,
          [&](double s, double t) {
            return Vec3{2.0 * s - 1.0, t, -slope * std::abs(2.0 * s - 1.0)};
          },
          triangles);
      return feature_edges(scene.mesh.coordinates, roof, {}, sharp).size();
    };
    EXPECT_EQ(count(std::tan(14.0 * degree)), 0U);
    EXPECT_EQ(count(std::tan(16.0 * degree)), 1U);
    EXPECT_EQ(count(-std::tan(16.0 * degree)), 0U);
  }
}

// A roof whose ridge of two segments sags from its middle on: beyond that the line of one segment is outside.
TEST(FeatureEdges, GoOnWhereTheyAreStraight) {
  const auto ends_that_go_on = [](double sag) {
    Scene scene;
    const std::vector<Facet> roof = scene.add_patch(2, 2, [&](double s, double t) {
      return Vec3{2.0 * s - 1.0, t, -std::abs(2.0 * s - 1.0) - sag * std::abs(t - 0.5)};
    });
    const std::vector<FeatureEdge> ridge = feature_edges(scene.mesh.coordinates, roof, {}, sharp);
    EXPECT_EQ(ridge.size(), 2U);
    int count = 0;
    for (const FeatureEdge& edge : ridge)
      for (const EdgeEnd& end : edge.end) count += end.goes_on ? 1 : 0;
    return count;
  };
  EXPECT_EQ(ends_that_go_on(0.0), 2);
  EXPECT_EQ(ends_that_go_on(0.01), 0);  // they turn by 0.02
}

TEST(EdgeRows, PushAlongTheCrossProductOfTheEdges) {
  for (const double angle : {90.0, 45.0, 15.0, 6.0}) {  // nearly parallel below 5.7
    Lie lie;
    lie.crossing = angle * degree;
    const Bars bars(lie);
    const ConstraintRows rows = bars.rows();
    ASSERT_EQ(rows.size(), 1U) << angle;
    EXPECT_NEAR(rows.gap_at(0, bars.scene.zero()), lie.gap, round_off);
    EXPECT_NEAR(norm(subtract(rows.normal[0], {0.0, 0.0, 1.0})), 0.0, round_off);
    EXPECT_NEAR(rows.measure[0], 2.0 / 16.0, round_off);  // two facets of 1 x 1/4, four nodes each
    EXPECT_NEAR(rows.law[0].eps_N, 0.5, round_off);       // all of 4, not half
    EXPECT_EQ(rows.node.size(), 4U);
    EXPECT_EQ(rows.behind[0], 2);
    EXPECT_FALSE(rows.is_back[0]);
  }
}

TEST(EdgeRows, OfASurfaceWithItselfStandOnce) {
  Lie lie;
  lie.self = true;
  const Bars bars(lie);
  const ConstraintRows rows = bars.rows();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_NEAR(rows.gap_at(0, bars.scene.zero()), lie.gap, round_off);
  EXPECT_NEAR(rows.law[0].eps_N, 0.5, round_off);
}

// With multipliers, flat on flat the four edges of each bar that cross the other's have no rows at all; nor has an edge
// on a face, nor have parallel edges.
TEST(EdgeRows, AreNoneWhereFacesOrEdgesLieAlongEachOther) {
  for (const double angle : {90.0, 45.0, 20.0}) {
    Lie lie;
    lie.hold = RowHold::multipliers;
    lie.crossing = angle * degree;
    lie.roll_1 = lie.roll_2 = 0.0;
    EXPECT_EQ(Bars(lie).rows().size(), 0U) << angle;
    lie.roll_1 = 45.0 * degree;  // an edge on a face
    EXPECT_EQ(Bars(lie).rows().size(), 0U) << angle;
  }
  Lie lie;
  lie.hold = RowHold::multipliers;
  lie.crossing = 0.0;
  EXPECT_EQ(Bars(lie).rows().size(), 0U);
}

// Springs at nodes: where two bars cross flat on flat, 1 x 1 of their faces, no node of one is over the other; the
// sides of the faces cross at four places, each with f^2 = 1/2 * 1/2. With overlaps the faces see each other.
TEST(EdgeRows, HoldFacesThatCrossAtTheirSides) {
  Lie lie;
  lie.roll_1 = lie.roll_2 = 0.0;
  const Bars bars(lie);
  const ConstraintRows rows = bars.rows();
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_NEAR(rows.gap_at(r, bars.scene.zero()), 0.5 * lie.gap, round_off);
    EXPECT_NEAR(norm(subtract(rows.normal[r], {0.0, 0.0, 1.0})), 0.0, round_off);
  }
  lie.method = PairMethod::faces;
  EXPECT_EQ(Bars(lie).rows().size(), 0U);
}

// A ridge across the flat top of the other bar crosses three lines of the mesh there, each with f^2 = 1/4, and both
// sides of the top, f^2 = 1/2.
TEST(EdgeRows, HoldRidgesOnFaces) {
  for (const RowHold hold : {RowHold::springs, RowHold::impulses, RowHold::increments}) {
    Lie lie;
    lie.hold = hold;
    lie.roll_2 = 0.0;
    lie.on_1 = 0.0;
    const Bars bars(lie);
    const ConstraintRows rows = bars.rows();
    double sum = 0.0;  // of f^2
    for (std::size_t r = 0; r < rows.size(); ++r) sum += std::pow(rows.gap_at(r, bars.scene.zero()) / lie.gap, 2);
    EXPECT_NEAR(sum, 3.0 * 0.25 + 2.0 * 0.5, round_off);
  }
}

/// Places where every part of the factor acts: edges that stick out; a facet 2 and 1.4 degrees from lying flat (the
/// factor fades below 2.9); edges 1 degree from parallel (it fades below 1.8); a crossing beside nodes of both edges; a
/// ridge on a face; faces whose sides cross.
std::vector<Lie> places() {
  std::vector<Lie> places(7);
  places[1].roll_1 = 2.0 * degree;
  places[2].roll_2 = 1.4 * degree;
  places[2].crossing = 70.0 * degree;
  places[3].crossing = 1.0 * degree;
  places[4].on_1 = 0.96;
  places[4].on_2 = -0.03;
  places[4].crossing = 80.0 * degree;
  places[5].roll_2 = 0.5 * degree;
  places[5].crossing = 70.0 * degree;
  places[6].roll_1 = 1.0 * degree;
  places[6].roll_2 = -0.7 * degree;
  places[6].crossing = 75.0 * degree;
  return places;
}

/// By finite differences, of the rows that are behind.
void expect_gradients(const Bars& bars, const std::vector<double>& u) {
  // Rounding 1e-15 / step; third derivatives to 2e7 where the edges are within 2 degrees of parallel, times step^2 / 6.
  constexpr double step = 1e-7, error = 1e-7;
  const ConstraintRows rows = bars.rows(u);
  ASSERT_GE(rows.size(), 1U);
  const auto gap = [&](std::size_t r, const std::vector<double>& at) {
    const ConstraintRows there = bars.rows(at);
    for (std::size_t k = 0; k < there.size(); ++k)
      if (there.slot[k] / slots == rows.slot[r] / slots && there.facet[k] == rows.facet[r]) return there.gap_at(k, at);
    return std::numeric_limits<double>::quiet_NaN();
  };
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (rows.gap_at(r, u) > 0.0) continue;  // there the factor is no part of it
    std::vector<double> gradient = bars.scene.zero();
    rows.scatter(r, {1.0, 0.0, 0.0}, gradient);
    for (const Index n : std::span(rows.node).subspan(static_cast<std::size_t>(rows.begin[r]),
                                                      static_cast<std::size_t>(rows.begin[r + 1] - rows.begin[r]))) {
      for (std::size_t c = 0; c < 3; ++c) {
        Vec3 d{};
        d[c] = step;
        const double slope =
            (gap(r, with_displacement(u, n, d)) - gap(r, with_displacement(u, n, scaled(d, -1.0)))) / (2.0 * step);
        EXPECT_NEAR(gradient[3 * static_cast<std::size_t>(n) + c], slope, error) << "slot " << rows.slot[r];
      }
    }
  }
}

TEST(EdgeRows, HaveTheGradientOfTheirGap) {
  for (const Lie& lie : places()) {
    const Bars bars(lie);
    expect_gradients(bars, bars.shaken(7));
  }
}

/// A ridge along y over the flat top of the other bar, of which one facet bends: its corners (1, 0) and (0, 1/4) go
/// down by `bend`, all around it by more, so that the diagonal from (0, 0) to (1, 1/4) is all that the ridge meets.
struct BentFacet {
  Bars bars;
  std::vector<double> u;

  BentFacet(Lie lie, double bend) : bars((lie.roll_2 = 0.0, lie)), u(bars.scene.zero()) {
    for (std::size_t n = 0; n < u.size() / 6; ++n) {
      const Vec3& x = bars.scene.mesh.coordinates[n];
      if (std::abs(x[2]) > 1e-9) continue;
      const bool is_of_facet = std::abs(x[0] - 0.5) < 0.6 && std::abs(x[1] - 0.125) < 0.2;
      const bool is_high = is_of_facet && std::abs((x[0] > 0.5) - 4.0 * x[1]) < 1e-9;
      u[3 * n + 2] = is_high ? 0.0 : is_of_facet ? -bend : -3.0 * bend;
    }
  }
  std::vector<double> gaps_behind() const {
    std::vector<double> gaps;
    const ConstraintRows rows = bars.rows(u);
    for (std::size_t r = 0; r < rows.size(); ++r)
      if (rows.gap_at(r, u) < 0.0) gaps.push_back(rows.gap_at(r, u));
    return gaps;
  }
};

// A facet that was flat holds where it bends: the diagonal that sticks out is an edge, as deep as the ridge is below
// it. Multipliers of implicit steps know no such edges.
TEST(EdgeRows, HoldFacetsThatBendAtTheirFold) {
  Lie lie;
  lie.gap = -0.02;
  for (const RowHold hold : {RowHold::springs, RowHold::impulses, RowHold::increments}) {
    lie.hold = hold;
    const std::vector<double> gaps = BentFacet(lie, 0.2).gaps_behind();
    ASSERT_EQ(gaps.size(), 1U);
    EXPECT_NEAR(gaps[0], lie.gap, round_off);
  }
  lie.hold = RowHold::multipliers;
  EXPECT_TRUE(BentFacet(lie, 0.2).gaps_behind().empty());
  lie.hold = RowHold::springs;
  lie.gap = -0.002;  // the fold sticks out by 2.4 degrees
  const BentFacet little(lie, 0.01);
  ASSERT_EQ(little.gaps_behind().size(), 1U);
  EXPECT_GT(little.gaps_behind()[0], lie.gap);
  expect_gradients(little.bars, little.u);
}

TEST(EdgeRows, GiveNoForceAndNoMomentInTotal) {
  for (const Lie& lie : places()) {
    for (const double gap : {-0.05, 0.1}) {
      Lie at = lie;
      at.gap = gap;
      const Bars bars(at);
      const std::vector<double> u = bars.shaken(3);
      const ConstraintRows rows = bars.rows(u);
      ASSERT_GE(rows.size(), 1U);
      for (std::size_t r = 0; r < rows.size(); ++r) {
        for (const Vec3& s : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
          const Resultant sum = resultant(bars.scene, rows, r, s, u);
          EXPECT_LT(norm(sum.force), 1e-12);  // blocks to 1e2 / sin(1 degree) beside parallel edges
          EXPECT_LT(norm(sum.moment), 1e-11);
        }
      }
    }
  }
}

// Along straight edges the crossing goes over nodes of both: the stored energy stays what it is, at the nodes as well.
TEST(EdgeRows, PassFromSegmentToSegmentWithoutAJump) {
  Lie lie;
  const Bars bars(lie);
  const double expected = 0.5 * lie.gap * lie.gap;
  for (int i = 0; i <= 400; ++i)
    EXPECT_NEAR(bars.energy(bars.moved({-1.3 + 0.005 * i, -0.7 + 0.004 * i, 0.0})), expected, 1e-15) << i;
}

TEST(EdgeRows, EndWithTheEdgeWithoutAJump) {
  const Bars bars(Lie{});
  double last = bars.energy(bars.moved({1.2, 0.0, 0.0}));
  EXPECT_GT(last, 0.0);
  for (int i = 1; i <= 600; ++i) {
    const double next = bars.energy(bars.moved({1.2 + 0.001 * i, 0.0, 0.0}));
    EXPECT_LE(next, last);
    EXPECT_LT(last - next, 0.05 * 0.5 * 0.02 * 0.02);  // fades over 0.04, 1.5 / 40 a step at most
    last = next;
  }
  EXPECT_EQ(last, 0.0);
}

// A pair begins when it was in front at the beginning of the step, however far it goes, and not when it comes in deep
// from the side, or stands there. Less deep than a twentieth of the facets' size, 0.5, it begins from the side.
TEST(EdgeRows, OfMultipliersBeginInFront) {
  Lie lie;
  lie.hold = RowHold::multipliers;
  lie.gap = 0.01;
  const Bars bars(lie);
  EXPECT_EQ(bars.rows(bars.moved({}), bars.moved({0.0, 0.0, -0.3}), bars.in_front()).size(), 1U);
  EXPECT_EQ(bars.rows(bars.moved({}), bars.moved({0.0, 0.0, -0.9}), bars.in_front()).size(), 1U);
  EXPECT_EQ(bars.rows(bars.moved({3.0, 0.0, -0.3}), bars.moved({0.5, 0.0, -0.3}), bars.in_front()).size(), 0U);
  EXPECT_EQ(bars.rows(bars.moved({3.0, 0.0, -0.02}), bars.moved({0.5, 0.0, -0.02}), bars.in_front()).size(), 1U);
  for (const double depth : {0.3, 0.02}) {
    const std::vector<double> behind = bars.moved({0.0, 0.0, -0.01 - depth});
    EXPECT_EQ(bars.rows(behind, behind, bars.in_front()).size(), 0U);
  }
  const std::vector<double> deep = bars.moved({0.0, 0.0, -0.3});
  EXPECT_EQ(bars.rows(deep, deep).size(), 1U);  // at the start, where nothing is known
}

TEST(EdgeRows, OfMultipliersRememberWhatWasBehind) {
  Lie lie;
  lie.hold = RowHold::multipliers;
  const Bars bars(lie);
  std::vector<RowHistory> history = bars.in_front();
  const std::vector<double> deep = bars.moved({0.0, 0.0, -0.3});
  const ConstraintRows before = bars.rows(deep);
  ASSERT_EQ(before.size(), 1U);
  const Index segment = before.slot[0] / slots;
  history[static_cast<std::size_t>(slots * segment + 2)].facet = before.facet[0];
  const ConstraintRows after = bars.rows(deep, deep, history);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after.slot[0], slots * segment + 2);  // it keeps its slot
  EXPECT_EQ(after.facet[0], before.facet[0]);
  const std::vector<double> beside = bars.moved({1.0, 0.0, -0.3});  // on the next segment of the lower edge
  const ConstraintRows next = bars.rows(beside, beside, history);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_NE(next.facet[0], before.facet[0]);
  const std::vector<double> far = bars.moved({-1.9, 0.0, -0.3});  // two segments on
  EXPECT_EQ(bars.rows(far, far, history).size(), 0U);
}

// What sticks out far enough when the step begins has its row to the end of the step, however flat it turns out to lie
// there; what is as flat when the step begins has none. Else the force of a row could push it out of the rows that
// need the force, and no force would be in balance. The lower bar lies rolled by 1 degree, where its flatter side has
// z = sin(1 degree) / w = 0.349 of the way from lying flat, f = sqrt(S(0.349)) = 0.53, or by 0.8 degrees with f = 0.43:
// on either side of the least factor, 1/2.
TEST(EdgeRows, OfMultipliersStayForTheStepThatTheyBeginIn) {
  Lie lie;
  lie.hold = RowHold::multipliers;
  const auto rolled = [&](double angle) {
    Lie at = lie;
    at.roll_2 = angle * degree;
    return Bars(at);
  };
  const Bars out = rolled(1.0), flat = rolled(0.8);
  std::vector<double> to_flat(out.scene.zero()), none = out.scene.zero();
  for (std::size_t n = 0; n < out.scene.mesh.coordinates.size(); ++n) {
    const Vec3 d = subtract(flat.scene.mesh.coordinates[n], out.scene.mesh.coordinates[n]);
    for (std::size_t c = 0; c < 3; ++c) to_flat[3 * n + c] = d[c];
  }
  EXPECT_EQ(out.rows(none, none).size(), 1U);
  EXPECT_EQ(out.rows(to_flat, to_flat).size(), 0U);
  const ConstraintRows stays = out.rows(none, to_flat);
  ASSERT_EQ(stays.size(), 1U);
  // The gap counts by the factor there: S(z) = z^2 (3 - 2 z), z = sin(0.8 degrees) / 0.05.
  const double z = std::sin(0.8 * degree) / 0.05;
  EXPECT_NEAR(stays.gap_at(0, to_flat), lie.gap * std::sqrt(z * z * (3.0 - 2.0 * z)), 1e-3 * -lie.gap);
  EXPECT_EQ(out.rows(to_flat, none).size(), 1U);  // what comes to stick out is there
}

// Edges that were behind each other at a corner of a bar say nothing of another edge that ends there.
TEST(EdgeRows, OfMultipliersDoNotRememberRoundACorner) {
  Lie lie;
  lie.hold = RowHold::multipliers;
  lie.on_1 = -1.6;  // on the last segment of the upper bar
  const Bars bars(lie);
  const std::vector<double> deep = bars.moved({0.0, 0.0, -0.3});
  const ConstraintRows before = bars.rows(deep);
  ASSERT_EQ(before.size(), 1U);
  const std::vector<FeatureEdge> edges = feature_edges(bars.scene.mesh.coordinates, bars.upper, {}, sharp);
  const FeatureEdge& met = edges[static_cast<std::size_t>(before.slot[0] / slots)];
  int along = 0, round_corner = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const bool is_beside = std::find_first_of(edges[k].node.begin(), edges[k].node.end(), met.node.begin(),
                                              met.node.end()) != edges[k].node.end();
    if (!is_beside || edges[k].node == met.node) continue;
    std::vector<RowHistory> history = bars.in_front();
    history[static_cast<std::size_t>(slots) * k].facet = before.facet[0];
    (bars.rows(deep, deep, history).size() == 0 ? round_corner : along) += 1;
  }
  EXPECT_EQ(along, 1);
  EXPECT_EQ(round_corner, 2);
}

// Springs and impulses act wherever edges are behind each other, from wherever they have come, to half the thickness of
// a bar: beside its edges, of cells of 0.25, that is a part of what it is 1 wide. Increments ask whence.
TEST(EdgeRows, ActToADepthWhateverCameBeforeUnlessTheyThrowOut) {
  for (const RowHold hold : {RowHold::springs, RowHold::impulses, RowHold::increments}) {
    Lie lie;
    lie.hold = hold;
    const Bars bars(lie);
    const std::vector<double> deep = bars.moved({0.0, 0.0, -0.08}), beyond = bars.moved({0.0, 0.0, -0.3}),
                              aside = bars.moved({3.0, 0.0, -0.08});
    const std::size_t expected = hold == RowHold::increments ? 0 : 1;
    EXPECT_EQ(bars.rows(deep, deep, bars.in_front()).size(), expected);
    EXPECT_EQ(bars.rows(aside, deep, bars.in_front()).size(), expected);
    EXPECT_EQ(bars.rows(beyond, beyond, bars.in_front()).size(), 0U);
    EXPECT_EQ(bars.rows(deep, deep).size(), 1U);  // at the start, where nothing is known
    EXPECT_EQ(bars.rows(beyond, beyond).size(), 0U);
  }
}

// The search lists pairs within a quarter of the facets' size, 0.5, and, as its boxes follow the axes, some beyond it:
// whichever it lists, springs hold what is deeper, here by 0.2, when it was behind before.
void expect_within_reach_in_every_frame(const Bars& bars) {
  const std::vector<double> shallow = bars.moved({0.0, 0.0, -0.08}), deep = bars.moved({0.0, 0.0, -0.18});
  const auto seen_turned = [&](const std::vector<double>& u, double angle) {
    const std::vector<Vec3> x = bars.at(u);
    std::vector<double> out(u.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
      const Vec3 moved = subtract(turned(turned(x[n], 0, angle), 1, 0.6 * angle), bars.scene.mesh.coordinates[n]);
      std::copy(moved.begin(), moved.end(), out.begin() + static_cast<std::ptrdiff_t>(3 * n));
    }
    return out;
  };
  for (const double angle : {0.0, 0.3, 0.7, 2.0}) {
    const std::vector<double> u = seen_turned(shallow, angle), v = seen_turned(deep, angle);
    const ConstraintRows before = bars.rows(u, u, bars.in_front());
    ASSERT_EQ(before.size(), 1U) << angle;
    EXPECT_EQ(bars.rows(v, v, bars.in_front()).size(), 0U) << angle;
    std::vector<RowHistory> history = bars.in_front();
    history[static_cast<std::size_t>(before.slot[0])].facet = before.facet[0];
    EXPECT_EQ(bars.rows(v, v, history).size(), 1U) << angle;
  }
}

TEST(EdgeRows, OfSpringsBeginWithinReachInEveryFrame) {
  expect_within_reach_in_every_frame(Bars(Lie{}));
  Lie lie;
  lie.self = true;  // its edges are sharp ones and, among the second, all
  expect_within_reach_in_every_frame(Bars(lie));
}

}  // namespace
}  // namespace carom::contact_edges_test
