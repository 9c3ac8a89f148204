// Broad phase: candidate pairs against brute force, re-use of the list, swept boxes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>

#include "math/vec3.hpp"
#include "parallel/threads.hpp"
#include "surface/box_tree.hpp"
#include "surface/broad_phase.hpp"

namespace carom::contact_search_test {
namespace {

using Pairs = std::set<std::pair<Index, Index>>;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }

 private:
  std::mt19937 generator_;
};

/// Facets with nodes of their own, of sizes from 1e-3 to 1.
struct Cloud {
  std::vector<Vec3> x;
  std::vector<Facet> queries, targets;

  void add_facet(std::vector<Facet>& facets, int size, double length, const Vec3& centre, Random& random) {
    Facet facet;
    facet.size = size;
    for (int a = 0; a < size; ++a) {
      facet.node[static_cast<std::size_t>(a)] = static_cast<Index>(x.size());
      x.push_back(add(centre, random.vector(length)));
    }
    facets.push_back(facet);
  }
};

Cloud random_cloud(int queries, int targets, double extent, Random& random) {
  Cloud cloud;
  const auto length = [&] { return std::pow(10.0, random(-3.0, 0.0)); };
  for (int i = 0; i < queries; ++i)
    cloud.add_facet(cloud.queries, random.integer(1, 4), length(), random.vector(extent), random);
  for (int i = 0; i < targets; ++i)
    cloud.add_facet(cloud.targets, random.integer(2, 4), length(), random.vector(extent), random);
  return cloud;
}

/// Largest distance of two facets' boxes along an axis, over the way of the step if there is one.
double box_gap(const Facet& a, const Facet& b, const std::vector<Vec3>& x, const std::vector<Vec3>& way) {
  double gap = -INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (const int side : {0, 1}) {
      for (const Index node : side == 0 ? a : b) {
        for (const double at : {x[node][i], x[node][i] + (way.empty() ? 0.0 : way[node][i])}) {
          low[side] = std::min(low[side], at);
          high[side] = std::max(high[side], at);
        }
      }
    }
    gap = std::max({gap, low[1] - high[0], low[0] - high[1]});
  }
  return gap;
}

Pairs brute_force(const Cloud& cloud, double within, const std::vector<Vec3>& way = {}) {
  Pairs pairs;
  for (std::size_t q = 0; q < cloud.queries.size(); ++q)
    for (std::size_t t = 0; t < cloud.targets.size(); ++t)
      if (box_gap(cloud.queries[q], cloud.targets[t], cloud.x, way) <= within) pairs.emplace(q, t);
  return pairs;
}

Pairs pairs_of(const BroadPhase& search) {
  Pairs pairs;
  for (std::size_t q = 0; q < search.queries().size(); ++q) {
    const auto targets = search.targets_of(q);
    EXPECT_TRUE(std::is_sorted(targets.begin(), targets.end()));
    for (const Index t : targets) pairs.emplace(q, t);
  }
  EXPECT_EQ(pairs.size(), search.pair_count());
  return pairs;
}

bool includes(const Pairs& all, const Pairs& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

std::vector<Bounds> random_boxes(int count, Random& random) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < count; ++i) {
    Bounds box;
    const Vec3 centre = random.vector(1.0);
    for (int k = 0; k < 2; ++k) box.include(add(centre, random.vector(std::pow(10.0, random(-3.0, 0.0)))));
    boxes.push_back(box);
  }
  return boxes;
}

