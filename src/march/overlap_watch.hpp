// Looks now and then whether bodies overlap, for the verdict.
#pragma once

#include <string>

#include "build/simulation.hpp"
#include "march/observer.hpp"
#include "output/summary.hpp"
#include "surface/body_overlap.hpp"
#include "surface/skin_motion.hpp"
#include "surface/surface_crossings.hpp"

namespace carom {

/// About fifty looks over the run, and one at its end, for nodes that are inside of cells and for surfaces that cross;
/// for the latter as many more as it takes that nothing passes between two looks (SkinMotion). Contact is judged by
/// what it has not prevented, whether it was defined or not.
class OverlapWatch : public Observer {
 public:
  explicit OverlapWatch(const Simulation& simulation, const State& start);

  void see(const StepView& view) override;
  /// "overlap": the deepest so far in cells, and where, when and between whom.
  VerdictItem item() const;

 private:
  template <class A>
  friend void fields(A& archive, OverlapWatch& x) {
    archive("next", x.next_);
    archive("worst", x.worst_);
    archive("time", x.time_);
    archive("crossing", x.crossing_);
    archive("crossing_time", x.crossing_time_);
    archive("motion", *x.motion_);
  }

  void follow(const State& state);
  void look_if_due(const StepView& view, bool is_regular);
  void look(const State& state, Folds folds);
  const Model& model() const { return topology_ ? topology_->model : simulation_.model(); }
  std::string names() const;
  std::string crossing_names() const;
  std::string remedy() const;

  const Simulation& simulation_;
  std::vector<double> q_start_;               ///< for those that look anew where cells have gone; empty where none goes
  std::shared_ptr<const Topology> topology_;  ///< that is looked at; null: all cells
  std::unique_ptr<BodyOverlap> overlap_;
  std::unique_ptr<SurfaceCrossings> surfaces_;
  std::unique_ptr<SkinMotion> motion_;
  double next_, every_;
  Overlap worst_;
  double time_ = 0.0;  ///< of the worst
  SurfaceCrossing crossing_;
  double crossing_time_ = 0.0;
};

}  // namespace carom
