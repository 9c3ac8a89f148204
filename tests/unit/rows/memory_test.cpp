// What was behind a surface stays behind it; bodies that overlap.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "contact_rows_fixture.hpp"
#include "mesh/skin.hpp"
#include "mesh/structured_block.hpp"
#include "rows/response.hpp"
#include "surface/body_overlap.hpp"

namespace carom::contact_memory_test {
namespace {

using namespace test;

constexpr double round_off = 1e-13;  // positions below 10, some ten operations

/// The history of a step that ended at u with the rows made there.
std::vector<RowHistory> history_at(const ContactGeometry& contact, const std::vector<double>& u,
                                   const std::vector<RowHistory>& before) {
  ContactResponse response;
  response.rows = contact.rows_at(u, u, {before});
  response.history.resize(contact.slots());
  std::vector<RowHistory> history;
  take_history(response, u, history);
  return history;
}

/// Gap of slot 0 of a node that goes by `way` in one step after the other, and the last normal.
struct Path {
  std::vector<double> gaps;
  Vec3 normal{};
};
Path follow(const ContactGeometry& contact, const Scene& scene, Index node, const std::vector<Vec3>& places) {
  Path path;
  std::vector<RowHistory> history(contact.slots());
  std::vector<double> u = scene.zero();
  for (const Vec3& place : places) {
    const std::vector<double> next = with_displacement(scene.zero(), node, place);
    const auto rows = contact.rows_at(u, next, {history});
    const auto r = row_of(*rows, 0);
    path.gaps.push_back(r < 0 ? NAN : rows->gap_at(static_cast<std::size_t>(r), next));
    if (r >= 0) path.normal = rows->normal[static_cast<std::size_t>(r)];
    history = history_at(contact, next, history);
    u = next;
  }
  return path;
}

// A box of thickness 1: without memory a node deeper than 1/2 would be sent out at the other side.
TEST(SideMemory, KeepsANodeBehindTheFaceOfABoxThatItEntered) {
  Scene scene;
  const Index node = scene.add_node({0.0, 0.0, 1.5});
  ObstacleContact contact;
  contact.shape = Box{{-5, -5, 0}, {5, 5, 1}};
  contact.measure = RowMeasure::per_node;
  contact.nodes = {node};
  scene.finish().contacts.emplace_back(contact);
  const ContactGeometry geometry(scene.model);
  const Path path =
      follow(geometry, scene, node, {{0, 0, -0.7}, {0, 0, -1.1}, {0, 0, -1.4}, {0, 0, -0.3}, {0, 0, -2.0}});
  const std::vector<double> expected{-0.2, -0.6, -0.9, 0.2,
                                     0.5};  // in front again, then a jump through the box: it is free
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(path.gaps[i], expected[i], round_off) << i;
}

/// A point above a plate of unit facets, which begins to touch it and goes on downwards by half a facet at a time.
TEST(SideMemory, KeepsANodeHoweverDeepItGoes) {
  Scene scene;
  const std::vector<Facet> master = scene.add_patch(4, 4, [](double s, double t) { return Vec3{4 * s, 4 * t, 0}; });
  const std::vector<Facet> slave = scene.add_patch(1, 1, [](double s, double t) {
    return Vec3{1.2 + t, 1.3 + s, 0.1};
  });
  PairContact contact;
  contact.slave.facets = slave;
  contact.master.facets = master;
  contact.method = PairMethod::node_to_surface;
  scene.finish().contacts.emplace_back(contact);
  const ContactGeometry geometry(scene.model);
  const Index node = slave[0][0];
  std::vector<Vec3> places;
  for (int i = 1; i <= 6; ++i) places.push_back({0.05 * i, 0.03 * i, -0.5 * i});
  places.push_back({0, 0, 0.2});
  const Path path = follow(geometry, scene, node, places);
  for (int i = 1; i <= 6; ++i) EXPECT_NEAR(path.gaps[static_cast<std::size_t>(i - 1)], 0.1 - 0.5 * i, round_off) << i;
  EXPECT_NEAR(path.gaps.back(), 0.3, round_off);  // in front again, and free
  EXPECT_NEAR(path.normal[2], 1.0, round_off);
}

/// A triangle at the corner `at` that looks along n, a unit vector normal to y; its other corners lie against y and
/// on the side that n x y points away from.
std::array<Vec3, 3> facing(const Vec3& at, const Vec3& n) {
  const Vec3 y{0, 1, 0};
  return {at, subtract(at, y), subtract(at, cross(n, y))};
}

/// Slot 0: the first corner of a triangle before a box. Goes step by step, with the history of the last one.
class CornerAtABox {
 public:
  CornerAtABox(const Vec3& size, const std::array<Vec3, 3>& triangle) {
    Facet facet{{-1, -1, -1, -1}, 3};
    for (std::size_t a = 0; a < 3; ++a) facet.node[a] = scene_.add_node(triangle[a]);
    PairContact contact;
    contact.slave.facets = {facet};
    contact.master.facets = scene_.add_box({0, 0, 0}, size, 2);
    contact.method = PairMethod::node_to_surface;
    contact.law.eps_N = 1.0;
    scene_.finish().contacts.emplace_back(contact);
    geometry_.emplace(scene_.model);
    u_ = scene_.zero();
    history_.resize(geometry_->slots());
  }
  /// Gap there; not a number where there is no row.
  double gap_at(const std::array<Vec3, 3>& triangle) {
    std::vector<double> next = scene_.zero();
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t c = 0; c < 3; ++c) next[3 * a + c] = triangle[a][c] - scene_.mesh.coordinates[a][c];
    const auto rows = geometry_->rows_at(u_, next, {history_});
    const auto r = row_of(*rows, 0);
    ContactResponse response;
    response.rows = rows;
    response.history.resize(geometry_->slots());
    take_history(response, next, history_);
    u_ = next;
    return r < 0 ? NAN : rows->gap_at(static_cast<std::size_t>(r), next);
  }

