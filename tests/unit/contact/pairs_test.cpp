// Rows of pairs: nodes against facets, both passes, one surface with itself, ends of bars.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "contact_rows_fixture.hpp"
#include "parallel/threads.hpp"
#include "surface/facet_projection.hpp"

namespace carom::contact_pairs_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // positions below 10, some ten operations
// Central differences with steps h: error 1e-16 * 10 / h + curvature^2 h^2 / 6, curvatures below 100.
constexpr double step = 1e-6, slope_error = 1e-8;

PairContact pair(const Surface& slave, const Surface& master, PairMethod method = PairMethod::node_to_surface) {
  PairContact contact;
  contact.name = "pair";
  contact.slave = slave;
  contact.master = master;
  contact.method = method;
  contact.law.eps_N = 4.0;
  contact.law.eps_T = 2.0;
  contact.law.mu = 0.3;
  return contact;
}

double bump(double x, double y) {
  return 0.08 * std::sin(5 * x + 1) * std::cos(4 * y);
}

/// A bumpy master of unit size below a slave patch that looks down on it, moved at random.
struct Bumpy {
  Scene scene;
  std::vector<Facet> slave, master;
  std::vector<double> u;

  Bumpy(unsigned seed, bool triangles, double height, PairMethod method = PairMethod::node_to_surface) {
    master = scene.add_patch(
        6, 5,
        [](double s, double t) {
          return Vec3{s, t, bump(s, t)};
        },
        triangles);
    slave = scene.add_patch(
        4, 7,
        [&](double s, double t) {
          return Vec3{0.1 + 0.8 * t, 0.1 + 0.8 * s, bump(t, s) + height};
        },
        triangles);
    scene.finish().contacts.emplace_back(pair({slave}, {master}, method));
    Random random(seed);
    u = scene.zero();
    for (double& component : u) component = random(-0.01, 0.01);
  }
};

TEST(NodeRows, HaveNormalsThatAreTheGradientOfTheGap) {
  for (const bool triangles : {false, true}) {
    for (const double height : {0.06, -0.05}) {
      const Bumpy bumpy(11, triangles, height);
      const ContactGeometry contact(bumpy.scene.model);
      constexpr Index nodes = 5 * 8;  // rows of edges follow
      EXPECT_EQ(row_of(*contact.rows_at(bumpy.u, bumpy.u), nodes - 1), nodes - 1);
      EXPECT_LT(gradient_error(contact, bumpy.u, step, nodes), slope_error) << triangles << height;
    }
  }
}

// Any force of a row and its reactions are in balance, moments included, however far apart they act.
TEST(NodeRows, LeaveNoForceAndNoMoment) {
  Random random(13);
  for (const bool triangles : {false, true}) {
    for (const double height : {0.07, 0.0, -0.07}) {
      const Bumpy bumpy(17, triangles, height);
      const auto rows = ContactGeometry(bumpy.scene.model).rows_at(bumpy.u, bumpy.u);
      ASSERT_GE(rows->size(), 5U * 8U);
      for (std::size_t r = 0; r < rows->size(); ++r) {
        const Resultant sum = resultant(bumpy.scene, *rows, r, random.vector(1.0), bumpy.u);
        EXPECT_LT(norm(sum.force), round_off);
        EXPECT_LT(norm(sum.moment), round_off);
      }
    }
  }
}

// Where the surfaces see each other from the front, what is found is the closest point over all facets; beside edges
// the mean over the facets there, whose gaps differ by no more than the width of that zone, 0.1 of a facet of 0.2,
// times the angle between neighbours, at most 0.3.
TEST(NodeRows, StandAtTheClosestPointOfAllFacets) {
  for (const bool triangles : {false, true}) {
    const Bumpy bumpy(19, triangles, 0.1);
    const ContactGeometry contact(bumpy.scene.model);
    std::vector<Vec3> x = bumpy.scene.mesh.coordinates;
    for (std::size_t i = 0; i < bumpy.u.size(); ++i) x[i / 3][i % 3] += bumpy.u[i];
    const auto rows = contact.rows_at(bumpy.u, bumpy.u);
    ASSERT_EQ(rows->size(), 5U * 8U);
    int exact = 0;
    for (std::size_t r = 0; r < rows->size(); ++r) {
      Projection closest{.distance = INFINITY};
      for (const Facet& facet : bumpy.master) {
        const Projection p = project(place(facet, x), x[rows->node[rows->begin[r]]]);
        if (p.distance < closest.distance) closest = p;
      }
      const double least = closest.distance;
      const bool is_inside = closest.site == ProjectionSite::interior && rows->behind[r] == bumpy.master.front().size;
      exact += is_inside ? 1 : 0;
      EXPECT_NEAR(std::abs(rows->gap_at(r, bumpy.u)), least, is_inside ? round_off : 0.1 * 0.2 * 0.3);
    }
    EXPECT_GE(exact, 10);
  }
}

