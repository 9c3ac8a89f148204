#include "surface/box_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace carom {

void Bounds::include(const Vec3& x) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], x[i]);
    high[i] = std::max(high[i], x[i]);
  }
}

void Bounds::include(const Bounds& box) {
  include(box.low);
  include(box.high);
}

void Bounds::grow(double distance) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] -= distance;
    high[i] += distance;
  }
}

bool Bounds::overlaps(const Bounds& box) const {
  return low[0] <= box.high[0] && box.low[0] <= high[0] && low[1] <= box.high[1] && box.low[1] <= high[1] &&
         low[2] <= box.high[2] && box.low[2] <= high[2];
}

bool Bounds::contains(const Vec3& x) const {
  return low[0] <= x[0] && x[0] <= high[0] && low[1] <= x[1] && x[1] <= high[1] && low[2] <= x[2] && x[2] <= high[2];
}

void BoxTree::build(std::span<const Bounds> boxes) {
  boxes_.assign(boxes.begin(), boxes.end());
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), Index{0});
  nodes_.clear();
  if (boxes.empty()) return;
  split(0, static_cast<Index>(boxes.size()));
  for (std::size_t k = 0; k < order_.size(); ++k) boxes_[k] = boxes[order_[k]];
}

void BoxTree::refit(std::span<const Bounds> boxes) {
  for (std::size_t k = 0; k < order_.size(); ++k) boxes_[k] = boxes[order_[k]];
  for (std::size_t self = nodes_.size(); self-- > 0;) {  // children follow their parents
    Node& node = nodes_[self];
    node.box = Bounds{};
    if (node.right == 0) {
      for (Index k = node.begin; k < node.end; ++k) node.box.include(boxes_[k]);
    } else {
      node.box.include(nodes_[self + 1].box);
      node.box.include(nodes_[node.right].box);
    }
  }
}

void BoxTree::split(Index begin, Index end) {
  constexpr Index leaf_size = 4;
  const std::size_t self = nodes_.size();
  nodes_.push_back({{}, begin, end, 0});
  Bounds box, centres;  // twice the centres
  for (Index k = begin; k < end; ++k) {
    const Bounds& b = boxes_[order_[k]];
    box.include(b);
    centres.include(Vec3{b.low[0] + b.high[0], b.low[1] + b.high[1], b.low[2] + b.high[2]});
  }
  nodes_[self].box = box;
  if (end - begin <= leaf_size) return;
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (centres.high[i] - centres.low[i] > centres.high[axis] - centres.low[axis]) axis = i;
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](Index a, Index b) {
    const double c_a = boxes_[a].low[axis] + boxes_[a].high[axis], c_b = boxes_[b].low[axis] + boxes_[b].high[axis];
    return c_a < c_b || (c_a == c_b && a < b);
  });
  split(begin, middle);
  nodes_[self].right = static_cast<Index>(nodes_.size());
  split(middle, end);
}

void BoxTree::find(const Bounds& box, std::vector<Index>& found) const {
  if (nodes_.empty()) return;
  std::array<Index, 64> stack;  // at most one waiting node per level, and 2^31 boxes make 31 levels
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const Index self = stack[--waiting];
    const Node& node = nodes_[self];
    if (!node.box.overlaps(box)) continue;
    if (node.right != 0) {
      stack[waiting++] = node.right;
      stack[waiting++] = self + 1;
      continue;
    }
    for (Index k = node.begin; k < node.end; ++k)
      if (boxes_[k].overlaps(box)) found.push_back(order_[k]);
  }
}

}  // namespace carom