 private:
  Scene scene_;
  std::optional<ContactGeometry> geometry_;
  std::vector<double> u_;
  std::vector<RowHistory> history_;
};

/// Looks at the face x = 1 of a box from the side, and by `down` on its top.
Vec3 sideways(double down) {
  return {-std::sqrt(1.0 - down * down), 0.0, -down};
}

// A corner 0.01 under the top of a box and 0.05 behind its side, whose normal turns away from the top: it has come
// through the top and stays behind it, and does not jump to the side as soon as the normals are no longer opposed.
TEST(SideMemory, KeepsANodeBehindItsFacetAsTheNormalsTurn) {
  const Vec3 at{0.95, 0.4, 0.99};
  CornerAtABox corner({1, 1, 1}, facing(at, sideways(0.3)));
  for (double down = 0.3; down > -0.4; down -= 0.05)
    EXPECT_NEAR(corner.gap_at(facing(at, sideways(down))), -0.01, round_off) << down;
}

// A corner just above the top and 0.05 behind the side: as soon as the top does not count any more it would be behind
// the side, or behind the top moved out by a fiftieth of a facet, 0.01.
TEST(SideMemory, LeavesANodeInFrontOfAFacetThatNoLongerCounts) {
  const Vec3 at{0.95, 0.4, 1.0001};
  CornerAtABox corner({1, 1, 1}, facing(at, sideways(0.11)));
  for (double down = 0.11; down > 0.085; down -= 0.002)
    EXPECT_FALSE(corner.gap_at(facing(at, sideways(down))) < 0.0) << down;
}

// A corner comes through the top of a slab near its end and leaves over the end, on which it does not look. Beyond it
// the corner is still behind the plane of the slab's side, whose facets are longer and therefore continued farther; but
// it is outside of the slab.
TEST(SideMemory, LosesANodeThatLeavesOverTheEnd) {
  const Vec3 n{0.0, -std::sqrt(0.5), -std::sqrt(0.5)};
  const auto there = [&](double x) {
    const Vec3 at{x, 0.17, 0.99};
    return std::array<Vec3, 3>{at, add(at, {0.5, 0, 0}), add(at, scaled(cross({1, 0, 0}, n), -0.5))};
  };
  CornerAtABox corner({1, 0.2, 1}, there(0.97));
  EXPECT_NEAR(corner.gap_at(there(0.97)), -0.01, round_off);
  EXPECT_NEAR(corner.gap_at(there(0.99)), -0.01, round_off);
  for (const double x : {1.01, 1.025, 1.03, 1.04}) EXPECT_FALSE(corner.gap_at(there(x)) < -0.01) << x;
}

/// Two cubes of n^3 cells and edge 1, the second one above the first, lowered by `overlap`.
struct Cubes {
  Model model;
  std::vector<double> u;
  std::vector<bool> is_upper;

