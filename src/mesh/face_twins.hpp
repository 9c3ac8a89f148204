// Which faces of cells are the same.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Larger than any node.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

/// The corners of a face in increasing order, by which it is known; what it does not need is no_index.
using FaceKey = std::array<Index, 4>;
FaceKey face_key(std::span<const Index> corners);

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// The key of a face that is not there.
inline constexpr FaceKey no_face{no_index, no_index, no_index, no_index};

/// Of each face the number of another one with the same key, no_twin where there is none. key_of(number) gives the
/// keys, which are not kept: there may be millions. Time is linear in the number of faces while few have their smallest
/// node in common.
template <class KeyOf>
std::vector<std::uint32_t> face_twins(std::size_t faces, const KeyOf& key_of, std::size_t node_count) {
  assert(faces < no_twin);
  std::vector<std::uint32_t> last(node_count, no_twin);            // by node: the last face so far whose smallest it is
  std::vector<std::uint32_t> before(faces), twin(faces, no_twin);  // by face: the one before it there
  for (std::size_t i = 0; i < faces; ++i) {
    const FaceKey key = key_of(i);
    if (key == no_face) continue;
    std::uint32_t& head = last[static_cast<std::size_t>(key[0])];
    before[i] = head;
    head = static_cast<std::uint32_t>(i);
    for (std::uint32_t j = before[i]; j != no_twin; j = before[j]) {
      if (key_of(j) != key) continue;
      twin[i] = j;
      twin[j] = static_cast<std::uint32_t>(i);
      break;
    }
  }
  return twin;
}

}  // namespace carom
