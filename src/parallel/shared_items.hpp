// What ranks find out item by item, each for its share of them.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "parallel/ranks.hpp"
#include "parallel/threads.hpp"

namespace carom {

/// found[i] = of(i) for all items: each rank calls it for its share of them (share_of), in threads, `grain` of
/// them at a time, and has all that the others have found afterwards. All ranks call it.
template <class Found, class Of>
void find_shared(std::span<Found> found, std::size_t grain, const Of& of) {
  static_assert(std::is_trivially_copyable_v<Found>);
  const EntryRange own = own_share_of(found.size());
  parallel_for(own.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = own.begin + begin; i < own.begin + end; ++i) found[i] = of(i);
  });
  const std::size_t count = ranks().count();
  if (count == 1) return;
  constexpr std::size_t width = (sizeof(Found) + sizeof(double) - 1) / sizeof(double);
  std::vector<std::vector<EntryRange>> shares;
  for (std::size_t r = 0; r < count; ++r) shares.push_back({share_of(r, count, found.size())});
  thread_local std::vector<double> values;  // memory that is new costs more than what is copied to it
  values.resize(width * found.size());
  for (std::size_t i = own.begin; i < own.end; ++i) std::memcpy(values.data() + width * i, &found[i], sizeof(Found));
  Exchange(std::move(shares)).gather(values, width);
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!own.has(i)) std::memcpy(static_cast<void*>(&found[i]), values.data() + width * i, sizeof(Found));
}

}  // namespace carom
