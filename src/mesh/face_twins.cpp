#include "mesh/face_twins.hpp"

#include <algorithm>
#include <cassert>

namespace carom {

FaceKey face_key(std::span<const Index> corners) {
  FaceKey key;
  key.fill(std::numeric_limits<Index>::max());
  std::copy(corners.begin(), corners.end(), key.begin());
  const auto order = [&key](std::size_t i, std::size_t j) {
    if (key[j] < key[i]) std::swap(key[i], key[j]);
  };
  order(0, 1);
  order(2, 3);
  order(0, 2);
  order(1, 3);
  order(1, 2);
  return key;
}

std::vector<std::uint32_t> face_twins(std::span<const FaceKey> faces, std::size_t node_count) {
  assert(faces.size() < no_twin);
  std::vector<std::uint32_t> last(node_count, no_twin);  // by node: the last face so far whose smallest it is
  std::vector<std::uint32_t> before(faces.size()), twin(faces.size(), no_twin);  // by face: the one before it there
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::uint32_t& head = last[static_cast<std::size_t>(faces[i][0])];
    before[i] = head;
    head = static_cast<std::uint32_t>(i);
    for (std::uint32_t j = before[i]; j != no_twin; j = before[j]) {
      if (faces[j] != faces[i]) continue;
      twin[i] = j;
      twin[j] = static_cast<std::uint32_t>(i);
      break;
    }
  }
  return twin;
}

}  // namespace carom
