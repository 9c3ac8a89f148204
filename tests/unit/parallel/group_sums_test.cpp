// Sums by group against sums in long double, and their bits on threads and ranks.
#include "parallel/group_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "parallel/holding.hpp"

namespace carom::parallel_group_sums {
namespace {

using Sums = std::vector<std::array<double, 2>>;

/// Runs of 700 items of each of three groups in turn; every 500th is shared by two, every 911th of none.
std::vector<GroupShare> shares_of(std::size_t items) {
  std::vector<GroupShare> shares;
  for (std::size_t i = items; i-- > 0;) {  // not in their order
    const auto item = static_cast<Index>(i), group = static_cast<Index>(i / 700 % 3);
    if (i % 911 == 910) continue;
    const double other = i % 500 == 0 ? 0.25 : 0.0;
    shares.push_back({item, group, 1.0 - other});
    if (other > 0.0) shares.push_back({item, (group + 1) % 3, other});
  }
  return shares;
}

std::array<double, 2> value_of(std::size_t i) {
  return {std::sin(static_cast<double>(i)), std::cos(0.1 * static_cast<double>(i))};
}

constexpr std::size_t sizes[]{1, 5, 2048, 2049, 14161};

TEST(GroupSums, AreTheSumsOfTheirShares) {
  for (const std::size_t n : sizes) {
    const std::vector<GroupShare> shares = shares_of(n);
    const Sums sums = GroupSums(n, 3, shares).sums<2>(false, value_of);
    std::array<std::array<long double, 2>, 3> expected{};
    for (const GroupShare& s : shares)
      for (std::size_t c = 0; c < 2; ++c)
        expected.at(at(s.group)).at(c) += s.share * static_cast<long double>(value_of(at(s.item))[c]);
    for (std::size_t g = 0; g < 3; ++g)
      for (std::size_t c = 0; c < 2; ++c)  // round-off of n terms of size 1
        EXPECT_NEAR(sums[g][c], static_cast<double>(expected.at(g).at(c)), 1e-15 * static_cast<double>(n + 10)) << n;
  }
}

// A rank computes with the items alone that Holding gives to it: all others are no numbers there.
TEST(GroupSums, HaveTheBitsOfOneRank) {
  for (const std::size_t n : sizes) {
    const Sums alone = GroupSums(n, 3, shares_of(n)).sums<2>(false, value_of);
    for (const std::size_t count : {1U, 2U, 3U, 7U})
      run_on_ranks(count, [&] {
        const std::vector<std::uint8_t> none(n, 0);
        const Holding holding(none, none);
        std::vector<double> known(n, std::nan(""));
        holding.each_range([&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) known[i] = 1.0;
        });
        const auto own = [&](std::size_t i) {
          return std::array{known[i] * value_of(i)[0], known[i] * value_of(i)[1]};
        };
        const GroupSums shared(n, 3, shares_of(n));
        EXPECT_EQ(shared.sums<2>(true, own), alone) << n << " on " << count;
        EXPECT_EQ(shared.sums<2>(false, value_of), alone);
      });
  }
  const int before = thread_count();
  const Sums one = GroupSums(14161, 3, shares_of(14161)).sums<2>(false, value_of);
  for (const int threads : {2, 4}) {
    set_threads(threads);
    EXPECT_EQ((GroupSums(14161, 3, shares_of(14161)).sums<2>(false, value_of)), one) << threads;
  }
  set_threads(before);
}

}  // namespace
}  // namespace carom::parallel_group_sums
