// The exact solution of a case beside its curves.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exact/bar_impact.hpp"
#include "run/curves.hpp"

namespace carom {

/// Exact values of the columns that [exact] covers: displacement, velocity along the bar and axial stress of probes,
/// the force of the only contact, and kinetic, strain and contact_stored energy.
class ExactCurves {
 public:
  /// Throws CaseError when the case has no [exact] or its data make no sense.
  ExactCurves(const Simulation& simulation, const ProbeCurves& probes);

  /// The value of a column of probes.csv, contact.csv or energy.csv at time t; nothing when it is not covered.
  std::optional<double> value(const std::string& column, double t) const;
  /// All covered columns of the two tables, with `time` first.
  void sample(double t);
  const Table& table() const { return table_; }

 private:
  enum class Quantity : std::uint8_t { displacement, velocity, stress, force, kinetic, strain, contact_stored };
  struct Column {
    std::string name;
    Quantity quantity;
    double z = 0.0;
  };
  double evaluate(const Column& column, double t) const;

  BarImpact bar_;
  double initial_displacement_;
  std::vector<Column> columns_;
  Table table_;
};

}  // namespace carom
