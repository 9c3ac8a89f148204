// From contact definitions to constraint rows.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact/contact_geometry.hpp"
#include "contact_fixture.hpp"
#include "math/vec3.hpp"
#include "rows/penalty.hpp"
#include "solid_fixture.hpp"

namespace carom::contact_test {
namespace {

using namespace test;

constexpr double round_off = 1e-14;  // sums of at most some ten numbers below 10, 2^-53 each

/// Rows at zero displacement.
ConstraintRows rows_of(const Model& model) {
  const std::vector<double> zero(3 * model.mesh->node_count(), 0.0);
  return *ContactGeometry(model).rows_at(zero, zero);
}

ObstacleContact per_node(const std::string& name, const Plane& plane, const std::vector<Index>& nodes,
                         const ContactLaw& law) {
  ObstacleContact contact;
  contact.name = name;
  contact.shape = plane;
  contact.measure = RowMeasure::per_node;
  contact.nodes = nodes;
  contact.law = law;
  return contact;
}

/// A body of 2 x 3 x 1 unit cells on interface cells with the given numbering, frictionless, eps_N = 5.
Model on_interface(const InterfaceNumbering& numbering) {
  Mesh mesh = block_mesh({2, 3, 1}, 0.0);
  Model model = one_part(mesh);
  const std::vector<Index> cells = add_interface(mesh, "ZMIN", numbering);
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  model.contacts.emplace_back(InterfaceContact{"wall", cells, {.eps_N = 5.0, .eps_T = {}}});
  return model;
}

/// The wall and the body on each of the three pairs of opposite faces, the right way round (normal from wall to body),
/// with the body on the first face of the pair, and with the normal the wrong way round.
std::vector<InterfaceNumbering> all_numberings() {
  return {
      {{0, 1, 2, 3}, {4, 5, 6, 7}}, {{0, 3, 7, 4}, {1, 2, 6, 5}}, {{0, 4, 5, 1}, {3, 7, 6, 2}},
      {{4, 7, 6, 5}, {0, 3, 2, 1}}, {{1, 5, 6, 2}, {0, 4, 7, 3}}, {{3, 2, 6, 7}, {0, 1, 5, 4}},
      {{0, 3, 2, 1}, {4, 7, 6, 5}}, {{0, 4, 7, 3}, {1, 5, 6, 2}}, {{0, 1, 5, 4}, {3, 2, 6, 7}},
      {{4, 5, 6, 7}, {0, 1, 2, 3}}, {{1, 2, 6, 5}, {0, 3, 7, 4}}, {{3, 7, 6, 2}, {0, 4, 5, 1}},
  };
}

TEST(InterfaceRows, PointFromTheWallToThePartHoweverTheCellIsNumbered) {
  for (const InterfaceNumbering& numbering : all_numberings()) {
    SCOPED_TRACE(testing::PrintToString(numbering.wall));
    const Model model = on_interface(numbering);
    const ConstraintRows rows = rows_of(model);
    ASSERT_EQ(rows.size(), 4U * 6U);  // 2 x 2 Gauss points of 2 x 3 cells
    for (std::size_t r = 0; r < rows.size(); ++r) {
      EXPECT_NEAR(norm(subtract(rows.normal[r], {0, 0, 1})), 0.0, round_off);
      EXPECT_EQ(rows.gap[r], 0.0);
      double sum = 0.0;
      for (Index k = rows.begin[r]; k < rows.begin[r + 1]; ++k) {
        const double weight = rows.block[static_cast<std::size_t>(k)][0][2];  // along the normal z
        sum += weight;
        // The 36 nodes of the body come first; shape functions are positive inside a face.
        EXPECT_EQ(weight > 0.0, rows.node[static_cast<std::size_t>(k)] < 24);
      }
      EXPECT_NEAR(sum, 0.0, round_off);
    }
    EXPECT_NEAR(std::accumulate(rows.measure.begin(), rows.measure.end(), 0.0), 6.0, 10 * round_off);
  }
}

TEST(InterfaceRows, SayWhenNormalsWereTurned) {
  EXPECT_TRUE(ContactGeometry(on_interface({})).notes().empty());
  const Model turned = on_interface({{0, 3, 2, 1}, {4, 7, 6, 5}});
  const std::vector<std::string> notes = ContactGeometry(turned).notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "contact \"wall\": the normal of 6 interface cell(s) was turned towards the part");
}

// The rows stand at the Gauss points, so that they integrate: a unit displacement of the body along z, times the area,
// sums to the area; one linear in x to the area times the mean of x (exact for the 2 x 2 rule).
TEST(InterfaceRows, IntegrateLinearDisplacementsExactly) {
  const Model model = on_interface({});
  const ConstraintRows rows = rows_of(model);
  std::vector<double> u = affine(*model.mesh, {{{0, 0, 0}, {0, 0, 0}, {2, 0, 0}}}, {0, 0, 1});
  for (const Index n : model.mesh->nodes_of("WALL")) u[3 * static_cast<std::size_t>(n) + 2] = 0.0;
  double integral = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) integral += rows.measure[r] * rows.relative(r, u)[0];
  EXPECT_NEAR(integral, 6.0 * (1.0 + 2.0 * 1.0), 100 * round_off);
}

