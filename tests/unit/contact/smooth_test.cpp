// Facets seen as a smooth surface: the patch, its rows as gradients of their energy, balance, directions, flat faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <span>

#include "contact/smooth_surface.hpp"
#include "contact_rows_fixture.hpp"

namespace carom::contact_smooth_test {
namespace {

using namespace test;

/// A rotation by three angles.
struct Rotation {
  double a = 0.0, b = 0.0, c = 0.0;
  Vec3 operator()(const Vec3& x) const {
    const Vec3 y{x[0] * std::cos(a) - x[1] * std::sin(a), x[0] * std::sin(a) + x[1] * std::cos(a), x[2]};
    const Vec3 z{y[0], y[1] * std::cos(b) - y[2] * std::sin(b), y[1] * std::sin(b) + y[2] * std::cos(b)};
    return {z[0] * std::cos(c) - z[1] * std::sin(c), z[0] * std::sin(c) + z[1] * std::cos(c), z[2]};
  }
};

Rotation any_rotation(Random& random) {
  return {random(0.0, 6.0), random(0.0, 6.0), random(0.0, 6.0)};
}

/// The skin of a ball: n x n facets, or twice as many triangles, on each side of a cube thrown onto it by equal angles.
std::vector<Facet> add_ball(Scene& scene, int n, const Vec3& centre, double radius, const Rotation& turn,
                            bool triangles) {
  std::map<std::array<int, 3>, Index> nodes;
  const auto at = [&](const std::array<int, 3>& i) {
    const auto [entry, is_new] = nodes.try_emplace(i, 0);
    if (is_new) {
      Vec3 p{};
      for (std::size_t c = 0; c < 3; ++c) p[c] = std::tan((2.0 * i[c] / n - 1.0) * std::numbers::pi / 4.0);
      entry->second = scene.add_node(add(centre, scaled(turn(normalized(p)), radius)));
    }
    return entry->second;
  };
  std::vector<Facet> facets;
  for (std::size_t c = 0; c < 3; ++c)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::array<Index, 4> q{};
          for (std::size_t k = 0; k < 4; ++k) {
            std::array<int, 3> key{};
            key[c] = side;
            key[(c + 1) % 3] = i + (k == 1 || k == 2 ? 1 : 0);
            key[(c + 2) % 3] = j + (k > 1 ? 1 : 0);
            q[k] = at(key);
          }
          if (side == 0) std::swap(q[1], q[3]);
          if (triangles) {
            facets.push_back({{q[0], q[1], q[2], -1}, 3});
            facets.push_back({{q[0], q[2], q[3], -1}, 3});
          } else {
            facets.push_back({q, 4});
          }
        }
  return facets;
}

PairContact smooth_pair(const std::vector<Facet>& slave, const std::vector<Facet>& master,
                        Smoothing smooth = Smoothing::all) {
  PairContact contact;
  contact.name = "smooth";
  contact.slave = {slave};
  contact.master = {master};
  contact.smooth = smooth;
  contact.law.eps_N = 1.0;
  return contact;
}

/// Largest distance of the patches from the sphere of radius 1, at the middles of facets and of their edges.
double radius_error(int n, bool triangles) {
  Scene scene;
  const std::vector<Facet> facets = add_ball(scene, n, {}, 1.0, {}, triangles);
  scene.finish();
  const SmoothSurface surface(scene.mesh, facets, {});
  double error = 0.0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const SmoothPatch patch(place(facets[f], scene.mesh.coordinates), surface.bulge(static_cast<Index>(f)));
    for (const ParentPoint& p : triangles ? std::vector<ParentPoint>{{1.0 / 3.0, 1.0 / 3.0}, {0.5, 0.5}, {0.5, 0.0}}
                                          : std::vector<ParentPoint>{{0.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}})
      error = std::max(error, std::abs(norm(patch.at(p).position) - 1.0));
  }
  return error;
}

