// Work on the order in which kept results have grown.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "state/state.hpp"

namespace carom {

/// The entries that call number k has brought.
inline std::span<const Index> entries_of_call(const Growth& growth, std::size_t k) {
  const auto first = static_cast<std::size_t>(k == 0 ? 0 : growth.calls[k - 1]);
  return std::span(growth.entries).subspan(first, static_cast<std::size_t>(growth.calls[k]) - first);
}

/// Number of first calls that are the same in both.
inline std::size_t calls_in_common(const Growth& a, const Growth& b) {
  std::size_t k = 0;
  const auto is_same = [&] { return std::ranges::equal(entries_of_call(a, k), entries_of_call(b, k)); };
  while (k < std::min(a.calls.size(), b.calls.size()) && is_same()) ++k;
  return k;
}

inline void add_call(Growth& growth, std::span<const Index> entries) {
  growth.entries.insert(growth.entries.end(), entries.begin(), entries.end());
  growth.calls.push_back(static_cast<Index>(growth.entries.size()));
}

/// Keeps the first calls.
inline void cut_growth(Growth& growth, std::size_t calls) {
  growth.entries.resize(calls == 0 ? 0 : static_cast<std::size_t>(growth.calls[calls - 1]));
  growth.calls.resize(calls);
}

}  // namespace carom
