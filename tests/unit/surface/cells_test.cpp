// Contact between bodies of every type of cell: where a point is in them, overlap, chosen stiffness, gaps and measures.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>

#include "cell_meshes.hpp"
#include "contact/row_maker.hpp"
#include "contact/stiffness.hpp"
#include "contact_rows_fixture.hpp"
#include "mesh/cell_size.hpp"
#include "mesh/structured_block.hpp"
#include "model/bodies.hpp"
#include "surface/body_overlap.hpp"
#include "surface/buried_facets.hpp"
#include "surface/cell_location.hpp"
#include "surface/facet_geometry.hpp"
#include "surface/facing_facets.hpp"
#include "surface/half_thickness.hpp"

namespace carom::contact_cells_test {
namespace {

using namespace test;

constexpr double round_off = 1e-12;  // some hundred operations on numbers of order 1
constexpr std::array<CellType, 4> linear_solids{CellType::tetra4, CellType::pyra5, CellType::penta6, CellType::hexa8};

/// The mesh with a part of each type of solid that it has.
Model model_of(Mesh mesh) {
  Model model;
  for (const CellBlock& block : mesh.blocks) {
    if (dimension(block.type) != 3) continue;
    Part part{.name = std::string(name(block.type)),
              .cells = {},
              .material = LinearElastic{{2.0, 0.3, 1.0}},
              .type = block.type};
    part.cells.resize(block.size());
    std::iota(part.cells.begin(), part.cells.end(), 0);
    model.parts.push_back(part);
  }
  model.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return model;
}

StructuredBlock unit_box(const Vec3& origin, int n) {
  StructuredBlock block;
  block.origin = origin;
  block.size = {1, 1, 1};
  block.divisions = {n, n, n};
  return block;
}

TEST(ShapeAt, FindsTheValuesOfRandomPointsOfDistortedCells) {
  Random random(5);
  for (const CellType type : linear_solids) {
    const Mesh mesh = with_cells(make_structured_blocks({unit_box({}, 1)}), type);
    const auto n = static_cast<std::size_t>(node_count(type));
    for (int trial = 0; trial < 200; ++trial) {
      Corners corners{};
      for (std::size_t a = 0; a < n; ++a)
        corners[a] =
            add(mesh.coordinates[static_cast<std::size_t>(mesh.block(type)->connectivity[a])], random.vector(0.05));
      CornerValues weight{};  // any positive weights give a point inside of a convex cell
      double sum = 0.0;
      for (std::size_t a = 0; a < n; ++a) sum += weight[a] = random(0.1, 1.0);
      Vec3 x{};
      for (std::size_t a = 0; a < n; ++a) x = add(x, scaled(corners[a], weight[a] / sum));
      const auto N = shape_at(type, corners, x);
      ASSERT_TRUE(N) << name(type);
      Vec3 found{};
      double total = 0.0;
      for (std::size_t a = 0; a < n; ++a) {
        EXPECT_GT((*N)[a], 0.0) << name(type);
        total += (*N)[a];
        found = add(found, scaled(corners[a], (*N)[a]));
      }
      EXPECT_NEAR(total, 1.0, round_off) << name(type);
      EXPECT_LT(norm(subtract(found, x)), 1e-9) << name(type);  // Newton's last step
    }
  }
}

// Every point of a body is in one of its cells and in no other, and no point beside it is in any.
/// Cells whose bounds, enlarged by a 255th of the unit box that their cluster does not leave, have x.
std::size_t is_bounded_by(const PlacedCells& cells, const Vec3& x) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    Bounds bounds;
    const Corners corners = cells.corners(k);
    for (std::size_t a = 0; a < static_cast<std::size_t>(corner_count(cells.type(k))); ++a) bounds.include(corners[a]);
    bounds.grow(1.0 / 255.0);
    count += bounds.contains(x) ? 1 : 0;
  }
  return count;
}

