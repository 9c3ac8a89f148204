#include "mesh/face_twins.hpp"

#include <algorithm>

namespace carom {

FaceKey face_key(std::span<const Index> corners) {
  FaceKey key;
  key.fill(no_index);
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

}  // namespace carom
