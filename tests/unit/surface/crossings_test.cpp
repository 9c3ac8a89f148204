// Surfaces that cross: depths by construction, what is a neighbour, what was there at the start, when a look is due.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <numeric>
#include <vector>

#include "cell_meshes.hpp"
#include "contact_rows_fixture.hpp"
#include "mesh/structured_block.hpp"
#include "parallel/threads.hpp"
#include "surface/skin_motion.hpp"
#include "surface/surface_crossings.hpp"

namespace carom::contact_crossings_test {
namespace {

using namespace test;

constexpr double round_off = 1e-12;  // some hundred operations on numbers of order 10
using Map = std::function<Vec3(const Vec3&)>;

StructuredBlock box(const Vec3& origin, const Vec3& size, const std::array<int, 3>& divisions) {
  StructuredBlock block;
  block.origin = origin;
  block.size = size;
  block.divisions = divisions;
  return block;
}

StructuredBlock strip(const Vec3& origin, const Vec3& size, const std::array<int, 3>& divisions) {
  StructuredBlock block = box(origin, size, divisions);
  block.kind = StructuredBlock::Kind::quad;
  return block;
}

/// Blocks of one mesh, each a body; where they are is a matter of displacement.
struct Bodies {
  Model model;
  std::vector<std::size_t> body;  ///< by node: which block

