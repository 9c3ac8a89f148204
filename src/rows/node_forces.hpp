// Forces on few of many nodes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace carom {

/// A dof vector that is zero but on the nodes that something pushes, and takes memory for these alone.
class NodeForces {
 public:
  /// Makes the vector zero, with so many dofs.
  void clear(std::size_t dofs) {
    for (const Index n : nodes_) place_[static_cast<std::size_t>(n)] = nowhere;
    nodes_.clear();
    force_.clear();
    place_.resize(dofs / 3, nowhere);
  }
  void add(Index node, const Vec3& force) {
    Index& place = place_[static_cast<std::size_t>(node)];
    if (place == nowhere) {
      place = static_cast<Index>(nodes_.size());
      nodes_.push_back(node);
      force_.push_back({});
    }
    for (std::size_t c = 0; c < 3; ++c) force_[static_cast<std::size_t>(place)][c] += force[c];
  }

  std::size_t size() const { return 3 * place_.size(); }
  double operator[](std::size_t dof) const {
    const Index place = place_[dof / 3];
    return place == nowhere ? 0.0 : force_[static_cast<std::size_t>(place)][dof % 3];
  }
  Vec3 at(std::size_t node) const {
    const Index place = place_[node];
    return place == nowhere ? Vec3{} : force_[static_cast<std::size_t>(place)];
  }
  /// The vector with all its entries.
  std::vector<double> dense() const {
    std::vector<double> f(size());
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      std::copy(force_[k].begin(), force_[k].end(), f.begin() + 3 * static_cast<std::ptrdiff_t>(nodes_[k]));
    return f;
  }
  friend bool operator==(const NodeForces&, const NodeForces&) = default;

  template <class A>
  friend void fields(A& archive, NodeForces& x) {
    archive("place", x.place_);
    archive("nodes", x.nodes_);
    archive("force", x.force_);
  }

 private:
  static constexpr Index nowhere = -1;
  std::vector<Index> place_;  ///< by node: in nodes_, or nowhere
  std::vector<Index> nodes_;
  std::vector<Vec3> force_;
};

}  // namespace carom
