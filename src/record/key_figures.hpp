// What a run is summed up by beside its ledger: how its bodies flew, and their largest stress.
#pragma once

#include <vector>

#include "output/summary.hpp"
#include "record/curves.hpp"

namespace carom {

/// von Mises' equivalent stress of xx, yy, zz, xy, yz, zx.

/// Watches the steps of a run.
class KeyFigures {
 public:
  explicit KeyFigures(const Simulation& simulation);

  /// At the initial state and after every step. Velocities count from the first state that is not of statics. The
  /// stress is looked at in about 200 steps, at most every tenth of explicit schemes, whose step costs little more.
  void sample(const StepView& view, bool is_last);

  /// Mass and mean velocities of the parts; the mean is that of the cells' masses, each shared by its nodes evenly.
  std::vector<PartSummary> parts() const;
  StressSummary stress() const { return stress_; }

 private:
  template <class A>
  friend void fields(A& archive, KeyFigures& x) {
    archive("begin", x.begin_);
    archive("end", x.end_);
    archive("last_step", x.last_step_);
    archive("stress", x.stress_);
  }

  std::vector<Vec3> velocities(const std::vector<double>& v) const;
  void look_at_stress(const StepView& view);
  bool is_static(double t) const;

  const Simulation& simulation_;
  std::vector<Vec3> begin_, end_;  ///< velocities of the parts
  long long stress_every_;
  long long last_step_ = -1;
  StressSummary stress_;
};

}  // namespace carom
