// Ranks of one process: their messages, what they gather, and how they end.
#include "parallel/ranks.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <stdexcept>
#include <vector>

#include "parallel/threads.hpp"

namespace carom::parallel_ranks {
namespace {

TEST(Ranks, AThreadByItselfIsTheOnlyOne) {
  EXPECT_EQ(ranks().count(), 1U);
  EXPECT_EQ(ranks().own(), 0U);
  EXPECT_THROW(ranks().receive(0), std::logic_error);
}

TEST(Ranks, SharesFollowEachOtherAndCoverAll) {
  for (const std::size_t n : {0U, 2U, 7U, 1000U}) {
    std::size_t next = 0;
    for (std::size_t r = 0; r < 3; ++r) {
      const EntryRange share = share_of(r, 3, n);
      EXPECT_EQ(share.begin, next);
      EXPECT_LE(share.size(), n / 3 + 1);
      next = share.end;
    }
    EXPECT_EQ(next, n);
  }
}

TEST(Ranks, MessagesArriveInTheOrderTheyWereSentIn) {
  std::vector<std::vector<double>> seen(3);
  run_on_ranks(3, [&] {
    Ranks& all = ranks();
    const std::size_t next = (all.own() + 1) % 3, before = (all.own() + 2) % 3;
    for (const double value : {1.0, 2.0}) all.send(next, std::vector{10.0 * static_cast<double>(all.own()) + value});
    for (int k = 0; k < 2; ++k) seen[all.own()].push_back(all.receive(before).at(0));
    EXPECT_EQ(thread_count(), 1);
  });
  EXPECT_EQ(seen, (std::vector<std::vector<double>>{{21.0, 22.0}, {1.0, 2.0}, {11.0, 12.0}}));
  EXPECT_EQ(ranks().count(), 1U);
}

TEST(Ranks, GatherGivesTheEntriesOfEachToAll) {
  const std::vector<std::vector<EntryRange>> of_ranks{{{0, 1}, {5, 8}}, {{1, 4}}, {{8, 8}}};
  run_on_ranks(3, [&] {
    const Exchange exchange(of_ranks);
    std::vector<double> values(8, -1.0);
    for (const EntryRange& range : of_ranks[ranks().own()])
      std::iota(values.begin() + static_cast<std::ptrdiff_t>(range.begin),
                values.begin() + static_cast<std::ptrdiff_t>(range.end), static_cast<double>(range.begin));
    exchange.gather(values);
    EXPECT_EQ(values, (std::vector{0.0, 1.0, 2.0, 3.0, -1.0, 5.0, 6.0, 7.0})) << "entry 4 is nobody's";
  });
}

TEST(Ranks, GatherTakesEntriesOfSeveralValues) {
  run_on_ranks(2, [] {
    std::vector<double> values(6, -1.0);
    const auto own = static_cast<std::ptrdiff_t>(ranks().own());
    std::iota(values.begin() + 4 * own, values.begin() + 4 * own + (own == 0 ? 4 : 2), static_cast<double>(4 * own));
    Exchange({{{0, 2}}, {{2, 3}}}).gather(values, 2);
    EXPECT_EQ(values, (std::vector{0.0, 1.0, 2.0, 3.0, 4.0, 5.0}));
  });
}

TEST(Ranks, AnEntryIsInTheShareOfItsSharer) {
  for (const std::size_t n : {1U, 2U, 7U, 1000U})
    for (std::size_t i = 0; i < n; ++i) {
      const EntryRange share = share_of(sharer_of(i, 3, n), 3, n);
      EXPECT_TRUE(i >= share.begin && i < share.end) << i << " of " << n;
    }
}

TEST(Ranks, FindTheLargestOfAllAndOfEqualOnesTheFirst) {
  using Largest = std::pair<double, std::size_t>;
  EXPECT_EQ(largest_on_ranks(0.5, 3), Largest(0.5, 3));
  run_on_ranks(3, [] {
    const std::size_t own = ranks().own();
    EXPECT_EQ(largest_on_ranks(own == 1 ? 2.0 : 1.0, 10 * own), Largest(2.0, 10));
    EXPECT_EQ(largest_on_ranks(own == 2 ? 1.0 : 2.0, 10 - own), Largest(2.0, 9));
  });
}

TEST(Ranks, OneThatFailsEndsThoseThatWaitForIt) {
  const auto fails = [] {
    run_on_ranks(3, [] {
      if (ranks().own() == 1) throw std::invalid_argument("rank 1");
      ranks().receive(1);
    });
  };
  EXPECT_THROW(fails(), std::invalid_argument);
}

TEST(Ranks, AgreeOnWhatIsSoOnAnyOfThem) {
  EXPECT_TRUE(on_any_rank(true));  // of a run on one
  EXPECT_FALSE(on_any_rank(false));
  for (const std::size_t count : {1U, 2U, 3U}) {
    run_on_ranks(count, [&] {
      EXPECT_FALSE(on_any_rank(false));
      EXPECT_TRUE(on_any_rank(true));
      EXPECT_TRUE(on_any_rank(ranks().own() == count - 1));
    });
  }
}

TEST(Ranks, CompareWhatAllOfThemGive) {
  EXPECT_TRUE(same_on_all_ranks(0.5));
  run_on_ranks(3, [] {
    EXPECT_TRUE(same_on_all_ranks(0.5));
    EXPECT_FALSE(same_on_all_ranks(ranks().own() == 1 ? 0.25 : 0.5));
  });
}

TEST(Ranks, AreThoseOfTheBodyAlone) {
  run_on_ranks(2, [] {
    Ranks& of_thread = ranks();
    EXPECT_THROW(run_as(of_thread, [] { throw std::runtime_error("in the body"); }), std::runtime_error);
    EXPECT_EQ(&ranks(), &of_thread);
  });
  EXPECT_EQ(ranks().count(), 1U);
}

}  // namespace
}  // namespace carom::parallel_ranks