TEST(PlacedCells, PartitionTheBody) {
  Random random(6);
  std::vector<Mesh> meshes;
  const Mesh grid = make_structured_blocks({unit_box({}, 3)});
  for (const CellType type : solid_types) meshes.push_back(with_cells(grid, type));
  meshes.push_back(with_mixed_cells(grid));
  for (const Mesh& mesh : meshes) {
    const Model model = model_of(mesh);
    const PlacedCells cells(model, {}, CellsOf::all);
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 x{random(-0.5, 1.5), random(-0.1, 1.1), random(-0.1, 1.1)};
      int count = 0;
      std::vector<Index> near;
      cells.find(x, near);
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (!cells.inside(k, x)) continue;
        ++count;
        EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<Index>(k)));
      }
      EXPECT_LE(near.size(), is_bounded_by(cells, x)) << "no more than whose bounds have it";
      const bool is_in = std::all_of(x.begin(), x.end(), [](double c) { return c > 0.0 && c < 1.0; });
      EXPECT_EQ(count, is_in ? 1 : 0) << name(cells.type(0)) << " (" << x[0] << ", " << x[1] << ", " << x[2] << ")";
    }
  }
}

TEST(PlacedCells, OfPlaneTypesPartitionTheStrip) {
  Random random(7);
  StructuredBlock strip = unit_box({}, 3);
  strip.kind = StructuredBlock::Kind::quad;
  for (const CellType type : plane_types) {
    const Mesh mesh = with_cells(make_structured_blocks({strip}), type);
    Model model;
    Part part{.name = "p", .cells = {}, .material = LinearElastic{}, .type = type, .section = Section::plane_strain};
    part.cells.resize(mesh.block(type)->size());
    std::iota(part.cells.begin(), part.cells.end(), 0);
    model.parts.push_back(part);
    model.mesh = std::make_shared<const Mesh>(mesh);
    const PlacedCells cells(model, {}, CellsOf::all);
    for (int trial = 0; trial < 100; ++trial) {
      const Vec3 x{random(-0.5, 1.5), random(-0.1, 1.1), 0.0};
      int count = 0;
      for (std::size_t k = 0; k < cells.size(); ++k) count += cells.inside(k, x) ? 1 : 0;
      EXPECT_EQ(count, x[0] > 0.0 && x[0] < 1.0 && x[1] > 0.0 && x[1] < 1.0 ? 1 : 0) << name(type);
    }
  }
}

// Cells of a cube of edge h: tetrahedra have altitudes h and h / sqrt(2), the pentahedron is half of the cube, its
// triangles have altitudes h / sqrt(2), the pyramid has its apex at the centre; by hand.
TEST(CellLength, OfPiecesOfACube) {
  const double h = 0.5;
  const std::map<CellType, double> expected{{CellType::tetra4, h / std::sqrt(2.0)},
                                            {CellType::penta6, h / std::sqrt(2.0)},
                                            {CellType::pyra5, h / 2.0},
                                            {CellType::hexa8, h},
                                            {CellType::hexa20, h / 2.0},
                                            {CellType::tetra10, h / std::sqrt(8.0)}};
  for (const auto& [type, length] : expected) {
    const Mesh mesh = with_cells(make_structured_blocks({unit_box({}, 2)}), type);
    const CellBlock& block = *mesh.block(type);
    std::vector<Vec3> x;
    for (int a = 0; a < corner_count(type); ++a)
      x.push_back(mesh.coordinates[static_cast<std::size_t>(block.connectivity[static_cast<std::size_t>(a)])]);
    EXPECT_NEAR(cell_length(type, x), length, round_off) << name(type);
  }
  const std::vector<Vec3> triangle{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};  // altitude on the longest edge: 3 x 4 / 5
  EXPECT_NEAR(cell_length(CellType::tria3, triangle), 2.4, round_off);
}

/// Two cubes of edge 1 in cells of two types, the second one above the first with a gap.
struct TwoBodies {
  Model model;
  std::vector<double> u;
  Surface upper, lower;  ///< BOTTOM of the upper cube, TOP of the lower one
  std::vector<bool> is_upper;

