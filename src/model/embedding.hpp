// Nodes that follow rigid bodies.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "model/turning_body.hpp"

namespace carom {

/// Nodes of rigid bodies: each follows the four nodes of its body by weights that do not change,
///   u_n = sum over a of N_a u_a,  and so do v and a,
/// N_a those of TurningBody. They have no mass and no unknowns. A force on one is the forces N_a f on the four, of the
/// same resultant and, since x_n is the sum of N_a x_a at any time, of the same moment.
class Embedding {
 public:
  struct Follower {
    Index node = -1;
    Index body = -1;  ///< index in Model::turning_bodies
    std::array<Index, 4> carrier{-1, -1, -1, -1};
    std::array<double, 4> weight{};
  };

  /// Lets the nodes, none of which follows another body, follow this one, whose own nodes are known.
  void add(Index body, const TurningBody& of, std::span<const Index> nodes, std::span<const Vec3> coordinates);

  bool empty() const { return followers_.empty(); }
  const std::vector<Follower>& followers() const { return followers_; }
  /// Null where the node follows none.
  const Follower* find(Index node) const {
    const auto n = static_cast<std::size_t>(node);
    return n < place_.size() && place_[n] >= 0 ? &followers_[static_cast<std::size_t>(place_[n])] : nullptr;
  }
  /// Overwrites the entries of a dof vector (displacements, velocities, accelerations) at the followers.
  void spread(std::span<double> x) const;

 private:
  std::vector<Follower> followers_;
  std::vector<Index> place_;  ///< by node: where it stands among the followers, or -1
};

}  // namespace carom
