// The exact solution of a case beside its curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exact/solution.hpp"
#include "record/curves.hpp"

namespace carom {

/// Exact values of the columns that [exact] covers: displacement, velocity along the axis and axial stress of probes,
/// the force of the only contact along the axis, and energies.
class ExactCurves {
 public:
  /// Throws CaseError when the data of [exact] make no sense for the case.
  ExactCurves(const Simulation& simulation, const ProbeCurves& probes);

  /// The value of a column of probes.csv, contact.csv or energy.csv at time t; nothing when it is not covered.
  std::optional<double> value(const std::string& column, double t) const;
  /// All covered columns of the tables, with `time` first.
  void sample(double t);
  const CurveTable& table() const { return table_; }

  struct Column {
    std::string name;
    ExactCurve value;
  };

 private:
  std::vector<Column> columns_;
  CurveTable table_;
};

}  // namespace carom
