// Sums by group over items, such as nodes by part, in an order that depends on neither threads nor ranks.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/types.hpp"
#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {

/// What of an item counts to a group.
struct GroupShare {
  Index item = 0, group = 0;
  double share = 1.0;
};

/// The shares of items, laid out so that a block of items that a rank adds up (Holding::sums) stands together.
class GroupSums {
 public:
  GroupSums() = default;
  /// In any order; an item may have shares in several groups, and none.
  GroupSums(std::size_t items, std::size_t groups, std::vector<GroupShare> shares);

  /// By group the sums of share x of(item), of: item -> std::array<double, N>. is_partial: a rank knows the items that
  /// Holding::sums would ask it for, and all ranks call it; else each rank knows all. The same bits either way.
  template <std::size_t N, class Of>
  std::vector<std::array<double, N>> sums(bool is_partial, const Of& of) const {
    std::vector<double> values(N * pieces_.size(), 0.0);
    const EntryRange own = is_partial ? of_ranks_[ranks().own()] : EntryRange{0, pieces_.size()};
    parallel_for(own.size(), 1, [&](std::size_t begin, std::size_t) {
      const Piece& piece = pieces_[own.begin + begin];
      std::array<double, N> s{};
      for (std::size_t k = piece.begin; k < piece.end; ++k) {
        const auto& [items, share] = runs_[k];
        std::size_t item = items.begin;
        for (; item + 4 <= items.end; item += 4) {  // four at a time: sums wait for the one before
          const std::array<double, N> t0 = of(item), t1 = of(item + 1), t2 = of(item + 2), t3 = of(item + 3);
          for (std::size_t c = 0; c < N; ++c) s[c] += share * ((t0[c] + t1[c]) + (t2[c] + t3[c]));
        }
        for (; item < items.end; ++item) {
          const std::array<double, N> term = of(item);
          for (std::size_t c = 0; c < N; ++c) s[c] += share * term[c];
        }
      }
      std::copy(s.begin(), s.end(), values.begin() + static_cast<std::ptrdiff_t>(N * (own.begin + begin)));
    });
    if (is_partial) gather(values, N);
    std::vector<std::array<double, N>> all(groups_, std::array<double, N>{});
    for (std::size_t p = 0; p < pieces_.size(); ++p)
      for (std::size_t c = 0; c < N; ++c) all[pieces_[p].group][c] += values[N * p + c];
    return all;
  }

 private:
  /// Items that follow each other and have one share.
  struct Run {
    EntryRange items;
    double share = 1.0;
  };
  /// The runs of one group within a block of items.
  struct Piece {
    std::size_t group = 0, begin = 0, end = 0;
  };
  void gather(std::vector<double>& values, std::size_t width) const;

  std::size_t groups_ = 0;
  std::vector<Run> runs_;
  std::vector<Piece> pieces_;
  std::vector<EntryRange> of_ranks_;  ///< the pieces that each rank adds up
};

}  // namespace carom
