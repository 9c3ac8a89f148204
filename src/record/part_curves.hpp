// parts.csv: energies and momentum of every part.
#pragma once

#include <vector>

#include "build/simulation.hpp"
#include "march/observer.hpp"
#include "parallel/group_sums.hpp"
#include "record/curve_table.hpp"

namespace carom {

/// Of each part in the order of the case: kinetic_energy, the energies that the case can have beside it, momentum, by
/// the names of output/quantities.hpp. Over all parts and what belongs to none (springs, ties that tear, the axes of
/// rigid bodies, obstacles that move) they add up to the ledger. A node's momentum and kinetic energy 1/2 v.(M v), M
/// the mass of the stage, are divided among its parts as node_shares says.
class PartCurves {
 public:
  explicit PartCurves(const Simulation& simulation);
  /// On several ranks, all call it. Looks at the nodes once.
  void sample(const StepView& view);
  const CurveTable& table() const { return table_; }

 private:
  GroupSums nodes_;
  std::vector<double EnergyTerms::*> terms_;  ///< of the columns beside kinetic_energy
  CurveTable table_;
};

}  // namespace carom