  TwoBodies(CellType upper_type, CellType lower_type, int n_upper, int n_lower, double gap, const Vec3& shift = {}) {
    CellFiller both;
    const auto append = [&](const Mesh& mesh) {
      const auto first = static_cast<Index>(both.mesh.coordinates.size());
      both.mesh.coordinates.insert(both.mesh.coordinates.end(), mesh.coordinates.begin(), mesh.coordinates.end());
      for (const CellBlock& from : mesh.blocks) {
        if (dimension(from.type) != 3) continue;
        auto& blocks = both.mesh.blocks;
        auto block = std::find_if(blocks.begin(), blocks.end(), [&](const auto& b) { return b.type == from.type; });
        if (block == blocks.end()) block = blocks.insert(block, {from.type, {}, {}});
        for (const Index n : from.connectivity) block->connectivity.push_back(first + n);
        for (std::size_t k = 0; k < from.size(); ++k)
          block->file_numbers.push_back(static_cast<std::int64_t>(block->file_numbers.size()) + 1);
      }
      return static_cast<std::size_t>(first);
    };
    append(with_cells(make_structured_blocks({unit_box({}, n_lower)}), lower_type));
    const std::size_t first =
        append(with_cells(make_structured_blocks({unit_box(add(shift, {0, 0, 1.0 + gap}), n_upper)}), upper_type));
    Mesh& mesh = both.mesh;
    for (std::size_t n = 0; n < mesh.coordinates.size(); ++n) {
      is_upper.push_back(n >= first);
      mesh.node_numbers.push_back(static_cast<std::int64_t>(n) + 1);
    }
    for (const Facet& facet : skin(mesh)) {
      const bool of_upper = is_upper[static_cast<std::size_t>(facet[0])];
      const double height = of_upper ? 1.0 + gap : 1.0;
      if (std::all_of(facet.begin(), facet.end(), [&](Index n) {
            return std::abs(mesh.coordinates[static_cast<std::size_t>(n)][2] - height) < 1e-9;
          }))
        (of_upper ? upper : lower).facets.push_back(facet);
    }
    model = model_of(mesh);
    u.assign(3 * mesh.coordinates.size(), 0.0);
  }
  PairContact pair(PairMethod method) const {
    PairContact contact;
    contact.name = "pair";
    contact.method = method;
    contact.slave = upper;
    contact.master = lower;
    contact.law.eps_N = 1.0;
    return contact;
  }
  std::vector<double> lowered(double by) const {
    std::vector<double> moved = u;
    for (std::size_t n = 0; n < is_upper.size(); ++n)
      if (is_upper[n]) moved[3 * n + 2] -= by;
    return moved;
  }
};

const std::array<std::pair<CellType, CellType>, 8> kPairs{{{CellType::tetra4, CellType::tetra4},
                                                           {CellType::tetra4, CellType::hexa8},
                                                           {CellType::hexa8, CellType::tetra4},
                                                           {CellType::tetra10, CellType::penta6},
                                                           {CellType::pyra5, CellType::tetra10},
                                                           {CellType::hexa20, CellType::hexa27},
                                                           {CellType::hexa27, CellType::hexa20},
                                                           {CellType::penta6, CellType::pyra5}}};

// Flat faces, whatever they are meshed with: gaps to rounding, areas that add up, forces without a resultant or moment.
TEST(PairsOfAnyCells, HaveTheGapsAndMeasuresOfFlatFaces) {
  Random random(8);
  for (const auto& [above, below] : kPairs) {
    for (const PairMethod method : {PairMethod::node_to_surface, PairMethod::surface_to_surface}) {
      TwoBodies bodies(above, below, 2, 3, 0.01);
      bodies.model.contacts.emplace_back(bodies.pair(method));
      const auto rows = ContactGeometry(bodies.model).rows_at(bodies.u, bodies.u);
      double area = 0.0;
      ASSERT_GT(rows->size(), 8U);
      for (std::size_t r = 0; r < rows->size(); ++r) {
        EXPECT_NEAR(rows->gap[r], 0.01, round_off) << name(above) << " on " << name(below);
        EXPECT_NEAR(rows->normal[r][2], 1.0, round_off);
        EXPECT_GT(rows->measure[r], 0.0);
        area += rows->measure[r];
      }
      EXPECT_NEAR(area, 1.0, round_off) << name(above) << " on " << name(below);
      Scene scene;
      scene.mesh = *bodies.model.mesh;
      for (std::size_t r = 0; r < rows->size(); ++r) {
        const Resultant sum = resultant(scene, *rows, r, random.vector(1.0), bodies.u);
        EXPECT_LT(norm(sum.force), round_off);
        EXPECT_LT(norm(sum.moment), round_off);
      }
    }
  }
}

