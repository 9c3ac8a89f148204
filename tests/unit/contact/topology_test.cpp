// Surfaces of bodies some cells of which have gone.
#include "model/topology.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "contact/contact_geometry.hpp"
#include "math/vec3.hpp"
#include "mesh/skin.hpp"
#include "mesh/structured_block.hpp"
#include "model/outer_facets.hpp"

namespace carom::contact_topology_test {
namespace {

/// A block of 3 x 3 x 3 unit cells, all of which may go, on an obstacle, and against a surface that is another one.
struct Block {
  Model model;
  std::vector<CellRef> cells;

  Block() {
    StructuredBlock block;
    block.size = {3.0, 3.0, 3.0};
    block.divisions = {3, 3, 3};
    auto mesh = std::make_shared<const Mesh>(make_structured_blocks({block}));
    model.mesh = mesh;
    Part part{.name = "body", .cells = std::vector<Index>(27), .material = {}};
    std::iota(part.cells.begin(), part.cells.end(), 0);
    model.parts.push_back(part);
    for (Index k = 0; k < 27; ++k) cells.push_back({0, k});
    model.erosion.push_back({"body", part.cells, std::nullopt, std::nullopt, 1.0});
    ObstacleContact floor;
    floor.name = "floor";
    for (const Facet& facet : skin(*mesh))
      if (is_at(facet, 0.0)) floor.surface.facets.push_back(facet);
    PairContact pair;
    pair.name = "pair";
    pair.slave.facets = skin(*mesh);
    pair.self = true;
    pair.master = pair.slave;
    model.contacts = {floor, pair};
  }
  bool is_at(const Facet& facet, double z) const {
    return std::all_of(facet.begin(), facet.end(),
                       [&](Index n) { return model.mesh->coordinates[static_cast<std::size_t>(n)][2] == z; });
  }
  static Index cell(int i, int j, int k) { return static_cast<Index>(i + 3 * (j + 3 * k)); }
  std::shared_ptr<const Topology> without(const std::vector<Index>& gone) const {
    std::vector<std::uint8_t> alive(27, 1);
    for (const Index k : gone) alive[static_cast<std::size_t>(k)] = 0;
    return Topologies(model, cells).of(std::move(alive));
  }
};

const Surface& own(const Topology& topology, std::size_t contact) {
  return *parts_of(topology.model.contacts[contact]).own;
}

/// Sum over the facets of their areas along each axis: zero of a closed surface.
Vec3 vector_area(const Topology& topology, const std::vector<Facet>& facets) {
  Vec3 sum{};
  for (const Facet& facet : facets) {
    const auto x = [&](std::size_t a) { return topology.model.mesh->coordinates[static_cast<std::size_t>(facet[a])]; };
    sum = add(sum, scaled(cross(subtract(x(2), x(0)), subtract(x(3), x(1))), 0.5));
  }
  return sum;
}

TEST(Topologies, AHoleAtASurfaceIsOfTheSurface) {
  const Block block;
  const auto topology = block.without({Block::cell(1, 1, 0)});
  EXPECT_EQ(own(*topology, 0).facets.size(), 9U - 1U + 5U);
  EXPECT_EQ(own(*topology, 1).facets.size(), 54U - 1U + 5U);
  EXPECT_EQ(parts_of(topology->model.contacts[1]).other->facets, own(*topology, 1).facets);
  EXPECT_EQ(topology->model.outer_facets->size(), 54U - 1U + 5U);
  EXPECT_EQ(topology->model.parts[0].cells.size(), 26U);
  EXPECT_EQ(vector_area(*topology, own(*topology, 1).facets), Vec3{});
  // The bottom, 3 x 3, seen from outside: what the hole has added closes it.
  EXPECT_EQ(vector_area(*topology, own(*topology, 0).facets), (Vec3{0.0, 0.0, -9.0}));
  EXPECT_TRUE(std::get<ObstacleContact>(topology->model.contacts[0]).loose.facets.empty());
}

TEST(Topologies, AHoleWithinIsOfNoSurfaceUntilItOpens) {
  const Block block;
  const auto closed = block.without({Block::cell(1, 1, 1)});
  EXPECT_EQ(own(*closed, 1).facets.size(), 54U);
  EXPECT_EQ(closed->model.outer_facets->size(), 54U + 6U);
  const auto open = block.without({Block::cell(1, 1, 1), Block::cell(1, 1, 2)});
  EXPECT_EQ(own(*open, 1).facets.size(), 54U - 1U + 4U + 5U);
  EXPECT_EQ(own(*open, 0).facets.size(), 9U);  // which the hole does not reach
}

// All cells of a corner but for its column's lowest: the nodes of the edge above it are held by nothing.
TEST(Topologies, NodesThatAllCellsHaveLeftArePoints) {
  const Block block;
  const auto topology = block.without({Block::cell(0, 0, 2), Block::cell(0, 0, 1)});
  const Surface& loose = std::get<PairContact>(topology->model.contacts[1]).loose_slave;
  ASSERT_EQ(loose.facets.size(), 2U);
  for (const Facet& point : loose.facets) {
    EXPECT_EQ(point.size, 1);
    const Vec3& x = topology->model.mesh->coordinates[static_cast<std::size_t>(point[0])];
    EXPECT_EQ(x[0], 0.0);
    EXPECT_EQ(x[1], 0.0);
    EXPECT_GE(x[2], 2.0);
  }
  EXPECT_EQ(loose.thickness, 1.0);  // a facet of 1 x 1 each
}

TEST(Topologies, AreAFunctionOfWhatIsThere) {
  const Block block;
  const auto one = block.without({Block::cell(0, 1, 2)}), same = block.without({Block::cell(0, 1, 2)});
  EXPECT_TRUE(*one == *same);
  EXPECT_EQ(own(*one, 1).facets, own(*same, 1).facets);
  const auto none = block.without({});
  EXPECT_EQ(own(*none, 1).facets, skin(*block.model.mesh));
}

/// Contacts of the block of every kind whose histories may have to find their slots again.
std::vector<ContactDefinition> every_contact(const Block& block) {
  std::vector<ContactDefinition> all;
  Surface bottom, top;
  for (const Facet& facet : skin(*block.model.mesh)) {
    if (block.is_at(facet, 0.0)) bottom.facets.push_back(facet);
    if (block.is_at(facet, 3.0)) top.facets.push_back(facet);
  }
  const RigidShape shapes[] = {Plane{}, Sphere{{1.5, 1.5, -5.0}, 5.0}, Cylinder{{1.5, 1.5, -5.0}, {0.0, 1.0, 0.0}, 5.0},
                               Box{{-1.0, -1.0, -1.0}, {4.0, 4.0, 0.0}}};
  for (const RigidShape& shape : shapes)
    for (const RowMeasure measure : {RowMeasure::per_area, RowMeasure::per_node}) {
      ObstacleContact contact;
      contact.name = "obstacle";
      contact.shape = shape;
      contact.measure = measure;
      contact.law.eps_N = 1.0;
      if (measure == RowMeasure::per_area)
        contact.surface = bottom;
      else
        contact.nodes = {0, 1, 2, 5};
      all.emplace_back(contact);
    }
  for (const PairMethod method : {PairMethod::node_to_surface, PairMethod::two_pass, PairMethod::surface_to_surface})
    for (const RowHold hold : {RowHold::springs, RowHold::impulses, RowHold::increments, RowHold::multipliers})
      for (const bool self : {false, true}) {
        PairContact contact;
        contact.name = "pair";
        contact.self = self;
        contact.method = method;
        contact.slave.facets = self ? skin(*block.model.mesh) : bottom.facets;
        contact.master.facets = self ? contact.slave.facets : top.facets;
        contact.law.eps_N = 1.0;
        contact.law.hold = hold;
        all.emplace_back(contact);
      }
  StopContact stop;
  stop.name = "stop";
  stop.nodes = {0, 3, 7};
  stop.direction = {0.0, 0.0, 1.0};
  stop.stiffness = 1.0;
  all.emplace_back(stop);
  return all;
}

// Where nothing has gone, each slot is found again: no two have the same key, and none is without.
TEST(Topologies, EveryKindOfContactFindsItsSlotsAgain) {
  Block block;
  for (const ContactDefinition& contact : every_contact(block)) {
    block.model.contacts = {contact};
    const ContactGeometry geometry(block.model);
    const std::vector<double> u(3 * block.model.mesh->node_count(), 0.0);
    std::vector<RowHistory> history(geometry.slots());
    ASSERT_FALSE(history.empty());
    for (std::size_t k = 0; k < history.size(); ++k) history[k].slip = {static_cast<double>(k + 1), 0.0, 0.0};
    const auto rows = geometry.rows_at(u, u, {history, nullptr});
    EXPECT_EQ(geometry.carried_history({history, nullptr}, *rows, u, block.without({})), history)
        << name_of(contact) << ", contact of index " << contact.index();
  }
}

}  // namespace
}  // namespace carom::contact_topology_test