/// Gap and slave's block of a node at `at` over a roof of four facets that meet at the origin, in any order.
std::pair<double, Vec3> over_a_roof(const Vec3& at, bool reversed) {
  Scene scene;
  auto roof = scene.add_patch(2, 2, [](double s, double t) {
    return Vec3{2 * s - 1, 2 * t - 1, -0.3 * std::abs(2 * s - 1) - 0.2 * std::abs(2 * t - 1)};
  });
  if (reversed) std::reverse(roof.begin(), roof.end());
  const Surface point{{{{scene.add_node(at), -1, -1, -1}, 1}}};
  scene.finish().contacts.emplace_back(pair(point, {roof}));
  const auto u = scene.zero();
  const auto rows = ContactGeometry(scene.model).rows_at(u, u);
  return {rows->gap_at(0, u), rows->block[0][0]};
}

// At the corner, on the edges and beside them the facets share the row by geometry, not by order: mirrored nodes have
// mirrored rows, and the normal at the corner is vertical.
TEST(NodeRows, AreSymmetricWhereFacetsMeet) {
  for (const bool reversed : {false, true}) {
    for (const double z : {-0.05, 0.0, 1e-9, 0.01}) {
      const auto [gap, n] = over_a_roof({0, 0, z}, reversed);
      EXPECT_NEAR(n[0], 0.0, round_off);
      EXPECT_NEAR(n[1], 0.0, round_off);
      const auto [gap_p, p] = over_a_roof({0.02, 0.03, z - 0.012}, reversed);
      const auto [gap_m, m] = over_a_roof({-0.02, 0.03, z - 0.012}, !reversed);
      EXPECT_NEAR(gap_p, gap_m, round_off);
      EXPECT_NEAR(p[0], -m[0], round_off);
      EXPECT_NEAR(p[1], m[1], round_off);
    }
  }
}

// Behind the edge of a valley a node is nearest to that edge, from both of its sides. At one end of the edge a wall
// begins, whose facets do not belong to it.
TEST(NodeRows, BehindAValleyAreSymmetricThoughAWallBeginsAtItsEnd) {
  const auto gap = [](double x, double y) {
    Scene scene;
    auto all = scene.add_patch(2, 1, [](double s, double t) { return Vec3{2 * s - 1, t, 0.3 * std::abs(2 * s - 1)}; });
    const std::array<Facet, 2> valley{all[0], all[1]};
    std::array<Index, 3> below;
    for (std::size_t i = 0; i < 3; ++i) below[i] = scene.add_node({double(i) - 1, 0.0, -1.0});
    for (std::size_t i = 0; i < 2; ++i)
      all.push_back({{valley[i].node[1], valley[i].node[0], below[i], below[i + 1]}, 4});
    const Surface point{{{{scene.add_node({x, y, -0.02}), -1, -1, -1}, 1}}};
    scene.finish().contacts.emplace_back(pair(point, {all}));
    return gap_of(ContactGeometry(scene.model), scene.zero(), 0);
  };
  for (const double y : {0.3, 0.7}) {
    constexpr double x = 1e-6;
    EXPECT_LT(gap(x, y), 0.0);
    EXPECT_NEAR(gap(x, y), gap(-x, y), round_off) << y;
    EXPECT_NEAR(gap(x, y), gap(-2 * x, y), 10 * x) << y;
  }
}

