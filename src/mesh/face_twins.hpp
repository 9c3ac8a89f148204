// Which faces of cells are the same.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Larger than any node.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// The corners of a face in increasing order, by which it is known; what it does not need is no_index.
using FaceKey = std::array<Index, 4>;

inline FaceKey face_key(std::span<const Index> corners) {
  FaceKey key;
  for (std::size_t a = 0; a < 4; ++a) key[a] = a < corners.size() ? corners[a] : no_index;
  const auto order = [&key](std::size_t i, std::size_t j) {
    const Index low = std::min(key[i], key[j]), high = std::max(key[i], key[j]);
    key[i] = low, key[j] = high;
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return key;
}

/// a == b without a call.
inline bool is_same(const FaceKey& a, const FaceKey& b) {
  return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2]) | (a[3] ^ b[3])) == 0;
}

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// The key of a face that is not there.
inline constexpr FaceKey no_face{no_index, no_index, no_index, no_index};

/// Of each face the number of another one with the same key, no_twin where there is none. key_of(number) gives the
/// keys, which are not kept: there may be millions. The faces come cell by cell, `per_cell` of most of them: the twin
/// of a face is first looked for where that of the same face of the cell before leads to. Time is linear in the number
/// of faces while few have their smallest node in common.
template <class KeyOf>
std::vector<std::uint32_t> face_twins(std::size_t faces, std::size_t per_cell, const KeyOf& key_of,
                                      std::size_t node_count) {
  assert(faces < no_twin);
  std::vector<std::uint32_t> last(node_count, no_twin);  // by node: one of the faces whose smallest it is
  std::vector<std::uint32_t> next(faces, no_twin), twin(faces, no_twin);  // by face: another one there
  const auto enter = [&](std::size_t i, const FaceKey& key) {
    next[i] = std::exchange(last[static_cast<std::size_t>(key[0])], static_cast<std::uint32_t>(i));
  };
  const auto entered_with = [&](const FaceKey& key, std::size_t self) {
    std::uint32_t j = last[static_cast<std::size_t>(key[0])];
    while (j != no_twin && (j == self || !is_same(key_of(j), key))) j = next[j];
    return j;
  };
  for (std::size_t i = 0; i < faces; ++i) {
    if (twin[i] != no_twin) continue;
    const FaceKey key = key_of(i);
    if (is_same(key, no_face)) continue;
    const std::uint32_t before = i < per_cell ? no_twin : twin[i - per_cell];
    const std::size_t guess = before == no_twin ? faces : before + per_cell;
    const bool is_found = guess != i && guess < faces && twin[guess] == no_twin && is_same(key_of(guess), key);
    const std::uint32_t other = is_found ? static_cast<std::uint32_t>(guess) : entered_with(key, i);
    if (other != no_twin) twin[i] = other, twin[other] = static_cast<std::uint32_t>(i);
    enter(i, key);
    if (is_found && guess > i) enter(guess, key);
  }
  // Where more than two faces are equal, a guess may have paired some of them after another one had been looked for.
  for (std::size_t i = 0; i < faces; ++i) {
    if (twin[i] != no_twin) continue;
    const FaceKey key = key_of(i);
    if (!is_same(key, no_face)) twin[i] = entered_with(key, i);
  }
  return twin;
}

}  // namespace carom
