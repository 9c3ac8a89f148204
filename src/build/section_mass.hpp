// The mass that the cells on one side of a section give to its nodes.
#pragma once

#include <span>
#include <vector>

#include "solid/solid.hpp"

namespace carom {

struct NodeMass {
  Index node = -1;
  double mass = 0.0;
};

/// Cut free along a section, the cells on one side keep their share of the mass of the section's nodes: what pulls at
/// the cut bears its weight and accelerates it.
class SectionMass {
 public:
  SectionMass() = default;
  /// nodes: of the section; cells: positions in Solid::cells().
  SectionMass(const Solid& solid, std::span<const Index> nodes, std::span<const Index> cells);

  /// The force is the sum of mass times acceleration over these nodes. Of a lumped mass they are the section's; of a
  /// consistent one, all of its cells, with the integral of rho N n, N being the sum of the shape functions of the
  /// section's nodes and n that of the node.
  std::span<const NodeMass> of(MassKind kind) const { return kind == MassKind::lumped ? lumped_ : consistent_; }

 private:
  std::vector<NodeMass> lumped_, consistent_;
};

}  // namespace carom
