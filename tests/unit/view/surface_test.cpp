#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "cell_meshes.hpp"
#include "math/vec3.hpp"
#include "mesh/structured_block.hpp"
#include "view/seen_surface.hpp"

namespace carom::view_surface_test {
namespace {

Mesh block(int nx, int ny, int nz, const Vec3& size) {
  StructuredBlock b;
  b.size = size;
  b.divisions = {nx, ny, nz};
  b.face_groups = {};
  return make_structured_blocks({b});
}

std::vector<Vec3> points_of(const SeenSurface& surface, const Mesh& mesh) {
  std::vector<Vec3> at;
  for (const Index n : surface.nodes) at.push_back(mesh.coordinates[static_cast<std::size_t>(n)]);
  return at;
}

Vec3 area_vector(const SeenTriangle& t, const std::vector<Vec3>& at) {
  const auto p = [&](std::size_t a) { return at[static_cast<std::size_t>(t.node[a])]; };
  return scaled(cross(subtract(p(1), p(0)), subtract(p(2), p(0))), 0.5);
}

double area(const SeenSurface& surface, const std::vector<Vec3>& at) {
  double sum = 0.0;
  for (const SeenTriangle& t : surface.triangles) sum += norm(area_vector(t, at));
  return sum;
}

/// Integral of x . n / 3 over the surface: the volume inside, if it is closed and its normals point outward (Gauss).
double volume(const SeenSurface& surface, const std::vector<Vec3>& at) {
  double sum = 0.0;
  for (const SeenTriangle& t : surface.triangles)
    sum += dot(area_vector(t, at), at[static_cast<std::size_t>(t.node[0])]) / 3.0;
  return sum;
}

TEST(SeenSurface, OfABlockIsItsSkin) {
  const Mesh mesh = block(4, 3, 2, {2.0, 1.5, 1.0});
  const SeenSurface surface = seen_surface(mesh);
  const std::vector<Vec3> at = points_of(surface, mesh);
  EXPECT_EQ(surface.triangles.size(), 2U * 2U * (4 * 3 + 4 * 2 + 3 * 2));  // two a face
  EXPECT_EQ(surface.nodes.size(), 5U * 4U * 3U - 3U * 2U * 1U);            // all but the inner ones
  EXPECT_EQ(surface.cells.size(), 24U);                                    // none is inside
  EXPECT_NEAR(area(surface, at), 2.0 * (2.0 * 1.5 + 2.0 + 1.5), 1e-12);
  EXPECT_NEAR(volume(surface, at), 3.0, 1e-12);
  std::map<std::pair<Index, Index>, int> edges;
  for (const SeenTriangle& t : surface.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      if ((t.edges >> e & 1U) == 0) continue;
      const Index a = t.node[e], b = t.node[(e + 1) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  }
  EXPECT_EQ(edges.size(), 2U * 2U * (4 * 3 + 4 * 2 + 3 * 2));  // of a closed surface of quadrilaterals: E = 2 F
  for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
}

TEST(SeenSurface, QuadraticFacesAreTheirPieces) {
  const Mesh mesh = test::with_cells(block(1, 1, 1, {1.0, 1.0, 1.0}), CellType::hexa20);
  const SeenSurface surface = seen_surface(mesh);
  EXPECT_EQ(surface.nodes.size(), 20U);
  EXPECT_NEAR(volume(surface, points_of(surface, mesh)), 1.0, 1e-12);
  // A side of the cube is two pieces long; sides between pieces of a face are no edges.
  std::set<std::pair<Index, Index>> edges;
  for (const SeenTriangle& t : surface.triangles)
    for (std::size_t e = 0; e < 3; ++e)
      if ((t.edges >> e & 1U) != 0) edges.insert(std::minmax({t.node[e], t.node[(e + 1) % 3]}));
  EXPECT_EQ(edges.size(), 24U);
}

/// The cells that are there in a frame. Cells have their position among all of them as number.
Mesh left_of(const Mesh& mesh, const std::vector<Index>& gone, Index frame) {
  Mesh left;
  left.coordinates = mesh.coordinates;
  left.node_numbers = mesh.node_numbers;
  for (const CellBlock& block : mesh.blocks) {
    CellBlock kept{block.type, {}, {}};
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (gone[static_cast<std::size_t>(block.file_numbers[k])] <= frame) continue;
      const std::span<const Index> nodes = block.nodes(static_cast<Index>(k));
      kept.connectivity.insert(kept.connectivity.end(), nodes.begin(), nodes.end());
      kept.file_numbers.push_back(block.file_numbers[k]);
    }
    if (kept.size() > 0) left.blocks.push_back(std::move(kept));
  }
  return left;
}

/// What is seen in a frame, by nodes and cells of the mesh, with the bits of the edges.
std::multiset<std::array<Index, 5>> seen_in(const SeenSurface& surface, Index frame) {
  std::multiset<std::array<Index, 5>> seen;
  const auto node = [&](const SeenTriangle& t, std::size_t a) { return surface.nodes[at(t.node[a])]; };
  for (const SeenTriangle& t : surface.triangles)
    if (t.from <= frame && frame < t.until)
      seen.insert({node(t, 0), node(t, 1), node(t, 2), surface.cells[at(t.cell)], t.edges});
  return seen;
}

// In every frame one sees the surface of the mesh of the cells that are there then.
TEST(SeenSurface, WhereCellsGoIsThatOfTheCellsThatAreThere) {
  constexpr Index frames = 4;
  std::mt19937 random(11);
  for (const CellType type : test::solid_types) {
    Mesh mesh = test::with_cells(block(3, 3, 2, {1.0, 1.0, 1.0}), type);
    std::erase_if(mesh.blocks, [](const CellBlock& b) { return dimension(b.type) < 3; });
    Index count = 0;
    for (CellBlock& b : mesh.blocks)
      for (std::int64_t& number : b.file_numbers) number = count++;
    std::vector<Index> gone;  // a third of the cells stays
    for (Index k = 0; k < count; ++k) gone.push_back(random() % 3 == 0 ? never : static_cast<Index>(random() % frames));
    const SeenSurface surface = seen_surface(mesh, gone);
    EXPECT_TRUE(surface.changes());
    for (Index frame = 0; frame < frames; ++frame)
      EXPECT_EQ(seen_in(surface, frame), seen_in(seen_surface(left_of(mesh, gone, frame)), 0)) << name(type) << frame;
    const SurfaceEnds ends = ends_of(surface);
    for (std::size_t k = 0; k < surface.cells.size(); ++k) EXPECT_EQ(ends.of_cells[k], gone[at(surface.cells[k])]);
  }
}

TEST(SeenSurface, WhereNoCellGoesIsTheSameAsEver) {
  const Mesh mesh = block(3, 2, 2, {1.0, 1.0, 1.0});
  const SeenSurface plain = seen_surface(mesh);
  const SeenSurface kept = seen_surface(mesh, std::vector<Index>(mesh.block(CellType::hexa8)->size() + 1, never));
  EXPECT_FALSE(plain.changes());
  EXPECT_FALSE(kept.changes());
  EXPECT_EQ(seen_in(kept, 0), seen_in(plain, 0));
}

// The half x < 0.5 goes, cell by cell in any order. Before, the surface is that of the cube, after it that of the other
// half, with the plane x = 0.5 in its place: no node of it has been moved to one that has gone.
TEST(SeenSurface, CoarsenedOneKeepsToNodesThatAreThere) {
  constexpr std::size_t most = 5000;
  Mesh mesh = block(40, 40, 40, {1.0, 1.0, 1.0});
  CellBlock& cells = mesh.blocks[0];
  ASSERT_EQ(cells.type, CellType::hexa8);
  std::mt19937 random(7);
  std::vector<Index> gone;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const bool goes = mesh.coordinates[at(cells.nodes(static_cast<Index>(k))[0])][0] < 0.5 - 1e-9;
    gone.push_back(goes ? 1 + static_cast<Index>(random() % 3) : never);
    cells.file_numbers[k] = static_cast<std::int64_t>(k);
  }
  const SeenSurface fine = seen_surface(mesh, gone);
  const std::vector<Vec3> at = points_of(fine, mesh);
  const SeenSurface coarse = coarsened(fine, at, std::vector<Index>(at.size(), 0), most);
  const std::vector<Vec3> left = points_of(coarse, mesh);
  double before = 0.0, after = 0.0, least = 1.0;
  for (const SeenTriangle& t : coarse.triangles) {
    const double share = dot(area_vector(t, left), left[static_cast<std::size_t>(t.node[0])]) / 3.0;
    if (t.from == 0) before += share;
    if (t.until < never) continue;
    after += share;
    for (const Index n : t.node) least = std::min(least, left[static_cast<std::size_t>(n)][0]);
  }
  EXPECT_LE(coarse.nodes.size(), most);
  EXPECT_EQ(least, 0.5);
  EXPECT_NEAR(before, 1.0, 0.1);  // as below: less what the clusters on the edges move
  EXPECT_NEAR(after, 0.5, 0.05);
}

TEST(SeenSurface, CoarsenedOneKeepsItsShapeWithinItsGrid) {
  constexpr std::size_t most = 400;
  const Mesh mesh = block(40, 20, 20, {2.0, 1.0, 1.0});
  const SeenSurface fine = seen_surface(mesh);
  const std::vector<Vec3> at = points_of(fine, mesh);
  const std::vector<Index> part(at.size(), 0);
  const SeenSurface coarse = coarsened(fine, at, part, most);
  const std::vector<Vec3> left = points_of(coarse, mesh);
  EXPECT_LE(coarse.nodes.size(), most);
  EXPECT_GT(coarse.nodes.size(), most / 4);
  // The corners are bent most and stay; the skin is flat elsewhere, so area and volume stay but for what the clusters
  // on the edges move, at most a cube of the grid (here about a seventh of a side).
  for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 1}, Vec3{0, 1, 1}})
    EXPECT_NE(std::find(left.begin(), left.end(), corner), left.end());
  EXPECT_NEAR(area(coarse, left), 10.0, 1.0);
  EXPECT_NEAR(volume(coarse, left), 2.0, 0.2);
  for (const SeenTriangle& t : coarse.triangles) {
    EXPECT_TRUE(t.node[0] != t.node[1] && t.node[1] != t.node[2] && t.node[2] != t.node[0]);
    EXPECT_LT(static_cast<std::size_t>(t.cell), coarse.cells.size());
  }
}

TEST(SeenSurface, PartsThatTouchAreNotMerged) {
  StructuredBlock low, high;
  low.size = high.size = {1.0, 1.0, 1.0};
  low.divisions = high.divisions = {10, 10, 10};
  low.face_groups = high.face_groups = {};
  high.origin = {0.0, 0.0, 1.0};
  const Mesh mesh = make_structured_blocks({low, high});
  const SeenSurface fine = seen_surface(mesh);
  const std::vector<Vec3> at = points_of(fine, mesh);
  std::vector<Index> part;
  for (const Index n : fine.nodes) part.push_back(n < 11 * 11 * 11 ? 0 : 1);
  const SeenSurface coarse = coarsened(fine, at, part, 100);
  for (const SeenTriangle& t : coarse.triangles) {
    std::set<bool> sides;
    for (const Index n : t.node) sides.insert(coarse.nodes[static_cast<std::size_t>(n)] < 11 * 11 * 11);
    EXPECT_EQ(sides.size(), 1U);
  }
}

}  // namespace
}  // namespace carom::view_surface_test