  explicit Bodies(const std::vector<StructuredBlock>& blocks, CellType type = CellType::hexa8) {
    const Mesh grid = make_structured_blocks(blocks);
    const auto mesh = std::make_shared<const Mesh>(type == CellType::hexa8 ? grid : with_cells(grid, type));
    for (const CellBlock& cells : mesh->blocks) {
      const bool is_plane = blocks[0].kind == StructuredBlock::Kind::quad;
      if (dimension(cells.type) == 1 ? blocks.back().kind != StructuredBlock::Kind::bar
                                     : dimension(cells.type) != (is_plane ? 2 : 3))
        continue;
      Part part{.name = std::string(name(cells.type)), .cells = {}, .material = LinearElastic{}, .type = cells.type};
      part.cells.resize(cells.size());
      std::iota(part.cells.begin(), part.cells.end(), 0);
      model.parts.push_back(part);
    }
    for (const Vec3& X : mesh->coordinates) {
      std::size_t own = 0;
      while (!is_in(blocks[own], X)) ++own;
      body.push_back(own);
    }
    model.mesh = mesh;
  }
  static bool is_in(const StructuredBlock& block, const Vec3& X) {
    Bounds bounds;
    bounds.include(block.origin);
    bounds.include(block.kind == StructuredBlock::Kind::bar ? block.end : add(block.origin, block.size));
    bounds.grow(1e-9);
    if (block.kind == StructuredBlock::Kind::quad) bounds.low[2] = -1.0, bounds.high[2] = 1.0;
    return bounds.contains(X);
  }
  /// Displacement that brings each node of block b to maps[b](X).
  std::vector<double> at(const std::vector<Map>& maps) const {
    std::vector<double> u;
    for (std::size_t n = 0; n < body.size(); ++n) {
      const Vec3& X = model.mesh->coordinates[n];
      const Vec3 moved = subtract(maps[body[n]](X), X);
      u.insert(u.end(), moved.begin(), moved.end());
    }
    return u;
  }
};

Vec3 stay(const Vec3& X) {
  return X;
}
Map shift(const Vec3& by) {
  return [by](const Vec3& X) { return add(X, by); };
}
/// Turned about an axis through the origin, then shifted.
Map turn(std::size_t axis, double degrees, const Vec3& by = {}) {
  return [=](const Vec3& X) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    Vec3 x = X;
    x[i] = c * X[i] - s * X[j];
    x[j] = s * X[i] + c * X[j];
    return add(x, by);
  };
}
Map then(const Map& first, const Map& second) {
  return [=](const Vec3& X) { return second(first(X)); };
}

double depth(SurfaceCrossings& surfaces, const std::vector<double>& u) {
  return surfaces.deepest(u, Folds::left_out).depth;
}

/// Two bars of section 10 x 10 with cells 12 long, one along x below z = 0, one along y that stands 100 above it; no
/// node of one is over the other, for which the second one lies 1 beside the middle.
std::vector<StructuredBlock> crossed_bars() {
  return {box({-30, -5, -10}, {60, 10, 10}, {5, 2, 2}), box({-4, -29, 100}, {10, 60, 10}, {2, 5, 2})};
}

// Flat on flat: what the bars overlap, over the smaller height of the cells, 5.
TEST(SurfaceCrossings, OfCrossedBarsAreAsDeepAsTheirFaces) {
  for (const CellType type :
       {CellType::hexa8, CellType::tetra4, CellType::penta6, CellType::hexa20, CellType::tetra10}) {
    const Bodies bars(crossed_bars(), type);
    SurfaceCrossings surfaces(bars.model, bars.at({stay, stay}));
    const double length = surfaces.skin().pieces[0].length;
    EXPECT_EQ(depth(surfaces, bars.at({stay, shift({0, 0, -99.99})})), 0.0) << name(type);
    for (const double d : {1e-3, 0.1, 0.5, 2.0}) {
      EXPECT_NEAR(depth(surfaces, bars.at({stay, shift({0, 0, -100.0 - d})})), d / length, round_off)
          << name(type) << " " << d;
    }
  }
  EXPECT_EQ(SkinPieces(Bodies(crossed_bars()).model).pieces[0].length, 5.0);
}

// Bars rolled by 45 degrees, ridge on ridge, at any angle between the ridges: the distance of the two lines.
TEST(SurfaceCrossings, OfEdgesAreAsDeepAsTheirDistance) {
  const Bodies bars({box({-30, -5, -5}, {60, 10, 10}, {5, 2, 2}), box({-31, -5, 95}, {60, 10, 10}, {5, 2, 2})});
  const double ridge = 5.0 * std::numbers::sqrt2;
  for (const double angle : {90.0, 60.0, 25.0}) {
    const auto at = [&](double d) {
      const Map upper = then(then(shift({0, 0, -100}), turn(0, 45)), turn(2, angle, {0.3, 0.4, 2.0 * ridge - d}));
      return bars.at({turn(0, 45), upper});
    };
    SurfaceCrossings surfaces(bars.model, at(-20.0));
    EXPECT_EQ(depth(surfaces, at(-0.01)), 0.0);
    for (const double d : {1e-3, 0.1, 1.0})
      EXPECT_NEAR(depth(surfaces, at(d)), d / 5.0, round_off) << angle << " " << d;
  }
}

/// The trilinear map of the unit box at `origin` to these corners, x fastest.
Map to_corners(const Vec3& origin, const std::array<Vec3, 8>& corners) {
  return [=](const Vec3& X) {
    const Vec3 at = subtract(X, origin);
    Vec3 x{};
    for (std::size_t c = 0; c < 8; ++c) {
      double share = 1.0;
      for (std::size_t i = 0; i < 3; ++i) share *= (c >> i) & 1U ? at[i] : 1.0 - at[i];
      x = add(x, scaled(corners[c], share));
    }
    return x;
  };
}

// Two cells of a random impact. An edge of the second has come in beside an edge of the first, through a side that is
// warped, 0.066 deep; its end is out again by the next side, by 0.001. Along that side's normal its other end is far.
TEST(SurfaceCrossings, OfAnEdgeThatGoesInAndOutAreAsDeepAsTheLesserWay) {
  const Vec3 away{100, 0, 0};
  const Bodies bodies({box({}, {1, 1, 1}, {1, 1, 1}), box(away, {1, 1, 1}, {1, 1, 1})});
  SurfaceCrossings surfaces(bodies.model, bodies.at({stay, stay}));
  const Vec3 a{-4.64223, -18.9759, 5.96219}, b{15.4414, -30.2632, -6.21566}, c{-3.52087, -25.8695, 12.8129},
      d{16.0238, -29.5357, 7.98438}, e{-8.39229, -43.8229, -9.41629}, f{8.39608, -44.6249, -17.865};
  const Map first = to_corners({}, {a, b, c, d, e, f, add(e, subtract(c, a)), add(f, subtract(d, b))});
  const Vec3 end{12.9946, -28.9579, -4.78456}, x = scaled({-0.632142, 0.578142, -0.515895}, 8.0),
                                               y = scaled({0.604404, 0.784349, 0.139614}, 8.0),
                                               z = subtract({9.25813, -27.2369, 1.7225}, end);
  const auto corner = [&](int i, int j, int k) { return add(add(end, scaled(x, i)), add(scaled(y, j), scaled(z, k))); };
  const Map second = to_corners(away, {corner(0, 0, 0), corner(1, 0, 0), corner(0, 1, 0), corner(1, 1, 0),
                                       corner(0, 0, 1), corner(1, 0, 1), corner(0, 1, 1), corner(1, 1, 1)});
  const double found = depth(surfaces, bodies.at({first, second}));
  EXPECT_GT(found, 0.0);
  EXPECT_LT(found, 0.1);
}

// Bodies of the same section, one cell wide: no node of one is inside of the other, all are on its sides.
TEST(SurfaceCrossings, OfAlignedBlocksAreSeen) {
  const Bodies blocks({box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), box({0, 0, 100}, {1, 1, 1}, {1, 1, 1})});
  SurfaceCrossings surfaces(blocks.model, blocks.at({stay, stay}));
  for (const double d : {0.0, 0.01, 0.3})
    EXPECT_NEAR(depth(surfaces, blocks.at({stay, shift({0, 0, -99.0 - d})})), d, round_off) << d;
}