TEST(InterfaceRows, RefuseACellWithThickness) {
  Model model = on_interface({});
  std::get<InterfaceContact>(model.contacts[0]).cells = {2};  // a cell of the body
  try {
    ContactGeometry{model};
    FAIL() << "no error";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(
        e.what(),
        "contact \"wall\": cell 3 is not of zero thickness; the two opposite faces of an interface cell coincide");
  }
}

TEST(PlaneRows, PerAreaShareTheFacesAmongTheNodes) {
  Model model = one_part(block_mesh({2, 3, 1}, 0.0));
  ObstacleContact plane;
  plane.name = "plane";
  plane.shape = Plane{{0, 0, -0.5}, {0, 0, 1}};
  plane.law.eps_N = 7.0;
  for (const CellRef& ref : model.mesh->cell_groups.at("ZMIN")) {
    Facet face{{}, 4};
    const auto& quads = model.mesh->blocks[static_cast<std::size_t>(ref.block)];
    std::copy_n(quads.connectivity.begin() + 4 * ref.cell, 4, face.node.begin());
    plane.surface.facets.push_back(face);
  }
  model.contacts.emplace_back(plane);
  const ConstraintRows rows = rows_of(model);
  ASSERT_EQ(rows.size(), 12U);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Vec3& x = rows.position[r];
    const double corner_x = x[0] == 1.0 ? 1.0 : 0.5, corner_y = x[1] == 1.0 || x[1] == 2.0 ? 1.0 : 0.5;
    EXPECT_NEAR(rows.measure[r], corner_x * corner_y, round_off);  // integral of N_a over unit squares
    EXPECT_EQ(rows.gap[r], 0.5);
  }
  EXPECT_NEAR(std::accumulate(rows.measure.begin(), rows.measure.end(), 0.0), 6.0, 10 * round_off);
  EXPECT_NEAR(rows.law[0].eps_N, 7.0 * rows.measure[0], round_off);
}

TEST(PlaneRows, PerNodeAndTilted) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  const double s = std::sqrt(0.5);
  const auto nodes = model.mesh->nodes_of("XMIN");
  model.contacts.emplace_back(
      per_node("tilted", Plane{{0, 0, -1}, {s, 0, s}}, nodes, {.eps_N = 3.0, .eps_T = 2.0, .mu = 0.25}));
  const ConstraintRows rows = rows_of(model);
  ASSERT_EQ(rows.size(), 4U);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    EXPECT_NEAR(rows.gap[r], s * (rows.position[r][2] + 1.0), round_off);  // n . (x - point), x = 0 on the face
    EXPECT_EQ(rows.measure[r], 1.0);
    EXPECT_EQ(rows.law[r].mu, 0.25);
    EXPECT_NEAR(dot(rows.tangent_1[r], rows.normal[r]), 0.0, round_off);
    EXPECT_NEAR(norm(subtract(cross(rows.normal[r], rows.tangent_1[r]), rows.tangent_2[r])), 0.0, round_off);
  }
  const RowLaw parameters = rows.law[0];
  EXPECT_EQ(parameters.eps_N, 3.0);
  EXPECT_EQ(parameters.eps_T, 2.0);
}

TEST(StopRows, OnePerNode) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  model.contacts.emplace_back(StopContact{"stop", model.mesh->nodes_of("YMAX"), {0, -1, 0}, 0.2, 11.0, 0.5});
  const ConstraintRows rows = rows_of(model);
  ASSERT_EQ(rows.size(), 4U);
  std::vector<double> u(3 * model.mesh->node_count(), 0.0);
  for (std::size_t n = 0; n < model.mesh->node_count(); ++n) u[3 * n + 1] = 0.3;
  for (std::size_t r = 0; r < rows.size(); ++r) EXPECT_NEAR(rows.gap_at(r, u), -0.1, round_off);
  const RowLaw parameters = rows.law[0];
  EXPECT_EQ(parameters.eps_N, 11.0);
  EXPECT_EQ(parameters.damping, 0.5);
}

TEST(PenaltyParametersOf, FrictionWithoutACoefficientHasNoStiffness) {
  Model model = one_part(block_mesh({1, 1, 1}, 0.0));
  const auto nodes = model.mesh->nodes_of("ZMIN");
  model.contacts.emplace_back(per_node("smooth", Plane{}, nodes, {1.0, 100.0}));
  EXPECT_EQ(rows_of(model).law[0].eps_T, 0.0);
}

}  // namespace
}  // namespace carom::contact_test