// Max's normals are exact on a sphere, and Nagata's quadratic then is of order 4: halved cells give a sixteenth, on
// cells that are alike to a few per cent only; 13 leaves room for that. Facets themselves are off by 1.8e-2 at n = 6.
TEST(SmoothSurface, IsOfOrderFourOnASphere) {
  for (const bool triangles : {true, false}) {
    const double coarse = radius_error(6, triangles), fine = radius_error(12, triangles);
    EXPECT_LT(coarse, 4e-4) << triangles;
    EXPECT_GT(coarse / fine, 13.0) << triangles;
  }
}

// The circle through both points with both normals, of radius 1 and angle a: the bulge of its arc is, to order 4,
// 1 - cos(a / 2) in the middle, where the curve x_0 + (d - c) s + c s^2 is d / 2 - c / 4.
TEST(SmoothSurface, BulgesAsAnArcDoes) {
  const double a = 0.2;
  const Vec3 n_0{-std::sin(a / 2), std::cos(a / 2), 0.0}, n_1{std::sin(a / 2), std::cos(a / 2), 0.0};
  const Vec3 c = edge_bulge(subtract(n_1, n_0), n_0, n_1);
  EXPECT_NEAR(c[0], 0.0, 1e-15);
  EXPECT_NEAR(-c[1] / 4.0, 1.0 - std::cos(a / 2), std::pow(a, 4) / 100.0);
  EXPECT_EQ(edge_bulge({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}), (Vec3{}));  // flat
}

/// Those facets of a surface none of whose nodes has a negative coordinate c, and the nodes that are held in the planes
/// of symmetry that bound them.
struct Cut {
  std::vector<Facet> facets;
  std::vector<Index> of_whole;
  std::vector<std::array<bool, 3>> held;

  Cut(const Mesh& mesh, const std::vector<Facet>& whole, std::span<const std::size_t> components)
      : held(mesh.coordinates.size()) {
    constexpr double round_off = 1e-14;
    for (std::size_t f = 0; f < whole.size(); ++f) {
      const bool stays = std::ranges::all_of(components, [&](std::size_t c) {
        return std::all_of(whole[f].begin(), whole[f].end(),
                           [&](Index n) { return mesh.coordinates[static_cast<std::size_t>(n)][c] > -round_off; });
      });
      if (!stays) continue;
      facets.push_back(whole[f]);
      of_whole.push_back(static_cast<Index>(f));
    }
    for (std::size_t n = 0; n < held.size(); ++n)
      for (const std::size_t c : components) held[n][c] = std::abs(mesh.coordinates[n][c]) < round_off;
  }
};

// A half and an eighth of a ball and half of a circle whose nodes are held in planes of symmetry have the bulges of the
// whole, to the round-off of sums in another order, and no end.
TEST(SmoothSurface, GoesOnAsItsImageAtPlanesOfSymmetry) {
  Scene scene;
  const std::vector<Facet> ball = add_ball(scene, 4, {}, 1.0, {}, false);
  std::vector<Facet> circle;
  const auto node = [&](int k) {
    const double angle = std::numbers::pi * k / 8.0;
    return scene.add_node({std::sin(angle), -std::cos(angle), 0.0});
  };
  const Index first = node(0);
  for (int k = 1; k < 16; ++k) node(k);
  for (int k = 0; k < 16; ++k) circle.push_back({{first + k, first + (k + 1) % 16, -1, -1}, 2});
  scene.finish();
  const std::array<std::size_t, 3> x{0, 1, 2};
  for (const auto& [whole, planes] : {std::pair{ball, 1U}, std::pair{ball, 3U}, std::pair{circle, 1U}}) {
    const Cut cut(scene.mesh, whole, std::span(x).first(planes));
    ASSERT_LT(cut.facets.size(), whole.size());
    const SmoothSurface all(scene.mesh, whole, {}), part(scene.mesh, cut.facets, {}, cut.held),
        open(scene.mesh, cut.facets, {});
    for (std::size_t f = 0; f < cut.facets.size(); ++f) {
      const Bulge &found = part.bulge(static_cast<Index>(f)), &expected = all.bulge(cut.of_whole[f]);
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found.edge[k][c], expected.edge[k][c], 1e-14);
      for (const Index n : cut.facets[f]) {
        EXPECT_TRUE(part.is_smooth_node(n));
        const std::array<bool, 3>& held = cut.held[static_cast<std::size_t>(n)];
        EXPECT_EQ(open.is_smooth_node(n), std::ranges::none_of(held, std::identity{}));
      }
    }
  }
}