// Side by side, corner at corner and edge at edge, with common planes: they touch.
TEST(SurfaceCrossings, OfTouchingBlocksAreNone) {
  const Bodies blocks({box({0, 0, 0}, {2, 2, 2}, {2, 2, 2}), box({0, 0, 100}, {2, 2, 2}, {2, 2, 2})});
  SurfaceCrossings surfaces(blocks.model, blocks.at({stay, stay}));
  for (const double x : {0.0, 1.0, 0.3, 2.0})
    for (const double y : {0.0, 1.0, 0.7, 2.0})
      for (const double z : {0.0, 1.0, 0.4, 2.0})
        if (std::max({x, y, z}) == 2.0) {
          EXPECT_NEAR(depth(surfaces, blocks.at({stay, shift({x, y, z - 100})})), 0.0, round_off)
              << x << " " << y << " " << z;
        }
}

// A pin in its hole, with 16 and 12 facets of the same radius: no deeper than the facets' own error, the sagitta of the
// coarser ones. The hole is a block bent to a ring, whose ends touch.
TEST(SurfaceCrossings, OfCurvedFacesThatFitAreNoDeeperThanTheirFacets) {
  const Bodies bodies({box({0, 0, 0}, {1, 0.4, 1}, {12, 2, 3}), box({0, 10, -0.2}, {1, 1, 1.4}, {4, 4, 3})});
  const Map ring = [](const Vec3& X) {
    const double angle = -2.0 * std::numbers::pi * X[0], r = 1.0 + X[1];
    return Vec3{r * std::cos(angle), r * std::sin(angle), X[2]};
  };
  const Map pin = [](const Vec3& X) {  // squares to circles
    const double x = 2.0 * X[0] - 1.0, y = 2.0 * (X[1] - 10.0) - 1.0, m = std::max(std::abs(x), std::abs(y));
    const double angle =
        m == 0.0 ? 0.0
                 : (std::abs(y) <= std::abs(x) ? (x > 0 ? y / x : 4.0 + y / x) : (y > 0 ? 2.0 - x / y : 6.0 - x / y)) *
                       std::numbers::pi / 4;
    return Vec3{m * std::cos(angle), m * std::sin(angle), X[2]};
  };
  SurfaceCrossings surfaces(bodies.model, bodies.at({then(ring, shift({50, 0, 0})), pin}));
  double least = 1.0;
  for (const SkinPieces::Piece& piece : surfaces.skin().pieces) least = std::min(least, piece.length);
  const double sagitta = 1.0 - std::cos(std::numbers::pi / 12);
  for (const double degrees : {0.0, 3.0, 11.0, 20.0})
    for (const double up : {0.0, 0.05, 0.3})
      EXPECT_LT(depth(surfaces, bodies.at({ring, then(pin, turn(2, degrees, {0, 0, up}))})), sagitta / least + 1e-9)
          << degrees << " " << up;
}