  explicit Cubes(int n) {
    StructuredBlock lower, upper;
    lower.size = upper.size = {1, 1, 1};
    lower.divisions = upper.divisions = {n, n, n};
    upper.origin = {0.05, 0.07, 1.0};
    lower.cells_group = "LOWER";
    upper.cells_group = "UPPER";
    const auto mesh = std::make_shared<const Mesh>(make_structured_blocks({lower, upper}));
    for (const char* name : {"LOWER", "UPPER"}) {
      Part part;
      part.name = name;
      for (const CellRef& cell : mesh->cell_groups.at(name)) part.cells.push_back(cell.cell);
      part.material = LinearElastic{};
      model.parts.push_back(part);
    }
    is_upper.assign(mesh->node_count(), false);
    for (const Index node : mesh->nodes_of("UPPER")) is_upper[static_cast<std::size_t>(node)] = true;
    model.mesh = mesh;
    u.assign(3 * mesh->node_count(), 0.0);
  }
  std::vector<double> lowered(double by) const {
    std::vector<double> lowered = u;
    for (std::size_t i = 0; i < is_upper.size(); ++i)
      if (is_upper[i]) lowered[3 * i + 2] -= by;
    return lowered;
  }
};

/// Blocks of one cell each, every one a part, and the contact of all with all.
Model blocks_that_touch(const std::vector<StructuredBlock>& blocks) {
  Model model;
  const auto mesh = std::make_shared<const Mesh>(make_structured_blocks(blocks));
  for (const StructuredBlock& block : blocks) {
    Part part;
    part.name = block.cells_group;
    for (const CellRef& cell : mesh->cell_groups.at(block.cells_group)) part.cells.push_back(cell.cell);
    part.material = LinearElastic{};
    model.parts.push_back(part);
  }
  model.mesh = mesh;
  PairContact all;
  all.self = true;
  all.slave.facets = all.master.facets = skin(*mesh);
  all.law.eps_N = 1.0;
  model.contacts.emplace_back(all);
  return model;
}

// A corner of a block is 0.03 deep in a second one, and 0.02 in front of a third: it is in the second.
TEST(SideMemory, SeesTheBodyThatANodeIsInBeforeOneThatIsNearer) {
  StructuredBlock lower, upper, beside;
  lower.size = {1, 1, 1};
  upper.size = {0.4, 0.4, 0.4};
  upper.origin = {0.3, 0.3, 0.97};
  beside.size = {0.5, 0.8, 0.5};
  beside.origin = {0.72, 0.1, 0.9};
  lower.cells_group = "LOWER";
  upper.cells_group = "UPPER";
  beside.cells_group = "BESIDE";
  const Model model = blocks_that_touch({lower, upper, beside});
  const ContactGeometry contact(model);
  const std::vector<double> rest(3 * model.mesh->node_count(), 0.0);
  const auto rows = contact.rows_at(rest, rest);
  const std::vector<Index> corners = model.mesh->nodes_of("UPPER");
  int found = 0;
  for (std::size_t r = 0; r < rows->size(); ++r) {
    const Index n = rows->node[static_cast<std::size_t>(rows->begin[r])];
    const Vec3& x = model.mesh->coordinates[static_cast<std::size_t>(n)];
    const bool is_of_nodes = rows->slot[r] < static_cast<Index>(model.mesh->node_count());
    if (!is_of_nodes || !std::ranges::count(corners, n) || x[0] < 0.69 || x[2] > 1.0) continue;
    EXPECT_NEAR(rows->gap_at(r, rest), -0.03, round_off);
    ++found;
  }
  EXPECT_EQ(found, 2);
}

TEST(BodyOverlap, IsTheDepthUnderTheSkinInCells) {
  const Cubes cubes(4);
  BodyOverlap overlap(cubes.model, cubes.u);
  EXPECT_EQ(overlap.deepest(cubes.u).depth, 0.0);
  // A tenth of a cell deep, then more than a cell: of cells without skin faces one counts.
  EXPECT_NEAR(overlap.deepest(cubes.lowered(0.025)).depth, 0.1, round_off);
  EXPECT_GE(overlap.deepest(cubes.lowered(0.3)).depth, 1.0 - round_off);
  const Overlap deep = overlap.deepest(cubes.lowered(0.025));
  const std::span<const Index> nodes =
      cubes.model.mesh->blocks[static_cast<std::size_t>(deep.cell.block)].nodes(deep.cell.cell);
  EXPECT_EQ(std::ranges::count(nodes, deep.node), 0);
  EXPECT_EQ(overlap.deepest(cubes.lowered(-0.3)).depth, 0.0);
}

TEST(BodyOverlap, LeavesOutWhatTheBodiesStartWith) {
  const Cubes cubes(4);
  BodyOverlap overlap(cubes.model, cubes.lowered(0.025));
  EXPECT_NEAR(overlap.deepest(cubes.lowered(0.025)).depth, 0.0, round_off);
  EXPECT_NEAR(overlap.deepest(cubes.lowered(0.1)).depth, 0.3, round_off);
}

TEST(BodyOverlap, CountsObstacles) {
  Cubes cubes(2);
  ObstacleContact contact;
  contact.shape = Plane{{0, 0, 0}, {0, 0, 1}};
  contact.measure = RowMeasure::per_node;
  contact.nodes = cubes.model.mesh->nodes_of("LOWER");
  cubes.model.contacts.emplace_back(contact);
  BodyOverlap overlap(cubes.model, cubes.u);
  std::vector<double> u = cubes.u;
  for (std::size_t i = 2; i < u.size(); i += 3) u[i] = -0.2;  // both cubes; cells of 1/2
  EXPECT_NEAR(overlap.deepest(u).depth, 0.4, round_off);
  EXPECT_EQ(overlap.deepest(u).contact, 0);
}

}  // namespace
}  // namespace carom::contact_memory_test