// Beside the ridge a row's surface is rounded: it lies outside of the facets. What that takes from the gap of a node in
// front of its facet is no penetration, and is taken off at the start; a node behind it penetrates by its distance
// from the facet, (0.3, 0.2, 1) times which is vertical.
TEST(NodeRows, TellRoundedEdgesFromPenetration) {
  for (const double above : {1e-4, -1e-3}) {
    Scene scene;
    const auto roof = scene.add_patch(2, 2, [](double s, double t) {
      return Vec3{2 * s - 1, 2 * t - 1, -0.3 * std::abs(2 * s - 1) - 0.2 * std::abs(2 * t - 1)};
    });
    const Surface point{{{{scene.add_node({0.03, 0.5, -0.1 - 0.3 * 0.03 + above}), -1, -1, -1}, 1}}};
    scene.finish().contacts.emplace_back(pair(point, {roof}));
    ContactGeometry geometry(scene.model);
    const std::vector<Penetration> found = geometry.initial_penetrations(scene.zero());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_GT(found[0].rounded, 1e-3);
    const double depth = std::max(0.0, -above) / std::sqrt(1.0 + 0.3 * 0.3 + 0.2 * 0.2);
    EXPECT_NEAR(found[0].depth - found[0].rounded, depth, round_off);
    geometry.set_initial(scene.zero());
    EXPECT_NEAR(geometry.rows_at(scene.zero(), scene.zero())->gap_at(0, scene.zero()), -depth, round_off);
  }
}

// A node that slides over the ridge, touching it or a little above, turns its row from one roof's side to the other
// within about a twentieth of a facet on both sides, without a jump: 0.58 rad in 92 of 400 steps, an eighth of that at
// most in one of them.
TEST(NodeRows, PassFromFacetToFacetWithoutAJump) {
  for (const double gap : {0.0, 0.001, 0.02}) {
    const auto normal = [gap](double x) { return over_a_roof({x, 0.5, -0.1 - 0.3 * std::abs(x) + gap}, false).second; };
    Vec3 last = normal(-0.2);
    for (int i = -199; i <= 200; ++i) {
      const double x = 0.001 * i;
      const Vec3 n = normal(x);
      EXPECT_LT(norm(subtract(n, last)), 0.58 / 8.0) << x << " at " << gap;
      last = n;
    }
  }
}

// A node slides 0.003 deep over a ridge of 2 atan(1/2) = 53 degrees. The facet on the other side, behind which it is by
// up to a tenth of a facet, adds to its depth by z B / (1 + B), B = (1 - z^2 / c^2)^2, z the difference of the depths
// and c = 0.025 of a facet: 0.18 c at most; and it comes and goes without a jump.
TEST(NodeRows, AreNotMadeDeepByFacetsBehindASharpRidge) {
  const double secant = std::sqrt(1.25), depth = 0.003, size = std::sqrt(secant), most = 0.18 * 0.025 * size;
  double last = NAN;
  for (double x = 0.002; x < 0.3; x += 0.001) {
    Scene scene;
    const auto roof = scene.add_patch(2, 2, [](double s, double t) {
      return Vec3{2 * s - 1, 2 * t - 1, -0.5 * std::abs(2 * s - 1)};
    });
    const Surface point{{{{scene.add_node({x, 0.4, -0.5 * x - depth * secant}), -1, -1, -1}, 1}}};
    scene.finish().contacts.emplace_back(pair(point, {roof}));
    const double gap = gap_of(ContactGeometry(scene.model), scene.zero(), 0);
    EXPECT_GT(gap, -depth - most - round_off) << x;
    EXPECT_FALSE(std::abs(gap - last) > 0.001) << x;  // of a way of 0.001 along the ridge's side
    last = gap;
  }
}

// Points around a box, over faces, edges and corners, and a little inside.
TEST(NodeRows, AtEdgesAndCornersHaveTheGradientOfTheGapAndNoMoment) {
  Random random(37);
  Scene scene;
  Surface points;
  for (int i = 0; i < 60; ++i) {
    const Vec3 x = random.vector(1.3);
    std::array<double, 3> inside{};  // depths under the faces
    for (std::size_t c = 0; c < 3; ++c) inside[c] = 1.0 - std::abs(x[c]);
    std::sort(inside.begin(), inside.end());
    if (inside[0] > 0.2 || inside[1] - inside[0] < 0.05) continue;  // away from the kinks inside
    points.facets.push_back({{scene.add_node(x), -1, -1, -1}, 1});
  }
  ASSERT_GT(points.facets.size(), 30U);
  const auto box = scene.add_box({-1, -1, -1}, {1, 1, 1}, 2);
  scene.finish().contacts.emplace_back(pair(points, {box}));
  const ContactGeometry contact(scene.model);
  auto u = scene.zero();
  for (double& component : u) component = random(-0.001, 0.001);
  EXPECT_LT(gradient_error(contact, u, step), slope_error);
  const auto rows = contact.rows_at(u, u);
  EXPECT_EQ(rows->size(), points.facets.size());
  for (std::size_t r = 0; r < rows->size(); ++r) {
    const Resultant sum = resultant(scene, *rows, r, random.vector(1.0), u);
    EXPECT_LT(norm(sum.force), round_off);
    EXPECT_LT(norm(sum.moment), round_off);
  }
}

