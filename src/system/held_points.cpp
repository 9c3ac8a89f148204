#include "system/held_points.hpp"

#include <utility>
#include <vector>

namespace carom {
namespace {

/// Whether each rank holds each item.
using Held = std::vector<std::vector<std::uint8_t>>;

Held none_of(std::size_t items) {
  return Held(ranks().count(), std::vector<std::uint8_t>(items, 0));
}

template <class Body>
void each_in(EntryRange range, const Body& body) {
  for (std::size_t i = range.begin; i < range.end; ++i) body(i);
}

}  // namespace

Holding held_coarse_points(const Holding& fine, const Interpolation& P, const BlockMatrix& A) {
  if (fine.is_whole()) return Holding(P.coarse_points());
  Held held = none_of(P.coarse_points());
  const std::size_t count = held.size();
  for (std::size_t r = 0; r < count; ++r) {
    std::vector<std::uint8_t>& of_rank = held[r];
    each_in(share_of(r, count, P.coarse_points()), [&](std::size_t n) {
      for (std::int64_t k = A.row_begin[n]; k < A.row_begin[n + 1]; ++k)
        of_rank[at(A.column[static_cast<std::size_t>(k)])] = 1;
    });
    const auto add = [&](std::size_t n) {
      for (const Index I : P.coarse_of(n)) of_rank[at(I)] = 1;
    };
    each_in(share_of(r, count, P.fine_points()), add);
    for (const EntryRange& range : fine.held_by_all()) each_in(range, add);
  }
  return Holding(P.coarse_points(), std::move(held));
}

Holding restricted_points(const Holding& fine, const Interpolation& P) {
  if (fine.is_whole()) return Holding(P.fine_points());
  Held held = none_of(P.fine_points());
  for (std::size_t r = 0; r < held.size(); ++r)
    each_in(share_of(r, held.size(), P.coarse_points()), [&](std::size_t I) {
      for (const Index n : P.fine_of(I)) held[r][at(n)] = 1;
    });
  return Holding(P.fine_points(), std::move(held));
}

}  // namespace carom
