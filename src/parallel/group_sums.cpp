#include "parallel/group_sums.hpp"

#include <algorithm>
#include <tuple>

namespace carom {

GroupSums::GroupSums(std::size_t items, std::size_t groups, std::vector<GroupShare> shares)
    : groups_(groups), of_ranks_(ranks().count()) {
  const auto block_of = [](const GroupShare& s) { return at(s.item) / reduction_block; };
  const auto place = [&](const GroupShare& s) { return std::tuple(block_of(s), s.group, s.item); };
  std::ranges::sort(shares, [&](const GroupShare& a, const GroupShare& b) { return place(a) < place(b); });
  const GroupShare* last = nullptr;
  for (const GroupShare& next : shares) {
    const bool is_same_piece = last != nullptr && block_of(*last) == block_of(next) && last->group == next.group;
    if (!is_same_piece) {
      pieces_.push_back({at(next.group), runs_.size(), runs_.size()});
      EntryRange& own = of_ranks_[sharer_of(block_of(next) * reduction_block, of_ranks_.size(), items)];
      if (own.size() == 0) own.begin = pieces_.size() - 1;
      own.end = pieces_.size();
    }
    if (is_same_piece && runs_.back().items.end == at(next.item) && last->share == next.share)
      ++runs_.back().items.end;
    else
      runs_.push_back({{at(next.item), at(next.item) + 1}, next.share});
    pieces_.back().end = runs_.size();
    last = &next;
  }
}

void GroupSums::gather(std::vector<double>& values, std::size_t width) const {
  std::vector<std::vector<EntryRange>> of_ranks;
  for (const EntryRange& own : of_ranks_) of_ranks.push_back({own});
  Exchange(std::move(of_ranks)).gather(values, width);
}

}  // namespace carom
