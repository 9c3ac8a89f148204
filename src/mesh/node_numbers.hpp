// From the numbers of nodes in a file to local indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// A table from file number to local index: an array where the numbers are dense, a hash table for the others.
class NodeNumbers {
 public:
  /// expected: about how many nodes will come; memory is at most 16 bytes for each, plus what is inserted.
  explicit NodeNumbers(std::size_t expected = 0) : dense_(4 * expected + 64, -1) {}

  /// False when the number is there already.
  bool insert(std::int64_t number, Index index) {
    if (number < 0 || static_cast<std::uint64_t>(number) >= dense_.size()) return sparse_.emplace(number, index).second;
    Index& slot = dense_[static_cast<std::size_t>(number)];
    if (slot >= 0) return false;
    slot = index;
    return true;
  }

  /// The local index, or -1.
  Index find(std::int64_t number) const {
    if (number >= 0 && static_cast<std::uint64_t>(number) < dense_.size())
      return dense_[static_cast<std::size_t>(number)];
    const auto found = sparse_.find(number);
    return found == sparse_.end() ? -1 : found->second;
  }

 private:
  std::vector<Index> dense_;
  std::unordered_map<std::int64_t, Index> sparse_;
};

}  // namespace carom
