// Histories find their slots again when surfaces have lost and gained facets.
#include "contact/slot_keys.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace carom::contact_slot_keys_test {
namespace {

SlotKeys of(const std::vector<Index>& nodes, const std::vector<Facet>& met) {
  SlotKeys keys;
  for (const Index n : nodes) keys.add({&n, 1});
  keys.meet(node_keys(met));
  return keys;
}

const Facet first{{0, 1, 2, 3}, 4}, second{{2, 3, 4, 5}, 4}, third{{4, 5, 6, 7}, 4};

TEST(SlotKeys, CarryWhatEachNodeRemembers) {
  const SlotKeys before = of({10, 11, 12}, {first, second});
  const std::vector<RowHistory> history{{{1, 0, 0}, {}, 0}, {{2, 0, 0}, {}, 1}, {{3, 0, 0}, {}, -1}};
  const SlotKeys after = of({12, 9, 11, 10}, {third, second});
  const std::vector<RowHistory> carried = after.carry(before, after.places_in(before), history);
  ASSERT_EQ(carried.size(), 4U);
  EXPECT_EQ(carried[0], history[2]);
  EXPECT_EQ(carried[1], RowHistory{});  // it is new
  EXPECT_EQ(carried[2].slip, history[1].slip);
  EXPECT_EQ(carried[2].facet, 1);       // the same facet
  EXPECT_EQ(carried[3], RowHistory{});  // what it was behind has gone
}

// Of several makers, slots of the same nodes are told apart.
TEST(SlotKeys, OfMakersAreTheirOwn) {
  const auto two = [](const std::vector<Index>& nodes) {
    SlotKeys keys;
    for (std::uint64_t maker = 0; maker < 2; ++maker) {
      const std::size_t begin = keys.size();
      for (const Index n : nodes) keys.add({&n, 1});
      keys.meet({});
      keys.set_maker(begin, maker);
    }
    return keys;
  };
  const std::vector<RowHistory> history{{{1, 0, 0}, {}, 5}, {}, {{2, 0, 0}, {}, 6}, {}};
  const std::vector<RowHistory> carried = two({8, 7}).carry(two({7, 8}), two({8, 7}).places_in(two({7, 8})), history);
  EXPECT_EQ(carried[1], history[0]);  // facets without keys keep their numbers
  EXPECT_EQ(carried[3], history[2]);
  EXPECT_EQ(carried[0], RowHistory{});
}

}  // namespace
}  // namespace carom::contact_slot_keys_test