TEST(BodyOverlap, IsTheDepthUnderTheSkinOfAnyCells) {
  for (const auto& [above, below] : kPairs) {
    const TwoBodies bodies(above, below, 4, 3, 0.0, {0.031, 0.017, 0.0});
    BodyOverlap overlap(bodies.model, bodies.u);
    EXPECT_EQ(overlap.deepest(bodies.u).depth, 0.0) << name(above) << " on " << name(below);
    EXPECT_EQ(overlap.deepest(bodies.lowered(-0.3)).depth, 0.0);
    const double depth = overlap.deepest(bodies.lowered(0.02)).depth;
    // 0.02 over the height of a cell is at least 0.06; over the least length of one (a pyramid's is an eighth) at most
    // 0.02 / 0.088.
    EXPECT_GT(depth, 0.059) << name(above) << " on " << name(below);
    EXPECT_LT(depth, 0.24) << name(above) << " on " << name(below);
  }
  const TwoBodies same(CellType::tetra4, CellType::tetra4, 2, 2, 0.0, {0.01, 0.02, 0.0});
  // Depth over the cell_length of the tetrahedra, their least height: 0.5 / sqrt(2).
  EXPECT_NEAR(BodyOverlap(same.model, same.u).deepest(same.lowered(0.05)).depth, 0.1 * std::numbers::sqrt2, round_off);
}

// A wall of one cell is cut into tetrahedra, some of which have an edge alone on its upper side and a face on another
// one: a node that is 0.02 below the upper side is 0.02 deep in all of them. Their cell_length is 0.35 at least, and 1
// at most.
TEST(BodyOverlap, IsTheWayToTheNearestFaceAndNotToThatOfTheCell) {
  for (const CellType type : {CellType::tetra4, CellType::tetra10, CellType::pyra5, CellType::penta6}) {
    for (int i = 0; i <= 8; ++i) {
      for (int k = 0; k <= 8; ++k) {
        const TwoBodies bodies(type, type, 1, 1, 0.0, {0.31 + 0.05 * i, 0.32 + 0.05 * k, 0.0});
        const double depth = BodyOverlap(bodies.model, bodies.u).deepest(bodies.lowered(0.02)).depth;
        EXPECT_GT(depth, 0.0199) << name(type) << i << k;
        EXPECT_LT(depth, 0.0572) << name(type) << i << k;
      }
    }
  }
}

TEST(BuriedFacets, OfAnyCellsAreThoseInside) {
  for (const auto& [above, below] : kPairs) {
    const TwoBodies bodies(above, below, 4, 3, 0.0, {0.031, 0.017, 0.0});
    const PairContact pair = bodies.pair(PairMethod::node_to_surface);
    EXPECT_TRUE(buried_facets(bodies.model, pair, bodies.u).empty()) << name(above) << " on " << name(below);
    const std::size_t all = bodies.upper.facets.size() + bodies.lower.facets.size();
    // Half a unit deep every facet of each is inside of the other, but for those that overhang.
    const std::size_t found = buried_facets(bodies.model, pair, bodies.lowered(0.5)).size();
    EXPECT_GT(found, all / 2) << name(above) << " on " << name(below);
    EXPECT_TRUE(buried_facets(bodies.model, pair, bodies.lowered(-0.5)).empty());
  }
}

/// Gaps of the rows of the first slots at u, by slot; zero where there is none or it is open.
std::vector<double> depths(const ContactGeometry& contact, std::size_t slots, std::span<const double> u) {
  const auto rows = contact.rows_at(u, u);
  std::vector<double> depth(slots);
  for (std::size_t r = 0; r < rows->size() && rows->slot[r] < static_cast<Index>(slots); ++r)
    depth[static_cast<std::size_t>(rows->slot[r])] = std::max(0.0, -rows->gap_at(r, u));
  return depth;
}