// Where nodes are held along the plane of a circle, or a flat end is, no surface goes on.
TEST(SmoothSurface, EndsWhereNodesAreHeldOtherwise) {
  Scene scene;
  const Index a = scene.add_node({0, 0, 0}), b = scene.add_node({1, 0.1, 0}), c = scene.add_node({2, 0, 0});
  const std::vector<Facet> arc{{{c, b, -1, -1}, 2}, {{b, a, -1, -1}, 2}};
  scene.finish();
  std::vector<std::array<bool, 3>> held(scene.mesh.coordinates.size());
  for (const bool along_the_arc : {false, true}) {
    for (auto& components : held) components = {along_the_arc, true, true};
    const SmoothSurface surface(scene.mesh, arc, {}, held);
    EXPECT_EQ(surface.goes_on(0, 0), along_the_arc);
    EXPECT_EQ(surface.goes_on(1, 1), along_the_arc);
    EXPECT_TRUE(surface.goes_on(0, 1));
  }
}

// Flat facets, and those that meet at 30 degrees or more, have no bulge at all, and their contact has the rows of
// facets, to the last bit.
TEST(SmoothSurface, LeavesFlatFacesAndEdgesAlone) {
  const auto rows_of = [](Smoothing smooth) {
    Scene scene;
    const std::vector<Facet> lower = scene.add_box({0, 0, 0}, {3, 3, 1}, 3), upper = [&] {
      const std::size_t first = scene.mesh.coordinates.size();
      std::vector<Facet> box = scene.add_box({0, 0, 0}, {1, 1, 1}, 2);
      for (std::size_t n = first; n < scene.mesh.coordinates.size(); ++n)
        scene.mesh.coordinates[n] = add({1.1, 0.9, 0.98}, Rotation{0.3, 0.02, 0.0}(scene.mesh.coordinates[n]));
      return box;
    }();
    scene.finish().contacts.emplace_back(smooth_pair(upper, lower, smooth));
    const SmoothSurface surface(scene.mesh, upper, {});
    EXPECT_FALSE(surface.has_curved());
    for (std::size_t f = 0; f < upper.size(); ++f)
      EXPECT_EQ(surface.bulge(static_cast<Index>(f)).edge, (std::array<Vec3, 4>{}));
    const std::vector<double> u = scene.zero();
    return *ContactGeometry(scene.model).rows_at(u, u);
  };
  const ConstraintRows smooth = rows_of(Smoothing::all), facets = rows_of(Smoothing::none);
  EXPECT_GT(facets.size(), 8U);
  EXPECT_TRUE(smooth == facets);
}

/// Two balls that dip into each other by `depth` along any direction, a few cells on the radius.
struct Balls {
  Scene scene;
  Vec3 along{};

  Balls(unsigned seed, int n, double depth, bool triangles, double second = 1.0, Smoothing smooth = Smoothing::all) {
    Random random(seed);
    along = normalized(random.vector(1.0));
    const std::vector<Facet> lower = add_ball(scene, n, {}, 1.0, any_rotation(random), triangles);
    const std::vector<Facet> upper =
        add_ball(scene, n, scaled(along, 1.0 + second - depth), second, any_rotation(random), triangles);
    scene.finish().contacts.emplace_back(smooth_pair(upper, lower, smooth));
  }
};

// Left to the edges, two balls are smooth, and a ball before a box is not.
TEST(SmoothSurface, IsTheDefaultWhereNoEdgeIsSharp) {
  const auto rows_of = [](Smoothing smooth, bool with_box) {
    Scene scene;
    const std::vector<Facet> ball = add_ball(scene, 4, {}, 1.0, {}, false),
                             other = with_box ? scene.add_box({-1, -1, 0.98}, {1, 1, 2}, 3)
                                              : add_ball(scene, 4, {0, 0, 1.98}, 1.0, {}, false);
    scene.finish().contacts.emplace_back(smooth_pair(other, ball, smooth));
    const std::vector<double> u = scene.zero();
    return *ContactGeometry(scene.model).rows_at(u, u);
  };
  for (const bool with_box : {true, false}) {
    const ConstraintRows all = rows_of(Smoothing::all, with_box), none = rows_of(Smoothing::none, with_box);
    EXPECT_FALSE(all == none);
    EXPECT_TRUE(rows_of(Smoothing::round, with_box) == (with_box ? none : all));
  }
}

