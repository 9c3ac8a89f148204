// Who gets the slots of a segment: pairs keep theirs from step to step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Gives slots to the pairs found. Returns for each slot the number of its pair, -1: none. `kept`: for each slot the
/// other side of the pair that was in touch there at the beginning of the step, or -1. These pairs keep their slots; of
/// the others the deepest, by their gap, take the slots that are left, in their order.
template <std::size_t slots, class Found, class Gap>
std::array<std::ptrdiff_t, slots> kept_slots(const std::vector<Found>& found, std::span<const Index> kept,
                                             const Gap& gap) {
  std::array<std::ptrdiff_t, slots> places;
  places.fill(-1);
  std::vector<std::ptrdiff_t> others;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const auto place = std::find(kept.begin(), kept.end(), found[k].other);
    if (place != kept.end())
      places[static_cast<std::size_t>(place - kept.begin())] = static_cast<std::ptrdiff_t>(k);
    else
      others.push_back(static_cast<std::ptrdiff_t>(k));
  }
  const auto free = static_cast<std::size_t>(std::count(places.begin(), places.end(), -1));
  if (others.size() > free) {
    const auto gap_of = [&](std::ptrdiff_t k) { return std::invoke(gap, found[static_cast<std::size_t>(k)]); };
    std::ranges::stable_sort(others, {}, gap_of);
    others.resize(free);
    std::sort(others.begin(), others.end());
  }
  auto next = others.begin();
  for (std::ptrdiff_t& place : places)
    if (place < 0 && next != others.end()) place = *next++;
  return places;
}

}  // namespace carom
