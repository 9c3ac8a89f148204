// Rows of surface-to-surface contact: exact transfer between flat meshes, balance of forces and moments.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "contact_rows_fixture.hpp"
#include "element/quad4.hpp"
#include "math/gauss_legendre.hpp"

namespace carom::contact_mortar_test {
namespace {

using namespace test;

constexpr double round_off = 1e-12;  // positions below 10, sums of some hundred terms

PairContact mortar(const Surface& slave, const Surface& master) {
  PairContact contact;
  contact.name = "mortar";
  contact.method = PairMethod::surface_to_surface;
  contact.slave = slave;
  contact.master = master;
  contact.law.eps_N = 1.0;
  return contact;
}

/// Two flat surfaces of n x m and p x q facets on [0, 2] x [0, 1], or of other sizes, the slave above looking down.
struct Flat {
  Scene scene;
  std::vector<Facet> slave, master;

  Flat(std::array<int, 2> slave_cells, std::array<int, 2> master_cells, double gap, bool triangles,
       double slave_length = 2.0, double master_length = 2.0) {
    slave = scene.add_patch(
        slave_cells[1], slave_cells[0],
        [=](double s, double t) {
          return Vec3{slave_length * t, s, gap};
        },
        triangles);
    master = scene.add_patch(
        master_cells[0], master_cells[1],
        [=](double s, double t) {
          return Vec3{master_length * s, t, 0};
        },
        triangles);
    scene.finish().contacts.emplace_back(mortar({slave}, {master}));
  }
  std::vector<Index> nodes_of(const std::vector<Facet>& facets) const {
    std::set<Index> nodes;
    for (const Facet& facet : facets) nodes.insert(facet.begin(), facet.end());
    return {nodes.begin(), nodes.end()};
  }
};

/// Integral of N_a p over facets in the plane z = const, p = c_0 + c_1 x + c_2 y: 3 x 3 Gauss points are exact on
/// rectangles, the vertex formula of linear fields on triangles.
std::map<Index, double> consistent_forces(const Scene& scene, const std::vector<Facet>& facets, const Vec3& c) {
  std::map<Index, double> force;
  const auto x = [&](Index n) { return scene.mesh.coordinates[static_cast<std::size_t>(n)]; };
  const auto p = [&](const Vec3& at) { return c[0] + c[1] * at[0] + c[2] * at[1]; };
  for (const Facet& facet : facets) {
    if (facet.size == 3) {
      const double area = 0.5 * norm(cross(subtract(x(facet[1]), x(facet[0])), subtract(x(facet[2]), x(facet[0]))));
      const double sum = p(x(facet[0])) + p(x(facet[1])) + p(x(facet[2]));
      for (const Index n : facet) force[n] += area / 12.0 * (sum + p(x(n)));
      continue;
    }
    const double area = norm(subtract(x(facet[1]), x(facet[0]))) * norm(subtract(x(facet[3]), x(facet[0])));
    for (const QuadraturePoint& xi : gauss_legendre(3)) {
      for (const QuadraturePoint& eta : gauss_legendre(3)) {
        const auto N = quad4::shape(xi.x, eta.x);
        Vec3 at{};
        for (std::size_t a = 0; a < 4; ++a) at = add(at, scaled(x(facet[a]), N[a]));
        for (std::size_t a = 0; a < 4; ++a) force[facet[a]] += 0.25 * area * xi.weight * eta.weight * N[a] * p(at);
      }
    }
  }
  return force;
}

/// Nodal forces along z of row forces s_A = D_A p(x_A).
std::vector<double> forces_of_pressure(const Scene& scene, const ConstraintRows& rows, const Vec3& c) {
  std::vector<double> f(scene.zero());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3& x = rows.position[r];
    rows.scatter(r, {rows.measure[r] * (c[0] + c[1] * x[0] + c[2] * x[1]), 0.0, 0.0}, f);
  }
  return f;
}

TEST(MortarRows, GiveBothSidesTheConsistentForcesOfALinearPressure) {
  const Vec3 pressure{1.0, 0.7, -0.4};
  for (const bool triangles : {false, true}) {
    for (const std::array<int, 2> master_cells :
         {std::array{4, 3}, std::array{5, 4}, std::array{3, 2}, std::array{7, 1}}) {
      const Flat flat({4, 3}, master_cells, 0.01, triangles);
      const auto rows = ContactGeometry(flat.scene.model).rows_at(flat.scene.zero(), flat.scene.zero());
      ASSERT_EQ(rows->size(), 5U * 4U);
      EXPECT_NEAR(std::accumulate(rows->measure.begin(), rows->measure.end(), 0.0), 2.0, round_off);
      for (const double gap : rows->gap) EXPECT_NEAR(gap, 0.01, round_off);
      const std::vector<double> f = forces_of_pressure(flat.scene, *rows, pressure);
      for (const auto& [n, expected] : consistent_forces(flat.scene, flat.slave, pressure))
        EXPECT_NEAR(f[3 * static_cast<std::size_t>(n) + 2], expected, round_off);
      for (const auto& [n, expected] : consistent_forces(flat.scene, flat.master, pressure))
        EXPECT_NEAR(f[3 * static_cast<std::size_t>(n) + 2], -expected, round_off);
    }
  }
}

// The slave hangs over: 2.0 long on a master of 1.3. Uniform pressure loads all of the master, and of the slave the
// covered part only.
TEST(MortarRows, CountTheCoveredPartOfAnOverhangingSlave) {
  const Flat flat({4, 2}, {3, 3}, -0.02, false, 2.0, 1.3);
  const auto rows = ContactGeometry(flat.scene.model).rows_at(flat.scene.zero(), flat.scene.zero());
  ASSERT_EQ(rows->size(), 4U * 3U);  // the column at 2.0 is not covered
  EXPECT_NEAR(std::accumulate(rows->measure.begin(), rows->measure.end(), 0.0), 1.3, round_off);
  for (const double gap : rows->gap) EXPECT_NEAR(gap, -0.02, round_off);
  const std::vector<double> f = forces_of_pressure(flat.scene, *rows, {1, 0, 0});
  for (const auto& [n, expected] : consistent_forces(flat.scene, flat.master, {1, 0, 0}))
    EXPECT_NEAR(f[3 * static_cast<std::size_t>(n) + 2], -expected, round_off);
  double total = 0.0;
  for (const Index n : flat.nodes_of(flat.slave)) total += f[3 * static_cast<std::size_t>(n) + 2];
  EXPECT_NEAR(total, 1.3, round_off);
}

TEST(MortarRows, OfFlatParallelSurfacesAreTheGradientOfTheGap) {
  const Flat flat({3, 2}, {4, 3}, 0.03, false);
  const ContactGeometry contact(flat.scene.model);
  const auto u = flat.scene.zero();
  const auto rows = contact.rows_at(u, u);
  const double h = 1e-7;
  for (std::size_t r = 0; r < rows->size(); ++r) {
    for (Index k = rows->begin[r]; k < rows->begin[r + 1]; ++k) {
      const Index n = rows->node[static_cast<std::size_t>(k)];
      const double slope = (gap_of(contact, with_displacement(u, n, {0, 0, h}), rows->slot[r]) -
                            gap_of(contact, with_displacement(u, n, {0, 0, -h}), rows->slot[r])) /
                           (2 * h);
      // out of the plane; round-off 1e-16 / h, and on the rim, where one side alone is clipped, h gap / size^2
      EXPECT_NEAR(slope, rows->block[static_cast<std::size_t>(k)][0][2], 1e-8);
    }
  }
}

// Triangles that lie wholly over one tilted facet: their points stay where they are on the slave, so the row is the
// gradient of the gap by every node and in every direction, at a gap and at an angle.
TEST(MortarRows, OfTiltedSurfacesAreTheGradientOfTheGap) {
  for (const double slope_of_master : {0.0, 0.3, 1.0}) {
    Scene scene;
    const auto master = scene.add_patch(1, 1, [=](double s, double t) {
      return Vec3{4 * s - 2, 4 * t - 2, slope_of_master * (4 * s - 2) - 0.1 * slope_of_master * t};
    });
    const auto slave = scene.add_patch(
        2, 2,
        [](double s, double t) {
          return Vec3{t - 0.4, s - 0.6, 0.2 + 0.1 * s * t};
        },
        true);
    scene.finish().contacts.emplace_back(mortar({slave}, {master}));
    const ContactGeometry contact(scene.model);
    const auto u = scene.zero();
    ASSERT_EQ(contact.rows_at(u, u)->size(), 9U);
    EXPECT_LT(gradient_error(contact, u, 1e-6), 1e-8);  // h^2 and the round-off of the gap over h, 1e-10
  }
}

// Curved, tilted, warped, with a gap: whatever the force of a row is, its reactions balance it, moments included.
TEST(MortarRows, LeaveNoForceAndNoMoment) {
  Random random(31);
  for (const bool triangles : {false, true}) {
    for (const double gap : {0.1, -0.05}) {
      Scene scene;
      const auto bump = [](double x, double y) { return 0.1 * std::sin(4 * x + 1) * std::cos(3 * y); };
      const auto master = scene.add_patch(
          5, 4,
          [&](double s, double t) {
            return Vec3{s, t, bump(s, t)};
          },
          triangles);
      const auto slave = scene.add_patch(
          3, 6,
          [&](double s, double t) {
            return Vec3{t, s, bump(t, s) + gap};
          },
          triangles);
      scene.finish().contacts.emplace_back(mortar({slave}, {master}));
      auto u = scene.zero();
      for (double& component : u) component = random(-0.01, 0.01);
      const auto rows = ContactGeometry(scene.model).rows_at(u, u);
      ASSERT_GE(rows->size(), 4U * 7U);
      for (std::size_t r = 0; r < rows->size(); ++r) {
        const Resultant sum = resultant(scene, *rows, r, random.vector(1.0), u);
        EXPECT_LT(norm(sum.force), round_off);
        EXPECT_LT(norm(sum.moment), round_off);
      }
    }
  }
}

/// Segments along y = height from x = 1 to x = 3, leftwards ones look up.
std::vector<Facet> add_segments(Scene& scene, int n, double height, bool leftwards) {
  std::vector<Facet> facets;
  Index last = -1;
  for (int i = 0; i <= n; ++i) {
    const double s = leftwards ? 1.0 - double(i) / n : double(i) / n;
    const Index next = scene.add_node({1 + 2 * s, height, 0.0});
    if (i > 0) facets.push_back({{last, next, -1, -1}, 2});
    last = next;
  }
  return facets;
}

TEST(MortarRows, InThePlaneGiveBothSidesTheConsistentForces) {
  for (const Section section : {Section::plane_strain, Section::axisymmetric}) {
    const bool is_ring = section == Section::axisymmetric;
    Scene scene;
    const Surface master{add_segments(scene, 5, 0.0, true), section, 0.5};
    const Surface slave{add_segments(scene, 3, 0.02, false), section, 0.5};
    scene.finish().contacts.emplace_back(mortar(slave, master));
    const auto u = scene.zero();
    const auto rows = ContactGeometry(scene.model).rows_at(u, u);
    ASSERT_EQ(rows->size(), 4U);
    std::vector<double> f(u.size(), 0.0);
    for (std::size_t r = 0; r < rows->size(); ++r) {
      EXPECT_NEAR(rows->gap[r], 0.02, round_off);
      rows->scatter(r, {rows->measure[r], 0.0, 0.0}, f);
    }
    for (const auto* surface : {&slave, &master}) {
      std::map<Index, double> expected;  // of unit pressure: thickness L / 2, or 2 pi L (2 x_a + x_b) / 6 on a ring
      for (const Facet& facet : surface->facets) {
        const double x_0 = scene.mesh.coordinates[facet[0]][0], x_1 = scene.mesh.coordinates[facet[1]][0];
        const double length = std::abs(x_1 - x_0);
        const double pi = std::numbers::pi;
        expected[facet[0]] += length * (is_ring ? pi * (2 * x_0 + x_1) / 3 : 0.25);
        expected[facet[1]] += length * (is_ring ? pi * (2 * x_1 + x_0) / 3 : 0.25);
      }
      const double sign = surface == &slave ? 1.0 : -1.0;
      for (const auto& [n, force] : expected)
        EXPECT_NEAR(f[3 * static_cast<std::size_t>(n) + 1], sign * force, 10 * round_off);  // forces up to 10
    }
  }
}

// A second plate right under the first one is hidden by it.
TEST(MortarRows, SeeOnlyTheNearestOfTwoPlates) {
  Scene scene;
  auto plates = scene.add_box({0, 0, -0.05}, {1, 1, 0}, 3);
  const auto second = scene.add_box({0, 0, -0.15}, {1, 1, -0.1}, 4);
  plates.insert(plates.end(), second.begin(), second.end());
  const auto slave = scene.add_patch(3, 3, [](double s, double t) { return Vec3{0.1 + 0.8 * t, 0.1 + 0.8 * s, 0.01}; });
  scene.finish().contacts.emplace_back(mortar({slave}, {plates}));
  const auto rows = ContactGeometry(scene.model).rows_at(scene.zero(), scene.zero());
  ASSERT_EQ(rows->size(), 16U);
  EXPECT_NEAR(std::accumulate(rows->measure.begin(), rows->measure.end(), 0.0), 0.64, round_off);
  for (const double gap : rows->gap) EXPECT_NEAR(gap, 0.01, round_off);
}

TEST(MortarRows, CatchASlaveThatCrossesAPlateInOneStep) {
  Scene scene;
  const auto plate = scene.add_box({0, 0, -0.02}, {1, 1, 0}, 4);
  const auto slave = scene.add_patch(2, 2, [](double s, double t) { return Vec3{0.1 + 0.8 * t, 0.1 + 0.8 * s, 0.1}; });
  scene.finish().contacts.emplace_back(mortar({slave}, {plate}));
  const ContactGeometry contact(scene.model);
  auto end = scene.zero();
  for (Index n = slave[0][0]; n < slave[0][0] + 9; ++n) end = with_displacement(end, n, {0, 0, -3});
  const auto rows = contact.rows_at(scene.zero(), end);
  ASSERT_EQ(rows->size(), 9U);
  for (std::size_t r = 0; r < 9; ++r) EXPECT_NEAR(rows->gap_at(r, end), -2.9, round_off);
  EXPECT_EQ(contact.rows_at(end, end)->size(), 0U);
}

// A tip of 2 x 2 facets, inclined by 0.3 both ways, is pushed into a plate of 3 x 3 facets of 1.4 amid one, 0.015 a
// step, while the mean about its node is open: depths that the steps before have seen go on to count beyond 0.02 facet
// sizes. The mean height of a facet that rises by 0.3 (x + y), with the weight (1 - x)(1 - y), is 0.2 over the tip;
// gaps are along the facets' normals, (0.3, 0.3, -1). (Where they did not count, the row jumped to what is open about
// the tip, and threw the tip out, deep at once, when that closed.)
TEST(MortarRows, OfATipGoOnToSeeWhatIsDeepInIt) {
  Scene scene;
  const auto tip = scene.add_patch(2, 2, [](double s, double t) {
    const double x = 2.0 * t - 1.0, y = 2.0 * s - 1.0;
    return Vec3{x, y, 0.05 + 0.3 * (std::abs(x) + std::abs(y))};
  });
  const auto plate = scene.add_patch(3, 3, [](double s, double t) { return Vec3{4.2 * s - 2.1, 4.2 * t - 2.1, 0.0}; });
  scene.finish().contacts.emplace_back(mortar({tip}, {plate}));
  const ContactGeometry contact(scene.model);
  const Index pole = tip[0][2];
  ASSERT_NEAR(norm(subtract(scene.mesh.coordinates[static_cast<std::size_t>(pole)], {0.0, 0.0, 0.05})), 0.0, round_off);
  std::vector<double> begin = scene.zero();
  std::vector<RowHistory> history = contact.first_history(begin);
  for (int step = 1; step <= 22; ++step) {
    std::vector<double> u = scene.zero();
    for (Index n = 0; n < 9; ++n) u[3 * static_cast<std::size_t>(n) + 2] = -0.015 * step;
    const auto rows = contact.rows_at(begin, u, {history});
    bool is_found = false;
    for (std::size_t r = 0; r < rows->size(); ++r) {
      if (rows->node[static_cast<std::size_t>(rows->begin[r])] != pole) continue;
      is_found = true;
      EXPECT_NEAR(rows->gap_at(r, u), std::sqrt(1.18) * (0.25 - 0.015 * step), round_off) << step;
    }
    EXPECT_TRUE(is_found) << step;
    history.assign(history.size(), {});
    mark_behind(*rows, u, history);
    begin = u;
  }
}

}  // namespace
}  // namespace carom::contact_mortar_test