// The energy is a sum over points with a gradient that is continuous but where a foot passes from one facet to the
// next: patches are smooth across edges to order 3 alone, and shaken ones have the bulges of their reference. Steps of
// 1e-6 see such a passage in one of some hundred components; a mean that is a hundredth of a per cent off is none of
// the formulas'.
TEST(SmoothRows, ForcesAreTheGradientOfTheirEnergy) {
  Random random(5);
  for (const bool triangles : {true, false}) {
    const Balls balls(1, 6, 0.03, triangles);
    const ContactGeometry contact(balls.scene.model);
    const std::vector<double> u = shaken(balls.scene, random, 5e-4), f = forces(contact, u);
    constexpr double h = 1e-6;
    double error = 0.0, most = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      if (f[i] == 0.0) continue;
      std::vector<double> up = u, down = u;
      up[i] += h;
      down[i] -= h;
      error = std::max(error, std::abs(f[i] + (energy(contact, up) - energy(contact, down)) / (2.0 * h)));
      most = std::max(most, std::abs(f[i]));
    }
    EXPECT_GT(most, 0.0);
    EXPECT_LT(error / most, 1e-4) << triangles;
  }
}

TEST(SmoothRows, HaveNeitherForceNorMoment) {
  Random random(3);
  for (const bool triangles : {true, false}) {
    const Balls balls(2, 5, 0.05, triangles, 0.7);
    const ContactGeometry contact(balls.scene.model);
    const std::vector<double> u = shaken(balls.scene, random, 0.01);
    const auto rows = contact.rows_at(u, u);
    std::size_t closed = 0;
    for (std::size_t r = 0; r < rows->size(); ++r) {
      if (rows->gap_at(r, u) >= 0.0) continue;  // an open row has no force
      ++closed;
      for (const Vec3& s : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Resultant sum = resultant(balls.scene, *rows, r, s, u);
        EXPECT_LT(norm(sum.force), 1e-13);   // sums of some hundred terms
        EXPECT_LT(norm(sum.moment), 1e-12);  // positions up to 2
      }
    }
    EXPECT_GT(closed, 5U);
  }
}

/// The direction of the force on the upper ball, off the line of centres: sine.
double sideways(const Balls& balls) {
  const ContactGeometry contact(balls.scene.model);
  const std::vector<double> u = balls.scene.zero();
  const auto rows = contact.rows_at(u, u);
  Vec3 sum{};
  for (std::size_t r = 0; r < rows->size(); ++r) {
    const double force = rows->law[r].spring_force(std::max(0.0, -rows->gap_at(r, u)));
    Vec3 own{};
    const bool is_back = rows->is_back[r];
    const Index last = rows->begin[r + 1], others = last - rows->behind[r];
    for (Index k = is_back ? others : rows->begin[r]; k < (is_back ? last : others); ++k)
      own = add(own, scaled(rows->block[static_cast<std::size_t>(k)][0], force));
    sum = add(sum, own);
  }
  return norm(cross(normalized(sum), balls.along));
}

// Balls of R / h = 3.4 that touch anywhere: the force is along their centres. Facets are turned by up to 0.14 from the
// spheres'. The prototypes with 108 points on each facet had 5.5e-4 at most at a depth of 0.1 h^2 / R.
TEST(SmoothRows, BallsPressAlongTheirCentres) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    EXPECT_LT(sideways(Balls(seed, 6, 0.0087, true)), 3e-3) << seed;
    EXPECT_LT(sideways(Balls(seed, 6, 0.03, true)), 2e-3) << seed;
    EXPECT_LT(sideways(Balls(seed, 6, 0.0087, false, 0.5)), 4e-3) << seed;
  }
}