// A cube comes sideways under the upper face of another, a fifth of a cell deep: no row begins deeper than what a step
// moves, wherever it begins, by whole skins and by faces alone.
TEST(NodeRows, BeginAtTheSurfaceWhenACubeComesFromTheSide) {
  constexpr double step = 1e-3;
  for (const bool is_all : {true, false}) {
    TwoBodies bodies(CellType::hexa8, CellType::hexa8, 2, 3, -0.07, {1.1, 0.23, 0.0});
    PairContact contact = bodies.pair(PairMethod::two_pass);
    if (is_all) {
      contact.self = true;
      contact.slave.facets = contact.master.facets = skin(*bodies.model.mesh);
    }
    bodies.model.contacts.emplace_back(contact);
    const ContactGeometry geometry(bodies.model);
    const std::size_t nodes = nodal_measures(bodies.model.mesh->coordinates, contact.slave).size() +
                              (is_all ? 0 : nodal_measures(bodies.model.mesh->coordinates, contact.master).size());
    std::vector<double> u = bodies.u, before = depths(geometry, nodes, u);
    for (int k = 0; k < 600; ++k) {
      for (std::size_t n = 0; n < bodies.is_upper.size(); ++n)
        if (bodies.is_upper[n]) u[3 * n] -= step;
      const std::vector<double> now = depths(geometry, nodes, u);
      for (std::size_t slot = 0; slot < now.size(); ++slot)
        // Faces alone: the slope of the fading gap, at most 1.54 depths over a width of a tenth of a facet of 0.33.
        EXPECT_LT(std::abs(now[slot] - before[slot]), (is_all ? 1.001 : 3.3) * step)
            << "step " << k << " slot " << slot;
      before = now;
    }
    EXPECT_GT(*std::ranges::max_element(before), 0.06) << "nothing has begun";
  }
}

/// The unit cube, n cells along its edges, with every node moved.
template <class Move>
Model moved_box(CellType type, int n, const Move& move) {
  Mesh mesh = with_cells(make_structured_blocks({unit_box({}, n)}), type);
  for (Vec3& x : mesh.coordinates) x = move(x);
  return model_of(std::move(mesh));
}

PairContact with_itself(const Model& model) {
  PairContact contact;
  contact.name = "all";
  contact.self = true;
  contact.slave.facets = contact.master.facets = skin(*model.mesh);
  return contact;
}

// Straight pieces of curved faces lie inside of neighbouring cells of the same body.
TEST(BuriedFacets, AreNoneOfACurvedBodyAlone) {
  for (const CellType type : {CellType::tetra10, CellType::hexa20}) {
    const Model ring = moved_box(type, 4, [](const Vec3& x) {
      const double angle = -1.5 * 3.14159 * x[0], radius = 1.0 + x[1];  // 67 degrees per cell
      return Vec3{radius * std::cos(angle), radius * std::sin(angle), x[2]};
    });
    const std::vector<double> u(3 * ring.mesh->node_count(), 0.0);
    EXPECT_TRUE(buried_facets(ring, with_itself(ring), u).empty()) << name(type);
  }
}

// The nodes of the tip of a punch are not deep inside of its flanks, and half of the tip is how deep these may be met.
TEST(HalfThickness, OfATaperedBodyIsThatOfItsTip) {
  constexpr double tip = 0.05;
  for (const int n : {1, 2, 4}) {
    Model punch = moved_box(CellType::hexa8, n, [](const Vec3& x) {
      const double width = tip + (1.0 - tip) * x[2];
      return Vec3{width * (x[0] - 0.5), width * (x[1] - 0.5), 2.0 * x[2]};
    });
    const PairContact contact = with_itself(punch);
    const std::vector<double> half =
        half_thickness(punch.mesh->coordinates, contact.slave.facets, bodies_of_nodes(punch), 1.0);
    EXPECT_LE(*std::ranges::min_element(half), n == 2 ? 0.5 * tip * 1.01 : 0.5) << n;
    punch.contacts.emplace_back(contact);
    const std::vector<double> u(3 * punch.mesh->node_count(), 0.0);
    for (const Penetration& p : ContactGeometry(punch).initial_penetrations(u))
      ADD_FAILURE() << n << " cells along: " << p.depth << " at " << p.position[0] << " " << p.position[2];
  }
}

