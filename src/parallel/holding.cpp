#include "parallel/holding.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/page_memory.hpp"

namespace carom {

Holding::Holding(std::size_t items)
    : items_(items), by_all_{{0, items}}, held_{{0, items}}, give_(ranks().count()), take_(ranks().count()) {
  added_ = blocks_of(ranks().own());
  beside_.add({0, added_.begin});
  beside_.add({added_.end, items});
  beside_.close();
  for (std::size_t r = 0; r < ranks().count(); ++r) {
    if (r == ranks().own()) continue;
    give_[r] = {own_share_of(items)};
    take_[r] = {share_of(r, ranks().count(), items)};
  }
}

Holding::Holding(std::vector<std::uint8_t> held, std::span<const std::uint8_t> by_all)
    : items_(held.size()), give_(ranks().count()), take_(ranks().count()) {
  added_ = blocks_of(ranks().own());
  for (const EntryRange& range : {own_share_of(items_), added_})
    std::fill_n(held.begin() + static_cast<std::ptrdiff_t>(range.begin), range.size(), std::uint8_t{1});
  const EntryRange all{0, items_};
  held_ = ranges_of(held, all);
  is_whole_ = !on_any_rank(std::ranges::find(held, 0) != held.end());
  by_all_ = is_whole_ ? held_ : ranges_of(by_all, all);
  for (const EntryRange& among : {EntryRange{0, added_.begin}, EntryRange{added_.end, items_}})
    for (const EntryRange& range : ranges_of(held, among)) beside_.add(range);
  beside_.close();
  for (std::size_t r = 0; r < take_.size(); ++r)
    if (r != ranks().own()) take_[r] = ranges_of(held, share_of(r, take_.size(), items_));
  agree_on_gifts();
}

void Holding::agree_on_gifts() {
  const auto each_other = [&](const auto& body) {
    for (std::size_t r = 0; r < give_.size(); ++r)
      if (r != ranks().own()) body(r);
  };
  each_other([&](std::size_t r) {
    std::vector<double> ends;
    for (const EntryRange& range : take_[r])
      ends.insert(ends.end(), {static_cast<double>(range.begin), static_cast<double>(range.end)});
    ranks().send(r, ends);
  });
  each_other([&](std::size_t r) {
    const std::vector<double> ends = ranks().receive(r);
    for (std::size_t k = 0; k < ends.size(); k += 2)
      give_[r].push_back({static_cast<std::size_t>(ends[k]), static_cast<std::size_t>(ends[k + 1])});
  });
  ranks().settle();
}

void Holding::Pieces::add(EntryRange range) {
  while (range.begin < range.end) {
    const EntryRange piece{range.begin, std::min(range.end, range.begin + vector_grain - size)};
    ranges.push_back(piece);
    size += piece.size();
    range.begin = piece.end;
    if (size == vector_grain) close();
  }
}

void Holding::Pieces::close() {
  if (size > 0) group_begin.push_back(ranges.size());
  size = 0;
}

/// The items of whole blocks, the last of which may be another's, that begin with an item of the rank.
EntryRange Holding::blocks_of(std::size_t rank) const {
  const EntryRange own = share_of(rank, ranks().count(), items_);
  const auto up = [&](std::size_t i) {
    return std::min(items_, (i + reduction_block - 1) / reduction_block * reduction_block);
  };
  return {up(own.begin), up(own.end)};
}

std::vector<EntryRange> Holding::ranges_of(std::span<const std::uint8_t> held, EntryRange among) {
  std::vector<EntryRange> ranges;
  for (std::size_t i = among.begin; i < among.end; ++i) {
    if (held[i] == 0) continue;
    if (!ranges.empty() && ranges.back().end == i)
      ++ranges.back().end;
    else
      ranges.push_back({i, i + 1});
  }
  return ranges;
}

void Holding::update(std::span<double> values) const {
  Ranks& all = ranks();
  thread_local std::vector<double> given, taken;  // memory that is new costs more than what is copied to it
  std::vector<RangesInPieces> give(give_.begin(), give_.end()), take(take_.begin(), take_.end());
  const auto has_more = [](const std::vector<RangesInPieces>& of_ranks) {
    return std::ranges::any_of(of_ranks, [](const RangesInPieces& of_rank) { return of_rank.left() > 0; });
  };
  while (has_more(give) || has_more(take)) {
    for (std::size_t r = 0; r < all.count(); ++r) {
      if (give[r].left() == 0) continue;
      given.clear();
      give[r].next(3, [&](std::size_t begin, std::size_t end) {
        given.insert(given.end(), values.begin() + static_cast<std::ptrdiff_t>(begin),
                     values.begin() + static_cast<std::ptrdiff_t>(end));
      });
      all.send(r, given);
    }
    for (std::size_t r = 0; r < all.count(); ++r) {
      if (take[r].left() == 0) continue;
      all.receive(r, taken);
      auto from = taken.begin();
      take[r].next(3, [&](std::size_t begin, std::size_t end) {
        std::copy_n(from, end - begin, values.begin() + static_cast<std::ptrdiff_t>(begin));
        from += static_cast<std::ptrdiff_t>(end - begin);
      });
    }
    all.settle();
  }
}

Exchange Holding::of_owners() const {
  std::vector<std::vector<EntryRange>> owned;
  for (std::size_t r = 0; r < ranks().count(); ++r) owned.push_back({share_of(r, ranks().count(), items_)});
  return Exchange(std::move(owned));
}

void Holding::complete(std::span<double> values) const {
  if (!is_whole_) of_owners().gather(values, 3);
}

void Holding::collect(std::span<double> values) const {
  if (!is_whole_) of_owners().collect(values, 3);
}

void Holding::complete(std::span<double> values, std::span<const Index> items) const {
  if (is_whole_) return;
  std::vector<std::vector<EntryRange>> owned(ranks().count());
  for (const Index item : items) {
    const auto i = static_cast<std::size_t>(item);
    std::vector<EntryRange>& its = owned[sharer_of(i, owned.size(), items_)];
    if (!its.empty() && its.back().end == i)
      ++its.back().end;
    else
      its.push_back({i, i + 1});
  }
  Exchange(std::move(owned)).gather(values, 3);
}

void Holding::gather_sums(std::span<double> of_blocks, std::size_t each) const {
  if (ranks().count() == 1) return;
  std::vector<std::vector<EntryRange>> owned;
  for (std::size_t r = 0; r < ranks().count(); ++r) {
    const EntryRange items = blocks_of(r);
    const auto block = [&](std::size_t i) { return (i + reduction_block - 1) / reduction_block; };
    owned.push_back({{block(items.begin), block(items.end)}});
  }
  Exchange(std::move(owned)).gather(of_blocks, each);
}

void Holding::spoil([[maybe_unused]] std::span<double> values) const {
#ifndef NDEBUG
  each_gap(held_, items_, [&](std::size_t begin, std::size_t end) {
    std::ranges::fill(values.subspan(3 * begin, 3 * (end - begin)), std::numeric_limits<double>::quiet_NaN());
  });
#endif
}

void Holding::resize(std::vector<double>& values) const {
  if (values.size() == 3 * items_) return;
  values = unwritten_zeros(3 * items_);
}

void Holding::release(std::span<double> values) const {
  each_gap(held_, items_,
           [&](std::size_t begin, std::size_t end) { release_pages(values.subspan(3 * begin, 3 * (end - begin))); });
}

}  // namespace carom
