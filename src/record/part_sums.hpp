// What there is of one part: mass, momentum, energies, the largest and smallest values of its cells.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "build/simulation.hpp"
#include "casefile/case.hpp"
#include "march/observer.hpp"
#include "record/curve_table.hpp"
#include "record/field_values.hpp"

namespace carom {

/// Momentum and energies are those of parts.csv (PartCurves).
class PartSums {
 public:
  PartSums() = default;
  /// Of CaseProbe::part, which is one of the case. parts: the table of parts.csv, which stays where it is. Throws
  /// CaseError for one of several parts of a rigid body, for energies that nothing in the case has, and for extremes of
  /// what a part does not have.
  PartSums(const CaseProbe& given, const Simulation& simulation, const CurveTable& parts);

  /// Where it is in the mesh file: the mean of its cells, by volume, of the means of their nodes.
  const Vec3& centre() const { return centre_; }

  /// Appends the components of a quantity of parts (output/quantities.hpp).
  void append(std::string_view quantity, FieldsNow& now, std::vector<double>& row) const;
  /// Positions in Solid::cells().
  const std::vector<Index>& cells() const { return cells_; }
  /// A quantity of parts that every rank knows without being told of the nodes and points of others.
  static bool is_known_to_all(std::string_view quantity);

 private:
  void find_columns(const CaseProbe& given);
  void find_centre();
  void refuse_extremes(const CaseProbe& given) const;

  const Simulation* simulation_ = nullptr;
  const CurveTable* parts_ = nullptr;
  std::vector<Index> cells_;                                              ///< positions in Solid::cells()
  std::map<std::string, std::vector<std::size_t>, std::less<>> columns_;  ///< of parts.csv, by quantity
  double mass_ = 0.0;
  bool is_rigid_ = false;
  Vec3 centre_{};
};

}  // namespace carom
