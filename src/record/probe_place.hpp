// Where a probe of the case stands on the mesh.
#pragma once

#include <span>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/case.hpp"

namespace carom {

struct ProbePlace {
  std::vector<Index> nodes;
  double distance = 0.0;  ///< from the probe's point to its node; 0 for nodes and groups
};

/// Throws CaseError for nodes and groups that do not exist, for a node that no part holds, and for a point that is
/// farther from every node of the parts than the probe allows (CaseProbe::within; else the longest line through a cell
/// at the nearest node).
ProbePlace place_probe(const CaseProbe& given, const Simulation& simulation);

/// The direction across a section towards its cells on the given side: the part of `side` that is normal to the plane
/// (the line, where they have one) of the section's nodes; `side` itself where the nodes lie in no plane. Throws
/// CaseError where side lies in that plane: it would tell nothing, and cells would be chosen at random.
Vec3 across_section(const CaseProbe& given, std::span<const Index> nodes, const Mesh& mesh);

}  // namespace carom