/// Segments along y = f(x) from x = 0 to 1; the normal is (dy, -dx) of their direction.
template <class Height>
std::vector<Facet> add_line(Scene& scene, int n, const Height& height, bool leftwards) {
  std::vector<Facet> facets;
  Index last = -1;
  for (int i = 0; i <= n; ++i) {
    const double x = leftwards ? 1.0 - double(i) / n : double(i) / n;
    const Index next = scene.add_node({x, height(x), 0.0});
    if (i > 0) facets.push_back({{last, next, -1, -1}, 2});
    last = next;
  }
  return facets;
}

TEST(NodeRows, InThePlaneHaveTheGradientOfTheGapAndNoMoment) {
  Scene scene;
  const auto low = [](double x) { return 0.1 * std::sin(4 * x); };
  const auto high = [&](double x) { return low(x) + 0.05 * std::cos(7 * x); };
  const auto master = add_line(scene, 6, low, true);  // upwards
  const auto slave = add_line(scene, 9, high, false);
  const Surface below{master, Section::plane_strain, 0.5}, above{slave, Section::plane_strain, 0.5};
  scene.finish().contacts.emplace_back(pair(above, below));
  const ContactGeometry contact(scene.model);
  const auto u = scene.zero();
  const auto rows = contact.rows_at(u, u);
  ASSERT_EQ(rows->size(), 10U);
  Random random(23);
  for (std::size_t r = 0; r < rows->size(); ++r) {
    EXPECT_EQ(rows->tangent_1[r][2], 0.0);
    const Resultant sum = resultant(scene, *rows, r, {random(-1, 1), random(-1, 1), 0.0}, u);
    EXPECT_LT(norm(sum.force), round_off);
    EXPECT_LT(norm(sum.moment), round_off);
  }
  for (const Facet& facet : slave) {  // in the plane
    for (const Index n : facet) {
      for (const Vec3 d : {Vec3{step, 0, 0}, Vec3{0, step, 0}}) {
        const auto r = static_cast<std::size_t>(row_of(*rows, n - slave[0][0]));
        const double slope = (gap_of(contact, with_displacement(u, n, d), rows->slot[r]) -
                              gap_of(contact, with_displacement(u, n, scaled(d, -1)), rows->slot[r])) /
                             (2 * step);
        EXPECT_NEAR(slope, dot(rows->block[static_cast<std::size_t>(rows->begin[r])][0], d) / step, slope_error);
      }
    }
  }
}

/// The lower face of a unit square at height z, looking down, n x n facets, displaced by (dx, dy).
std::vector<Facet> add_sole(Scene& scene, int n, double z, double dx, double dy, double size) {
  return scene.add_patch(n, n, [=](double s, double t) { return Vec3{dx + size * t, dy + size * s, z}; });
}

// A sole slides over a flat plate of another mesh, from the middle over the rim: every slot keeps its exact gap while
// its node is over the plate, on facets, edges and corners, and has none when the node is beyond the rim, where the gap
// has faded to zero.
TEST(NodeRows, KeepTheirSlotsWhileSlidingOverFacetsAndLoseThemBeyondTheRim) {
  Scene scene;
  const auto plate = scene.add_patch(5, 5, [](double s, double t) { return Vec3{s, t, 0}; });
  const double depth = 0.01;
  const auto sole = add_sole(scene, 3, -depth, 0.3, 0.3, 0.3);
  scene.finish().contacts.emplace_back(pair({sole}, {plate}));
  const ContactGeometry contact(scene.model);
  ASSERT_EQ(contact.slots(), 16U);
  const Index first = sole[0][0];
  for (int i = 0; i <= 100; ++i) {
    auto u = scene.zero();
    for (Index n = first; n < first + 16; ++n) u = with_displacement(u, n, {0.01 * i, 0.0, 0.0});
    const auto rows = contact.rows_at(u, u);
    for (Index slot = 0; slot < 16; ++slot) {
      const double x = scene.mesh.coordinates[first + slot][0] + 0.01 * i;
      const auto r = row_of(*rows, slot);
      if (x <= 1.02 - 1e-9) {  // the plate's facets of 0.2 are continued by a tenth, on which the gap fades
        ASSERT_GE(r, 0) << x;
        const double beyond = std::max(0.0, x - 1.0) / 0.02, share = std::pow(1.0 - beyond * beyond, 2);
        EXPECT_NEAR(rows->gap_at(static_cast<std::size_t>(r), u), -depth * share, round_off);
        if (x <= 1.0) {
          EXPECT_NEAR(rows->normal[static_cast<std::size_t>(r)][2], 1.0, round_off);
        }
      } else if (x > 1.02 + 1e-9) {
        EXPECT_LT(r, 0) << x;
      }
    }
  }
}