TEST(SurfaceCrossings, AtTheStartCountByGrowthOnly) {
  const Bodies bars(crossed_bars());
  const auto lowered = [&](double d) { return bars.at({stay, shift({0, 0, -100.0 - d})}); };
  SurfaceCrossings surfaces(bars.model, lowered(0.5));
  EXPECT_EQ(depth(surfaces, lowered(0.4)), 0.0);
  EXPECT_EQ(depth(surfaces, lowered(0.5)), 0.0);
  EXPECT_NEAR(depth(surfaces, lowered(2.0)), 1.5 / 5.0, round_off);
}

// A bar bent to a ring goes through itself with its ends; where it is only bent, and at random displacements of a tenth
// of a cell, neighbours do not count.
TEST(SurfaceCrossings, OfFoldsCountButNotOfNeighbours) {
  const Bodies bodies({box({0, 0, 0}, {12, 1, 1}, {12, 1, 1})});
  const auto bent = [&](double overlap) {
    return bodies.at({[overlap](const Vec3& X) {
      const double radius = (12.0 - overlap) / (2.0 * std::numbers::pi), angle = X[0] / radius;
      return Vec3{(radius + X[1]) * std::sin(angle), (radius + X[1]) * std::cos(angle), X[2] * (1.0 + 0.01 * X[0])};
    }});
  };
  std::vector<double> u = bodies.at({stay});
  SurfaceCrossings surfaces(bodies.model, u);
  Random random(3);
  for (double& value : u) value += random(-0.1, 0.1);
  EXPECT_EQ(surfaces.deepest(u, Folds::seen).depth, 0.0);
  EXPECT_EQ(surfaces.deepest(bent(-0.2), Folds::seen).depth, 0.0);
  EXPECT_GT(surfaces.deepest(bent(0.3), Folds::seen).depth, 0.2);
  EXPECT_EQ(surfaces.deepest(bent(0.3), Folds::left_out).depth, 0.0);
}

// In the plane: a corner in an edge, and edges of the same width, whose corners are on each other's sides.
TEST(SurfaceCrossings, InThePlaneAreAsDeepAsTheOverlap) {
  for (const CellType type : {CellType::quad4, CellType::tria3, CellType::quad8}) {
    const Bodies bodies({strip({0, 0, 0}, {2, 1, 0}, {2, 1, 1}), strip({0, 100, 0}, {2, 2, 0}, {2, 2, 1})}, type);
    SurfaceCrossings surfaces(bodies.model, bodies.at({stay, stay}));
    const double length = surfaces.skin().pieces[0].length, d = 0.1;
    const Map on_corner = then(shift({0, -100, 0}), turn(2, 45, {0.9, 1.0 - d, 0}));
    EXPECT_NEAR(depth(surfaces, bodies.at({stay, on_corner})), d / length, round_off) << name(type);
    EXPECT_NEAR(depth(surfaces, bodies.at({stay, shift({0.0, -99.0 - d, 0})})), d / length, round_off) << name(type);
    EXPECT_NEAR(depth(surfaces, bodies.at({stay, shift({0.7, -99.0 - d, 0})})), d / length, round_off) << name(type);
    EXPECT_NEAR(depth(surfaces, bodies.at({stay, shift({0.7, -99.0, 0})})), 0.0, round_off) << name(type);
  }
}

