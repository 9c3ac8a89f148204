// What there is of one part: mass, momentum, kinetic and strain energy, the largest and smallest values of its cells.
#pragma once

#include <map>
#include <string_view>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/case.hpp"
#include "march/observer.hpp"
#include "record/field_values.hpp"

namespace carom {

/// Momentum and kinetic energy are those of the cells' mass, consistent or lumped as the stage's is, so that they add
/// up with those of the other parts; a rigid part has those of its body.
class PartSums {
 public:
  PartSums() = default;
  /// Of CaseProbe::part, which is one of the case. Throws CaseError for one of several parts of a rigid body, for the
  /// strain energy of nodal parts, whose cells have none of their own, and for extremes of what a part does not have.
  PartSums(const CaseProbe& given, const Simulation& simulation);

  /// Where it is in the mesh file: the mean of its cells, by volume, of the means of their nodes.
  const Vec3& centre() const { return centre_; }

  /// Appends the components of a quantity of parts (output/quantities.hpp).
  void append(std::string_view quantity, FieldsNow& now, std::vector<double>& row) const;
  /// Positions in Solid::cells().
  const std::vector<Index>& cells() const { return cells_; }

 private:
  const Mass& mass(const StepView& view) const { return masses_.at(view.stage.mass().kind()); }
  void find_centre();
  void refuse_extremes(const CaseProbe& given) const;
  double strain_energy(const StepView& view) const;

  const Simulation* simulation_ = nullptr;
  std::vector<Index> cells_;  ///< positions in Solid::cells()
  bool is_rigid_ = false;
  Vec3 centre_{};
  std::map<MassKind, Mass> masses_;
};

}  // namespace carom