// A plate of triangles that are tilted against each other, and a node 0.1 beside a corner of their rim that is in front
// of one of them and behind their mean plane: its distance to the corner is no depth.
TEST(NodeRows, TakeNoDepthFromNodesBesideARim) {
  for (const double height : {-0.012, -0.009, -0.006, -0.003, 0.0, 0.003}) {
    Scene scene;
    const auto plate = scene.add_patch(
        2, 1,
        [](double s, double t) {
          return Vec3{s, t, t * (s == 0.5 ? 0.1 : -0.1)};
        },
        true);
    const auto sole = scene.add_patch(1, 1, [=](double s, double t) { return Vec3{0.5 + t, -0.6 + 0.5 * s, height}; });
    scene.finish().contacts.emplace_back(pair({sole}, {plate}));
    const auto u = scene.zero();
    const auto rows = ContactGeometry(scene.model).rows_at(u, u);
    for (std::size_t r = 0; r < rows->size(); ++r) EXPECT_GE(rows->gap_at(r, u), -0.02) << height;
  }
}

// A body whose upper side is a valley, and a node that has come along beside its wall, lower than the left side of the
// valley and before the right one continued: the left side, which is nearer, it has not come through, so that the right
// one is no closest point of the body, and does not make a mean with the left one.
TEST(NodeRows, BesideAWallMeetNoFacetThatIsFartherThanItsNeighbour) {
  for (double x = -0.09; x < 0.0; x += 0.01) {
    Scene scene;
    std::vector<Facet> body = scene.add_patch(2, 1, [](double s, double t) {
      return Vec3{2 * s - 1, t, 0.1 * std::abs(2 * s - 1)};
    });
    const std::array<Index, 3> rim{3, 4, 5};
    std::array<Index, 3> foot{};
    for (std::size_t i = 0; i < 3; ++i) foot[i] = scene.add_node({static_cast<double>(i) - 1.0, 1.0, -1.0});
    for (std::size_t i = 0; i < 2; ++i) body.push_back({{rim[i], rim[i + 1], foot[i + 1], foot[i]}, 4});
    const auto sole = scene.add_patch(1, 1, [x](double s, double t) { return Vec3{x + t, 1.03 + 0.5 * s, -0.003}; });
    scene.finish().contacts.emplace_back(pair({sole}, {body}));
    const ContactGeometry contact(scene.model);
    const std::vector<RowHistory> was_in_front(contact.slots());
    const auto u = scene.zero();
    const auto rows = contact.rows_at(u, u, {.history = was_in_front});
    for (std::size_t r = 0; r < rows->size(); ++r) EXPECT_GE(rows->gap_at(r, u), 0.0) << x;
  }
}

TEST(NodeRows, InTwoPassesHaveBothSidesSlotsAndHalfTheStiffness) {
  Scene scene;
  const auto plate = scene.add_patch(5, 5, [](double s, double t) { return Vec3{s, t, 0}; });
  const auto sole = add_sole(scene, 3, -0.01, 0.0, 0.0, 1.0);
  scene.finish().contacts.emplace_back(pair({sole}, {plate}, PairMethod::two_pass));
  const ContactGeometry contact(scene.model);
  ASSERT_EQ(contact.slots(), 16U + 36U);
  const auto rows = contact.rows_at(scene.zero(), scene.zero());
  ASSERT_EQ(rows->size(), 52U);
  double eps_N = 0.0, eps_T = 0.0;
  for (std::size_t r = 0; r < rows->size(); ++r) {
    EXPECT_EQ(rows->slot[r], static_cast<Index>(r));
    EXPECT_NEAR(rows->gap[r], -0.01, round_off);
    eps_N += rows->law[r].eps_N;
    eps_T += rows->law[r].eps_T;
  }
  EXPECT_NEAR(eps_N, 4.0 * 1.0, round_off);  // over both sides of the unit square, as one pass would have
  EXPECT_NEAR(eps_T, 2.0 * 1.0, round_off);
}