// A hollow body has two skins, of which the inner one is behind the outer one.
TEST(HalfThickness, IsKnownThroughAHollow) {
  Mesh mesh = make_structured_blocks({unit_box({}, 5)});
  Model shell = model_of(std::move(mesh));
  std::erase_if(shell.parts[0].cells, [](Index c) { return c == 62; });  // the middle one of 125
  Mesh hollow = *shell.mesh;
  CellBlock& block = hollow.blocks[static_cast<std::size_t>(hollow.block(CellType::hexa8) - hollow.blocks.data())];
  block.connectivity.erase(block.connectivity.begin() + 62 * 8, block.connectivity.begin() + 63 * 8);
  block.file_numbers.pop_back();
  shell = model_of(std::move(hollow));
  const std::vector<Facet> facets = skin(*shell.mesh);
  const std::vector<double> half = half_thickness(shell.mesh->coordinates, facets, bodies_of_nodes(shell), 1.0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const PlacedFacet placed = place(facets[f], shell.mesh->coordinates);
    const ParentPoint centre = facet_centre(placed.size);
    if (norm(subtract(facet_position(placed, centre.xi, centre.eta), {0.5, 0.5, 0.0})) > round_off) continue;
    EXPECT_NEAR(half[f], 0.2, round_off) << "two cells of 0.2 between the middle of a face and the hollow";
  }
}

// Of whole skins, the facets that look at each other are those of the two faces between the bodies.
TEST(FacingFacets, OfAnyCellsAreTheFacesBetweenTheBodies) {
  for (const auto& [above, below] : kPairs) {
    const TwoBodies bodies(above, below, 2, 3, 0.3);
    PairContact pair = bodies.pair(PairMethod::node_to_surface);
    for (Surface* side : {&pair.slave, &pair.master}) side->facets.clear();
    for (const Facet& facet : skin(*bodies.model.mesh))
      (bodies.is_upper[static_cast<std::size_t>(facet[0])] ? pair.slave : pair.master).facets.push_back(facet);
    const FacingFacets facing = facing_facets(bodies.model, pair);
    EXPECT_EQ(facing.slave, bodies.upper.facets) << name(above) << " on " << name(below);
    EXPECT_EQ(facing.master, bodies.lower.facets) << name(above) << " on " << name(below);
  }
}

// A body that begins elsewhere, by one displacement of all its nodes or by one of each: under the other, its upper face
// looks at the other's lower one.
TEST(FacingFacets, AreThoseOfThePlacesWhereBodiesBegin) {
  const TwoBodies bodies(CellType::hexa8, CellType::hexa8, 2, 3, 0.3);
  PairContact pair = bodies.pair(PairMethod::node_to_surface);
  for (Surface* side : {&pair.slave, &pair.master}) side->facets.clear();
  InitialState initial;
  for (std::size_t n = 0; n < bodies.is_upper.size(); ++n)
    if (bodies.is_upper[n]) initial.nodes.push_back(static_cast<Index>(n));
  for (const Facet& facet : skin(*bodies.model.mesh))
    (bodies.is_upper[static_cast<std::size_t>(facet[0])] ? pair.slave : pair.master).facets.push_back(facet);
  for (const std::size_t given : {std::size_t{1}, initial.nodes.size()}) {
    initial.displacement.assign(given, {0.0, 0.0, -5.0});
    Model model = bodies.model;
    model.initial = {initial};
    const FacingFacets facing = facing_facets(model, pair);
    EXPECT_EQ(facing.slave.size(), bodies.upper.facets.size());
    EXPECT_NE(facing.slave, bodies.upper.facets);
  }
}

// M / h with h the height of the cells behind the face, 0.5 in a grid of 2 cells: pyramids end at the centres of the
// grid's cells, quadratic cells have nodes in the middle.
TEST(Stiffness, OfAnyCellsIsTheModulusOverTheirHeight) {
  const std::map<CellType, double> height{{CellType::tetra4, 0.5}, {CellType::penta6, 0.5},   {CellType::pyra5, 0.25},
                                          {CellType::hexa8, 0.5},  {CellType::tetra10, 0.25}, {CellType::hexa20, 0.25},
                                          {CellType::hexa27, 0.25}};
  for (const auto& [type, h] : height) {
    TwoBodies bodies(type, type, 2, 2, 0.1);
    PairContact pair = bodies.pair(PairMethod::node_to_surface);
    pair.law.eps_N.reset();
    bodies.model.contacts.emplace_back(pair);
    ASSERT_EQ(choose_stiffness(bodies.model).size(), 1U);
    const double modulus = 2.0 * 0.7 / (1.3 * 0.4);  // E (1 - nu) / ((1 + nu) (1 - 2 nu))
    EXPECT_NEAR(*std::get<PairContact>(bodies.model.contacts[0]).law.eps_N * h / modulus, 1.0, round_off) << name(type);
  }
}

}  // namespace
}  // namespace carom::contact_cells_test
