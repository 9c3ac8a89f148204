// Items that ranks share out: who holds what, sums over all of them, and what is given to whom.
#include "parallel/holding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace carom::parallel_holding {
namespace {

/// Every seventh item, which each of the ranks holds besides what it must.
std::vector<std::uint8_t> every_seventh(std::size_t items) {
  std::vector<std::uint8_t> held(items, 0);
  for (std::size_t i = 0; i < items; i += 7) held[i] = 1;
  return held;
}

Holding with_every_seventh(std::size_t items) {
  return {every_seventh(items), every_seventh(items)};
}

double value_of(std::size_t i) {
  return std::sin(static_cast<double>(i)) * std::exp2(static_cast<double>(i % 60));
}

std::vector<std::uint8_t> seen_by(const Holding& holding) {
  std::vector<std::uint8_t> seen(holding.size(), 0);
  holding.each_range([&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++seen[i];
  });
  return seen;
}

/// What the rank knows is the number of the item and component; all else is -1.
std::vector<double> known(std::size_t items, const auto& knows) {
  std::vector<double> values(3 * items, -1.0);
  for (std::size_t i = 0; i < items; ++i)
    if (knows(i)) std::iota(&values[3 * i], &values[3 * i] + 3, static_cast<double>(3 * i));
  return values;
}

constexpr std::size_t sizes[]{1, 5, 2048, 2049, 5000, 14161};

TEST(Holding, OfOneRankIsAll) {
  const Holding holding(5000);
  EXPECT_TRUE(holding.is_whole());
  EXPECT_TRUE(std::ranges::all_of(seen_by(holding), [](std::uint8_t n) { return n == 1; }));
}

TEST(Holding, SumsHaveTheBitsOfOneRank) {
  const auto add = [](std::size_t i, std::array<double, 2>& sums) {
    sums[0] += value_of(i);
    sums[1] -= 1.0 / value_of(i + 1);
  };
  for (const std::size_t n : sizes) {
    const std::array<double, 2> alone = parallel_sums<2>(n, add);
    for (const std::size_t count : {1U, 2U, 3U, 7U})
      run_on_ranks(count, [&] {
        EXPECT_EQ(with_every_seventh(n).sums<2>(add), alone) << n << " on " << count;
        EXPECT_EQ(Holding(n).sums<2>(add), alone) << n << " on " << count;
      });
  }
}

TEST(Holding, SumsAddNothingThatARankDoesNotHold) {
  run_on_ranks(3, [] {
    const Holding holding = with_every_seventh(14161);
    const std::vector<std::uint8_t> is_held = seen_by(holding);
    const auto sums = holding.sums<1>([&](std::size_t i, std::array<double, 1>& s) { s[0] += is_held[i]; });
    EXPECT_EQ(sums[0], 14161.0);
  });
}

TEST(Holding, GoesOnceThroughWhatIsHeldAndNoFurther) {
  for (const std::size_t n : sizes)
    for (const std::size_t count : {2U, 3U, 7U})
      run_on_ranks(count, [&] {
        const Holding holding = with_every_seventh(n);
        const std::vector<std::uint8_t> seen = seen_by(holding);
        const EntryRange own = share_of(ranks().own(), count, n);
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_LE(seen[i], 1);
          const bool must = i % 7 == 0 || (i >= own.begin && i < own.end);
          EXPECT_TRUE(!must || seen[i] == 1) << i;
        }
      });
}

TEST(Holding, UpdateGivesWhatIsHeldByItsOwnerAndLeavesTheRest) {
  for (const std::size_t n : sizes)
    for (const std::size_t count : {2U, 3U, 7U})
      run_on_ranks(count, [&] {
        const Holding holding = with_every_seventh(n);
        const EntryRange own = share_of(ranks().own(), count, n);
        std::vector<double> values = known(n, [&](std::size_t i) { return i >= own.begin && i < own.end; });
        holding.update(values);
        const std::vector<std::uint8_t> seen = seen_by(holding);
        EXPECT_EQ(values, known(n, [&](std::size_t i) { return seen[i] == 1; })) << n << " on " << count;
      });
}

TEST(Holding, CompleteGivesAllOrSomeOfTheItems) {
  constexpr std::size_t n = 5000;
  const std::vector<Index> some{4999, 3, 1700, 3};
  for (const std::size_t count : {2U, 3U})
    run_on_ranks(count, [&] {
      const Holding holding = with_every_seventh(n);
      const EntryRange own = share_of(ranks().own(), count, n);
      const auto is_own = [&](std::size_t i) { return i >= own.begin && i < own.end; };
      std::vector<double> values = known(n, is_own);
      holding.complete(values, some);
      EXPECT_EQ(values, known(n, [&](std::size_t i) {
                  return is_own(i) || std::ranges::find(some, static_cast<Index>(i)) != some.end();
                }));
      holding.complete(values);
      EXPECT_EQ(values, known(n, [](std::size_t) { return true; }));
    });
}

TEST(Holding, CollectGivesAllToTheFirstRankAlone) {
  for (const std::size_t n : sizes)
    for (const std::size_t count : {2U, 3U, 7U})
      run_on_ranks(count, [&] {
        const Holding holding = with_every_seventh(n);
        const EntryRange own = own_share_of(n);
        const std::vector<double> before = known(n, [&](std::size_t i) { return own.has(i); });
        std::vector<double> values = before;
        holding.collect(values);
        const bool gets_all = ranks().own() == 0 && !holding.is_whole();
        EXPECT_EQ(values, gets_all ? known(n, [](std::size_t) { return true; }) : before) << n << " on " << count;
      });
}

TEST(Holding, ReleaseLeavesWhatIsHeldAndMakesTheRestZero) {
  constexpr std::size_t n = 50000;  // pages have 170 items
  run_on_ranks(3, [] {
    const Holding holding(std::vector<std::uint8_t>(n, 0), std::vector<std::uint8_t>(n, 0));
    const std::vector<std::uint8_t> is_held = seen_by(holding);
    std::vector<double> made, values(3 * n, 7.0);
    holding.resize(made);
    EXPECT_EQ(made, std::vector<double>(3 * n, 0.0));
    holding.release(values);
    for (std::size_t i = 0; i < 3 * n; ++i) ASSERT_EQ(values[i], is_held[i / 3] != 0 ? 7.0 : 0.0) << i;
  });
}

// 14,161 items on three ranks: 0 has those up to 4719, of which the last block of 2048 goes on to 6143; so it holds
// 1423 of rank 1, whose share ends with 9439 and whose last block with 10239.
TEST(Holding, SendsNothingThatIsNotHeld) {
  run_on_ranks(3, [] {
    constexpr std::size_t n = 14161;
    const Holding holding(std::vector<std::uint8_t>(n, 0), std::vector<std::uint8_t>(n, 0));
    std::vector<double> values(3 * n);
    const Traffic before = ranks().sent();
    holding.update(values);
    const Traffic after = ranks().sent();
    const std::size_t own = ranks().own(), given = after.values - before.values;
    EXPECT_EQ(after.messages - before.messages, own == 0 ? 0U : 1U);
    EXPECT_EQ(given, own == 0 ? 0U : own == 1 ? 3 * (6144U - 4720U) : 3 * (10240U - 9440U));
  });
}

}  // namespace
}  // namespace carom::parallel_holding