// A plate of 0.02 under facets of 0.25: the sole goes deeper than half of it and must still see the upper face.
TEST(NodeRows, DoNotTakeTheFarSideOfAThinPlate) {
  Scene scene;
  const auto plate = scene.add_box({0, 0, -0.02}, {1, 1, 0}, 4);
  const auto sole = add_sole(scene, 3, -0.015, 0.2, 0.2, 0.6);
  scene.finish().contacts.emplace_back(pair({sole}, {plate}));
  const auto rows = ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero());
  ASSERT_EQ(rows->size(), 16U);
  for (std::size_t r = 0; r < 16; ++r) {
    EXPECT_NEAR(rows->gap[r], -0.015, round_off);
    EXPECT_NEAR(norm(subtract(rows->normal[r], {0, 0, 1})), 0.0, round_off);
  }
}

// Through a thin plate within one step, the plate moving as well.
TEST(NodeRows, CatchAProjectileThatCrossesAThinPlateInOneStep) {
  Scene scene;
  const auto plate = scene.add_box({0, 0, -0.02}, {1, 1, 0}, 4);
  const auto sole = add_sole(scene, 2, 0.1, 0.2, 0.2, 0.6);
  scene.finish().contacts.emplace_back(pair({sole}, {plate}));
  const ContactGeometry contact(scene.model);
  const auto begin = scene.zero();
  auto end = begin;
  const auto nodes = static_cast<Index>(scene.mesh.coordinates.size());
  for (Index n = 0; n < nodes; ++n)
    end = with_displacement(end, n, n < sole[0][0] ? Vec3{0, 0, 0.5} : Vec3{0.05, 0, -3});
  const auto rows = contact.rows_at(begin, end);
  ASSERT_EQ(rows->size(), 9U);
  for (std::size_t r = 0; r < 9; ++r) EXPECT_NEAR(rows->gap_at(r, end), 0.1 - 3.5, round_off);
  EXPECT_EQ(contact.rows_at(end, end)->size(), 0U);
}

PairContact self(const Surface& surface, PairMethod method = PairMethod::node_to_surface) {
  PairContact contact = pair(surface, surface, method);
  contact.self = true;
  return contact;
}

// Plates, thin or of one cell, do not touch themselves.
TEST(SelfContact, FindsNothingOnABoxAlone) {
  for (const PairMethod method : {PairMethod::node_to_surface, PairMethod::surface_to_surface}) {
    for (const double thickness : {0.01, 0.1, 1.0}) {
      Scene scene;
      const auto skin = scene.add_box({0, 0, 0}, {1, 1, thickness}, 4);
      scene.finish().contacts.emplace_back(self({skin}, method));
      EXPECT_EQ(ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero())->size(), 0U) << thickness;
    }
  }
}

// A plate is crushed to a third of its thickness: its nodes come nearer to its other side than half of what it was
// thick.
TEST(SelfContact, TakesNoSideOfACrushedPlateForAnother) {
  Scene scene;
  const auto skin = scene.add_box({0, 0, 0}, {4, 4, 1}, 4);
  scene.finish().contacts.emplace_back(self({skin}));
  const ContactGeometry contact(scene.model);
  const auto crushed_to = [&](double thickness) {
    std::vector<double> u = scene.zero();
    for (std::size_t n = 0; n < scene.mesh.coordinates.size(); ++n)
      u[3 * n + 2] = (thickness - 1.0) * scene.mesh.coordinates[n][2];
    return u;
  };
  const std::vector<RowHistory> none_behind(contact.slots());
  EXPECT_EQ(contact.rows_at(crushed_to(0.35), crushed_to(0.33), {none_behind})->size(), 0U);
}