// What smoothing is for: the same balls seen as facets press along the normals of these, turned by up to 0.14.
TEST(SmoothRows, AreNotMadeWhereTheContactSeesFacets) {
  double most = 0.0;
  for (unsigned seed = 1; seed <= 12; ++seed)
    most = std::max(most, sideways(Balls(seed, 6, 0.03, true, 1.0, Smoothing::none)));
  EXPECT_GT(most, 0.05);
}

// Facets that touch nowhere while the surfaces over them do: that is the rounding, and no penetration at the start.
TEST(SmoothRows, DoNotCallTheBulgePenetration) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Balls as_facets(seed, 6, 0.002, true, 1.0, Smoothing::none), balls(seed, 6, 0.002, true);
    const std::vector<double> u = balls.scene.zero();
    if (!ContactGeometry(as_facets.scene.model).initial_penetrations(u).empty()) continue;
    const std::vector<Penetration> found = ContactGeometry(balls.scene.model).initial_penetrations(u);
    EXPECT_FALSE(found.empty());
    for (const Penetration& p : found) EXPECT_EQ(p.rounded, p.depth);
  }
}

// Triangles bent to a bowl, whose rim |x| + |y| = sqrt(1/2) is turned by 45 degrees to the axes, so that the boxes
// around them stick out over it; everywhere 4e-3 inside of a larger bowl, whose nodes stand 1/4 apart along both axes.
// Those that are more than a facet, 1/2 in |x| + |y|, beyond the rim have no force.
TEST(SmoothRows, OfTrianglesEndAtTheRim) {
  Scene scene;
  const auto bowl = [](double x, double y) { return 0.02 * (x * x + y * y); };
  const std::vector<Facet> lower = scene.add_patch(
      4, 4,
      [&](double s, double t) {
        const double x = (s - t) * std::sqrt(0.5), y = (s + t - 1.0) * std::sqrt(0.5);
        return Vec3{x, y, bowl(x, y)};
      },
      true);
  const auto first = scene.mesh.coordinates.size();
  const std::vector<Facet> upper = scene.add_patch(
      8, 8,
      [&](double s, double t) {
        const double x = 2.0 * t - 1.0, y = 2.0 * s - 1.0;
        return Vec3{x, y, bowl(x, y) - 4e-3};
      },
      true);
  PairContact contact = smooth_pair(upper, lower);
  contact.method = PairMethod::faces;
  scene.finish().contacts.emplace_back(contact);
  const std::vector<double> f = forces(ContactGeometry(scene.model), scene.zero());
  double inside = 0.0, beyond = 0.0;
  for (std::size_t n = first; n < scene.mesh.coordinates.size(); ++n) {
    const Vec3& x = scene.mesh.coordinates[n];
    const bool is_beyond = std::abs(x[0]) + std::abs(x[1]) > std::sqrt(0.5) + 0.5 + 1e-9;
    (is_beyond ? beyond : inside) += std::abs(f[3 * n + 2]);
  }
  EXPECT_GT(inside, 0.0);
  EXPECT_EQ(beyond, 0.0);
}

// Smoothing is for springs of both passes: any other rows see facets.
TEST(SmoothRows, AreOfSpringsOfBothPassesAlone) {
  const auto rows_of = [](Smoothing smooth, PairMethod method, RowHold hold) {
    Balls balls(3, 4, 0.02, true, 1.0, smooth);
    auto& pair = std::get<PairContact>(balls.scene.model.contacts[0]);
    pair.method = method;
    pair.law.hold = hold;
    const std::vector<double> u = balls.scene.zero();
    return *ContactGeometry(balls.scene.model).rows_at(u, u);
  };
  for (const PairMethod method : {PairMethod::node_to_surface, PairMethod::two_pass, PairMethod::faces})
    for (const RowHold hold : {RowHold::springs, RowHold::multipliers}) {
      const bool is_smooth = has_both_passes(method) && hold == RowHold::springs;
      EXPECT_EQ(rows_of(Smoothing::all, method, hold) == rows_of(Smoothing::none, method, hold), !is_smooth);
    }
}

}  // namespace
}  // namespace carom::contact_smooth_test