// A cable through a block: how far it is inside.
TEST(SurfaceCrossings, OfBarsAreAsDeepAsTheyAreInside) {
  StructuredBlock cable;
  cable.kind = StructuredBlock::Kind::bar;
  cable.origin = {-7, 0.5, 0.5};
  cable.end = {10, 0.5, 0.5};
  cable.divisions = {2, 1, 1};
  Bodies bodies({box({0, 0, 0}, {1, 1, 1}, {1, 1, 1}), cable});
  const auto lowered = [&](double d) { return bodies.at({stay, shift({0, 0, 0.5 - d})}); };
  SurfaceCrossings surfaces(bodies.model, lowered(-1.0));
  EXPECT_EQ(depth(surfaces, lowered(-0.1)), 0.0);
  for (const double d : {0.05, 0.3}) EXPECT_NEAR(depth(surfaces, lowered(d)), d, round_off);
}

TEST(SurfaceCrossings, AreTheSameBitsForAnyNumberOfThreads) {
  const Bodies bodies({box({-3, -3, -1}, {6, 6, 1}, {11, 11, 2}), box({-2, -2, 100}, {4, 4, 4}, {9, 9, 9})});
  const std::vector<double> start = bodies.at({stay, stay}),
                            u = bodies.at(
                                {stay, then(then(shift({0, 0, -100}), turn(1, 7)), turn(0, 5, {0, 0, -0.2}))});
  std::vector<SurfaceCrossing> found;
  for (const int threads : {1, 2, 4}) {
    const ThreadScope scope(threads);
    SurfaceCrossings surfaces(bodies.model, start);
    found.push_back(surfaces.deepest(u, Folds::seen));
  }
  EXPECT_GT(found[0].depth, 0.1);
  for (const SurfaceCrossing& other : found) {
    EXPECT_EQ(other.depth, found[0].depth);
    EXPECT_EQ(other.position, found[0].position);
    EXPECT_EQ(other.cell, found[0].cell);
  }
}

// Two cubes of cells 0.5: together they may go anywhere, a quarter of a cell against each other, more while they are
// apart, and a look begins anew.
TEST(SkinMotion, AsksForALookWhenBodiesThatMeetHaveMoved) {
  const Bodies bodies({box({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), box({0, 0, 1.01}, {1, 1, 1}, {2, 2, 2})});
  const SkinPieces skin(bodies.model);
  const auto due = [&](const Vec3& first, const Vec3& second, int steps) {
    SkinMotion motion(skin);
    motion.looked(bodies.at({stay, stay}), true);
    LookDue last = LookDue::none;
    for (int i = 1; i <= steps && last == LookDue::none; ++i) {
      const double part = double(i) / steps;
      last = motion.due(bodies.model.mesh->coordinates,
                        bodies.at({shift(scaled(first, part)), shift(scaled(second, part))}), 0);
    }
    return last;
  };
  EXPECT_EQ(due({7, 0, -9}, {7, 0, -9}, 100), LookDue::none);
  EXPECT_EQ(due({0, 0, 0}, {0.12, 0, -0.02}, 100), LookDue::none);
  EXPECT_EQ(due({0, 0, 0}, {0.13, 0, -0.02}, 100), LookDue::bodies);
  EXPECT_EQ(due({0, 0, 0}, {0.13, 0, -0.02}, 1), LookDue::bodies);
  EXPECT_EQ(due({0, 0, 0}, {0, 0, 50}, 1000), LookDue::none);
}

}  // namespace
}  // namespace carom::contact_crossings_test
