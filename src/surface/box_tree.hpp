// A tree of axis-parallel boxes: which of many boxes overlap a given one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// Axis-parallel box; empty as it is made.
struct Bounds {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void include(const Vec3& x);
  void include(const Bounds& box);
  void grow(double distance);
  bool overlaps(const Bounds& box) const;  ///< closed boxes: touching counts
  bool contains(const Vec3& x) const;
};

/// Binary tree that halves its boxes at the median of their centres along the longest side, down to a few per leaf. Its
/// depth is log2 n whatever the sizes of the boxes and their distances are; it is built in O(n log n) on average.
class BoxTree {
 public:
  /// Boxes with finite corners, numbered as given. The storage of an earlier build is used again.
  void build(std::span<const Bounds> boxes);

  /// The boxes have moved: the same tree about them, in O(n). What is found is the same as after a build; it is found
  /// as fast while neighbours stay neighbours. As many boxes as were built.
  void refit(std::span<const Bounds> boxes);

  /// Appends the numbers of all boxes that overlap `box`, in no particular order.
  void find(const Bounds& box, std::vector<Index>& found) const;

 private:
  struct Node {
    Bounds box;
    Index begin, end;  ///< its boxes, in order_
    Index right;       ///< number of the second child, the first one follows its parent; 0 for a leaf
  };
  void split(Index begin, Index end);

  std::vector<Bounds> boxes_;  ///< in the tree's order
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace carom