// Two boxes of equal section stand on each other, one shifted a little to the side, both in one surface: the nodes on
// the common rim keep their rows. Gap by construction.
TEST(SelfContact, OfTwoAlignedBoxesKeepsTheNodesOfTheRim) {
  for (const double offset : {0.0, 1e-9, 1e-3}) {
    for (const double gap : {1e-3, -1e-3}) {
      Scene scene;
      auto skin = scene.add_box({0, 0, 0}, {1, 1, 1}, 3);
      const auto upper = scene.add_box({offset, offset, 1 + gap}, {1 + offset, 1 + offset, 2 + gap}, 3);
      skin.insert(skin.end(), upper.begin(), upper.end());
      scene.finish().contacts.emplace_back(self({skin}));
      const auto rows = ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero());
      const auto nodes = static_cast<Index>(scene.mesh.coordinates.size());  // rows of edges follow
      std::set<Index> touching;
      for (std::size_t r = 0; r < rows->size(); ++r) {
        if (rows->slot[r] >= nodes || std::abs(rows->gap[r]) > 0.1) continue;
        EXPECT_NEAR(rows->gap[r], gap, round_off);
        touching.insert(rows->node[rows->begin[r]]);
      }
      EXPECT_EQ(touching.size(), 32U) << offset << " " << gap;  // 4 x 4 nodes on both faces
    }
  }
}

TEST(EndRows, FollowTheAxisOfTheBars) {
  Scene scene;
  for (const double x : {0.0, 1.0, 1.25, 2.0}) scene.add_node({0.6 * x, 0.8 * x, 0.0});
  CellBlock lines;
  lines.type = CellType::line2;
  lines.connectivity = {0, 1, 2, 3};
  scene.mesh.blocks.push_back(lines);
  const auto end = [](Index n) { return Surface{{{{n, -1, -1, -1}, 1}}, Section::bar, 0.5}; };
  scene.finish().contacts.emplace_back(pair(end(2), end(1), PairMethod::surface_to_surface));
  const ContactGeometry contact(scene.model);
  EXPECT_TRUE(contact.is_fixed());
  const auto rows = contact.rows_at(scene.zero(), scene.zero());
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_NEAR(rows->gap[0], 0.25, round_off);
  EXPECT_NEAR(norm(subtract(rows->normal[0], {0.6, 0.8, 0.0})), 0.0, round_off);
  EXPECT_EQ(rows->measure[0], 0.5);
  EXPECT_EQ(rows->law[0].eps_N, 2.0);
  EXPECT_NEAR(rows->gap_at(0, with_displacement(scene.zero(), 1, {0.18, 0.24, 0})), -0.05, round_off);
}

TEST(EndRows, AreRefusedAsMasterOfFacets) {
  Scene scene;
  const auto plate = scene.add_patch(1, 1, [](double s, double t) { return Vec3{s, t, 0}; });
  const Index n = scene.add_node({0.5, 0.5, 1});
  scene.finish().contacts.emplace_back(pair({plate}, {{{{n, -1, -1, -1}, 1}}, Section::bar}));
  EXPECT_THROW(ContactGeometry{scene.model}, std::invalid_argument);
}

TEST(NodeRows, HaveTheSameBitsForEveryNumberOfThreadsAndEverySearchList) {
  Scene scene;
  const auto at = [](double s, double t) { return Vec3{s, t, bump(s, t)}; };
  const auto master = scene.add_patch(40, 40, at);
  const auto slave = scene.add_patch(45, 45, [&](double s, double t) { return add(at(t, s), {0, 0, 0.005}); });
  for (const PairMethod method : {PairMethod::two_pass, PairMethod::surface_to_surface})
    scene.finish().contacts.emplace_back(pair({slave}, {master}, method));
  Random random(29);
  auto u = scene.zero();
  for (double& component : u) component = random(-0.002, 0.002);
  set_threads(1);
  ContactGeometry one(scene.model);
  const auto expected = one.rows_at(scene.zero(), u);
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    ContactGeometry other(scene.model);
    if (threads != 2) other.rows_at(u, scene.zero());  // another history of lists
    const auto rows = other.rows_at(scene.zero(), u);
    EXPECT_EQ(rows->gap, expected->gap);
    EXPECT_EQ(rows->node, expected->node);
    EXPECT_EQ(rows->block, expected->block);
    EXPECT_EQ(rows->slot, expected->slot);
  }
  set_threads(0);
}

}  // namespace
}  // namespace carom::contact_pairs_test
