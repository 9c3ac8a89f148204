// The checks of a case: its own test.
#pragma once

#include <optional>
#include <vector>

#include "output/summary.hpp"
#include "record/curves.hpp"
#include "record/exact_curves.hpp"

namespace carom {

/// Watches the columns that the checks name; a value between two samples is interpolated linearly.
class Checks {
 public:
  /// Throws CaseError where a check names something that no table holds, or an exact value that [exact] does not cover.
  Checks(const Simulation& simulation, const std::vector<const CurveTable*>& tables, const ExactCurves* exact);

  /// Is t, with steps of at most dt, one of the two samples around the time of a check?
  bool is_due(double t, double dt) const;
  /// To be called after the tables have been sampled.
  void sample(double t);
  /// Results so far; a check whose time has not been reached fails with a value of NaN.
  std::vector<CheckSummary> results() const;

 private:
  struct Watch {
    const CurveTable* table = nullptr;
    std::size_t column = 0;
    std::string name;
    double time = 0.0;
    double reference = 0.0;
    double last_time = 0.0, last_value = 0.0;
    std::optional<double> value;
    /// What a run changes of it.
    template <class A>
    friend void fields(A& archive, Watch& x) {
      archive("last_time", x.last_time);
      archive("last_value", x.last_value);
      archive("value", x.value);
    }
  };
  template <class A>
  friend void fields(A& archive, Checks& x) {
    archive.each("watches", x.watches_);
  }
  Watch watch(const CaseCheck& check, const std::vector<const CurveTable*>& tables, const ExactCurves* exact) const;

  const Case& case_;
  std::vector<Watch> watches_;
};

}  // namespace carom
