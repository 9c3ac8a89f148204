// What ranks find, each in its own part of a model.
#pragma once

#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "parallel/ranks.hpp"

namespace carom {

/// What all ranks have found, that of the first rank first. All ranks call it.
template <class Found>
std::vector<Found> found_by_ranks(std::vector<Found> own) {
  static_assert(std::is_trivially_copyable_v<Found>);
  Ranks& all = ranks();
  if (all.count() == 1) return own;
  constexpr std::size_t width = (sizeof(Found) + sizeof(double) - 1) / sizeof(double);
  const double size = static_cast<double>(width * own.size());
  std::vector<double> values;
  all.gather({&size, 1}, std::vector<std::size_t>(all.count(), 1), values);
  const std::vector<std::size_t> sizes(values.begin(), values.end());
  std::vector<double> given(width * own.size());
  for (std::size_t i = 0; i < own.size(); ++i) std::memcpy(given.data() + width * i, &own[i], sizeof(Found));
  all.gather(given, sizes, values);
  std::vector<Found> found(values.size() / width);
  for (std::size_t i = 0; i < found.size(); ++i)
    std::memcpy(static_cast<void*>(&found[i]), values.data() + width * i, sizeof(Found));
  return found;
}

}  // namespace carom
