#include "system/held_points.hpp"

#include <utility>
#include <vector>

namespace carom {
namespace {

using Marks = std::vector<std::uint8_t>;

template <class Body>
void each_in(EntryRange range, const Body& body) {
  for (std::size_t i = range.begin; i < range.end; ++i) body(i);
}

}  // namespace

Holding held_coarse_points(const Holding& fine, const Interpolation& P, const BlockMatrix& A) {
  if (fine.is_whole()) return Holding(P.coarse_points());
  Marks by_all(P.coarse_points(), 0);
  const auto mark = [&](Marks& marks, std::size_t n) {
    for (const Index I : P.coarse_of(n)) marks[at(I)] = 1;
  };
  for (const EntryRange& range : fine.held_by_all()) each_in(range, [&](std::size_t n) { mark(by_all, n); });
  Marks held = by_all;
  each_in(own_share_of(P.coarse_points()), [&](std::size_t n) {
    for (std::int64_t k = A.row_begin[n]; k < A.row_begin[n + 1]; ++k)
      held[at(A.column[static_cast<std::size_t>(k)])] = 1;
  });
  each_in(own_share_of(P.fine_points()), [&](std::size_t n) { mark(held, n); });
  return {std::move(held), by_all};
}

Holding restricted_points(const Holding& fine, const Interpolation& P) {
  if (fine.is_whole()) return Holding(P.fine_points());
  Marks held(P.fine_points(), 0);
  each_in(own_share_of(P.coarse_points()), [&](std::size_t I) {
    for (const Index n : P.fine_of(I)) held[at(n)] = 1;
  });
  return {std::move(held), Marks(P.fine_points(), 0)};
}

}  // namespace carom
