// Items, such as nodes, that ranks share out: each owns those that follow each other, and holds others beside them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {

/// Vectors have three values for each item. A rank's are right where it holds the item; the others are left from
/// whenever they were right last. The ranks own the items as share_of says.
class Holding {
 public:
  /// Every rank holds all.
  explicit Holding(std::size_t items);
  /// held[i]: this rank holds item i, besides its own and those that it adds up. by_all[i]: all ranks do, and all of
  /// them say so. All ranks call it.
  Holding(std::vector<std::uint8_t> held, std::span<const std::uint8_t> by_all);

  std::size_t size() const { return items_; }
  /// True where each rank holds all.
  bool is_whole() const { return is_whole_; }
  /// The items that are known to be held by every rank.
  std::span<const EntryRange> held_by_all() const { return by_all_; }

  /// Calls body(begin, end) for ranges of items that together are all that this rank holds, at the same time.
  template <class Body>
  void each_range(const Body& body) const {
    parallel_for(added_.size(), vector_grain,
                 [&](std::size_t begin, std::size_t end) { body(added_.begin + begin, added_.begin + end); });
    each_range_beside(body);
  }
  /// The sums over all items, to the bit as parallel_sums has them: a rank adds up blocks of items whose first is its
  /// own, calls add(item, sums) for these alone, and tells the others. All ranks call it.
  template <std::size_t N, class Add>
  std::array<double, N> sums(const Add& add) const;
  /// The same for what it holds beside the items that sums() calls add for.
  template <class Body>
  void each_range_beside(const Body& body) const {
    parallel_for(beside_.group_begin.size() - 1, 1, [&](std::size_t group, std::size_t) {
      for (std::size_t k = beside_.group_begin[group]; k < beside_.group_begin[group + 1]; ++k)
        body(beside_.ranges[k].begin, beside_.ranges[k].end);
    });
  }

  /// The owners give the values of what others hold. All ranks call it.
  void update(std::span<double> values) const;
  /// The owners give all of their values to all. All ranks call it.
  void complete(std::span<double> values) const;
  /// The owners give all of their values to the first rank. All ranks call it.
  void collect(std::span<double> values) const;
  /// The owners of some items give theirs to all. All ranks call it for the same items.
  void complete(std::span<double> values, std::span<const Index> items) const;
  /// In builds with assertions, makes what this rank does not hold no numbers, so that tests see who reads it.
  void spoil(std::span<double> values) const;
  /// Gives a vector its size, if it has another: all values are 0 then, and take memory once they are written to.
  void resize(std::vector<double>& values) const;
  /// Makes what this rank does not hold 0, and gives its memory back.
  void release(std::span<double> values) const;

 private:
  /// Ranges of items in groups of some thousand items.
  struct Pieces {
    std::vector<EntryRange> ranges;
    std::vector<std::size_t> group_begin{0};
    void add(EntryRange range);
    void close();
    std::size_t size = 0;  ///< of the group that is open
  };
  static std::vector<EntryRange> ranges_of(std::span<const std::uint8_t> held, EntryRange among);
  EntryRange blocks_of(std::size_t rank) const;
  /// Each rank tells the owners what it takes from them.
  void agree_on_gifts();
  /// Of the values that the ranks own.
  Exchange of_owners() const;
  void gather_sums(std::span<double> of_blocks, std::size_t each) const;

  std::size_t items_;
  bool is_whole_ = true;
  std::vector<EntryRange> by_all_;
  EntryRange added_;                                  ///< what this rank adds up
  Pieces beside_;                                     ///< what else it holds
  std::vector<EntryRange> held_;                      ///< all that it holds, in their order
  std::vector<std::vector<EntryRange>> give_, take_;  ///< by the other rank
};

template <std::size_t N, class Add>
std::array<double, N> Holding::sums(const Add& add) const {
  std::vector<double> of_blocks(N * ((items_ + reduction_block - 1) / reduction_block), 0.0);
  parallel_for(added_.size(), reduction_block, [&](std::size_t begin, std::size_t end) {
    std::array<double, N> s{};
    for (std::size_t i = added_.begin + begin; i < added_.begin + end; ++i) add(i, s);
    std::copy(s.begin(), s.end(),
              of_blocks.begin() + static_cast<std::ptrdiff_t>(N * ((added_.begin + begin) / reduction_block)));
  });
  gather_sums(of_blocks, N);
  std::array<double, N> all{};
  if (of_blocks.size() == N)
    std::copy_n(of_blocks.begin(), N, all.begin());  // as parallel_sums, which adds nothing to them
  else
    for (std::size_t k = 0; k < of_blocks.size(); ++k) all[k % N] += of_blocks[k];
  return all;
}

}  // namespace carom