void expect_brute_force(const BoxTree& tree, std::span<const Bounds> boxes, Random& random) {
  for (int trial = 0; trial < 100; ++trial) {
    Bounds box;
    box.include(random.vector(1.0));
    box.grow(0.1);
    std::vector<Index> found, expected;
    tree.find(box, found);
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (boxes[i].overlaps(box)) expected.push_back(static_cast<Index>(i));
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxTree, FindsWhatBruteForceFinds) {
  Random random(1);
  for (const int count : {0, 1, 4, 5, 300}) {
    const std::vector<Bounds> boxes = random_boxes(count, random);
    BoxTree tree;
    tree.build(boxes);
    expect_brute_force(tree, boxes, random);
  }
}

TEST(BoxTree, FindsBoxesThatMoved) {
  Random random(3);
  for (const int count : {0, 1, 4, 5, 300}) {
    BoxTree tree;
    tree.build(random_boxes(count, random));
    const std::vector<Bounds> moved = random_boxes(count, random);
    tree.refit(moved);
    expect_brute_force(tree, moved, random);
  }
}

TEST(BroadPhase, LosesNoPairOverManyMoves) {
  Random random(2);
  Cloud cloud = random_cloud(200, 200, 2.0, random);
  const double reach = 0.01, margin = 0.05;
  BroadPhase search(cloud.queries, cloud.targets, reach, margin);
  constexpr int moves = 150;
  std::size_t found = 0;
  for (int k = 0; k < moves; ++k) {
    const bool built = search.update(cloud.x);
    const Pairs pairs = pairs_of(search), needed = brute_force(cloud, reach);
    EXPECT_TRUE(includes(pairs, needed));
    // At a build the list is exactly that of the enlarged boxes; later boxes have come apart by margin at most.
    if (built) {
      EXPECT_EQ(pairs, brute_force(cloud, reach + margin));
    }
    EXPECT_TRUE(includes(brute_force(cloud, reach + 2 * margin), pairs));
    found += needed.size();
    for (Vec3& x : cloud.x) x = add(x, random.vector(0.004));
  }
  EXPECT_GT(found, 100U * moves);  // the test is about pairs that exist
  // margin / 2 is more than 6 of the longest moves: not more than one build in 6 updates, and some of them.
  EXPECT_LE(search.builds(), 1 + moves / 6);
  EXPECT_GE(search.builds(), 3);
}

TEST(BroadPhase, LosesNoPairOverTheWaysOfSteps) {
  Random random(3);
  Cloud cloud = random_cloud(150, 150, 2.0, random);
  const double reach = 0.01, margin = 0.2;
  BroadPhase search(cloud.queries, cloud.targets, reach, margin);
  std::vector<Vec3> way(cloud.x.size());
  constexpr int moves = 60;
  for (int k = 0; k < moves; ++k) {
    for (std::size_t n = 0; n < way.size(); ++n) way[n] = random.vector(0.03);
    const bool built = search.update(cloud.x, way);
    EXPECT_TRUE(includes(pairs_of(search), brute_force(cloud, reach, way)));
    if (built) {
      EXPECT_EQ(pairs_of(search), brute_force(cloud, reach + margin, way));
    }
    for (std::size_t n = 0; n < way.size(); ++n) cloud.x[n] = add(cloud.x[n], way[n]);
  }
  EXPECT_LT(search.builds(), moves / 2);
}

TEST(BroadPhase, BuildsAgainOnlyAfterHalfTheMargin) {
  std::vector<Vec3> x{{0, 0, 0}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {100, 100, 100}};
  BroadPhase search({{{0}, 1}}, {{{1, 2, 3}, 3}}, 0.0, 1.0);
  EXPECT_TRUE(search.update(x));
  EXPECT_FALSE(search.update(x));
  x[0][0] = 0.499;
  x[4][0] = 0.0;  // belongs to no facet
  EXPECT_FALSE(search.update(x));
  x[0][0] = 0.501;  // since the last build, not since the last update
  EXPECT_TRUE(search.update(x));
  x[3][1] = 1.6;
  EXPECT_TRUE(search.update(x));
  EXPECT_EQ(search.builds(), 3);
}

TEST(BroadPhase, CatchesAProjectileThatCrossesAPlateWithinOneStep) {
  const std::vector<Vec3> x{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.2, 0.3, 50}};
  std::vector<Vec3> way(5);
  way[4] = {0, 0, -100};
  BroadPhase still({{{4}, 1}}, {{{0, 1, 2, 3}, 4}}, 0.0, 0.1), swept = still;
  still.update(x);
  EXPECT_EQ(still.pair_count(), 0U);
  swept.update(x, way);
  EXPECT_EQ(swept.pair_count(), 1U);
  // The list without ways must not be kept when the next step has one.
  EXPECT_TRUE(still.update(x, way));
  EXPECT_EQ(still.pair_count(), 1U);
}

TEST(BroadPhase, BodiesAMillionCellsApartAndLargeAmongSmall) {
  Random random(4);
  Cloud cloud;
  const double cell = 1e-3;
  for (const double where : {0.0, 1e6 * cell}) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 centre = add({where, 0, 0}, random.vector(20 * cell));
      cloud.add_facet(cloud.queries, 3, cell, centre, random);
      cloud.add_facet(cloud.targets, 4, cell, centre, random);
    }
    cloud.add_facet(cloud.targets, 4, 1000 * cell, {where, 0, 0}, random);
  }
  BroadPhase search(cloud.queries, cloud.targets, cell, cell);
  search.update(cloud.x);
  EXPECT_EQ(pairs_of(search), brute_force(cloud, 2 * cell));
}

TEST(BroadPhase, NeighboursOfOneSurfaceAreNoPairs) {
  // Three segments in a row, then two more that lie a short way beside the first.
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 0.1, 0}, {1, 0.1, 0}};
  const std::vector<Facet> surface{{{0, 1}, 2}, {{1, 2}, 2}, {{2, 3}, 2}, {{4, 5}, 2}};
  BroadPhase search(surface, surface, 0.2, 0.0);
  search.update(x);
  EXPECT_EQ(pairs_of(search), (Pairs{{0, 3}, {1, 3}, {3, 0}, {3, 1}}));
}

TEST(BroadPhase, ListIsTheSameForEveryNumberOfThreads) {
  Random random(5);
  const Cloud cloud = random_cloud(3000, 3000, 3.0, random);
  std::vector<std::vector<Index>> lists;
  for (const int threads : {1, 2, 4}) {
    set_threads(threads);
    BroadPhase search(cloud.queries, cloud.targets, 0.0, 0.02);
    search.update(cloud.x);
    std::vector<Index> list;
    for (std::size_t q = 0; q < search.queries().size(); ++q) {
      list.push_back(-1);
      list.insert(list.end(), search.targets_of(q).begin(), search.targets_of(q).end());
    }
    lists.push_back(list);
  }
  set_threads(0);
  EXPECT_EQ(lists[0], lists[1]);
  EXPECT_EQ(lists[0], lists[2]);
}

TEST(BroadPhase, RefusesPositionsThatAreNotFinite) {
  std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  BroadPhase search({{{0}, 1}}, {{{1, 2}, 2}}, 0.0, 1.0);
  search.update(x);
  x[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(search.update(x), std::domain_error);
}

TEST(BroadPhase, EmptySidesHaveNoPairs) {
  BroadPhase none({}, {{{0, 1}, 2}}, 0.0, 1.0), nothing({{{0}, 1}}, {}, 0.0, 1.0);
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}};
  none.update(x);
  nothing.update(x);
  EXPECT_EQ(none.pair_count(), 0U);
  EXPECT_TRUE(nothing.targets_of(0).empty());
}

}  // namespace
}  // namespace carom::contact_search_test
