// What the energies of a step are compared with, by whoever judges its length.
#pragma once

#include <optional>
#include <vector>

#include "build/stage.hpp"
#include "model/model.hpp"

namespace carom {

/// The largest mechanical energy so far, as those see it that bodies may meet: the kinetic energy in the frame of
/// their supports (along an axis that nothing is held along, in that of their centre of mass, doubled: one of two equal
/// bodies sees the other come with that), or of an obstacle (of a plane along its normal). So a velocity that all have
/// in common changes no step, and where an obstacle comes to bodies at rest the steps are those of bodies that come to
/// it.
class StepScale {
 public:
  /// least: what no energy can be told from rounding below.
  StepScale(const Model& model, const Stage& stage, double least);

  /// At a state that the run has come to.
  void follow(const State& state);
  /// Of a step to `end`, which has to hold yet: loads that are put on at once supply it within the step. friction: what
  /// it has taken so far. Sliding feeds vibrations with as much; explicit steps, which are short enough to follow those
  /// of the springs, count it. Implicit ones that do not follow them would gain all the more where the sliding has fed
  /// them.
  double of_step_to(const State& end, double friction) const;
  /// What a step from the last state that has been followed takes out by the scheme, in the frame of the supports.
  double algorithmic(const LedgerIncrement& step) const;

 private:
  template <class A>
  friend void fields(A& archive, StepScale& x) {
    archive("largest", x.largest_);
    archive("frame", x.frame_);
  }
  double seen(const State& state) const;
  Vec3 of_supports(const State& state) const;

  struct Obstacle {
    Index carrier;               ///< -1: at rest
    std::optional<Vec3> normal;  ///< of a plane
  };
  std::vector<Obstacle> obstacles_;  ///< of obstacles; -1: one at rest
  std::vector<std::size_t> held_;    ///< dofs with mass that supports lead
  bool is_free_ = false;             ///< nothing is held along some axis
  bool is_explicit_;
  double mass_ = 0.0;  ///< of all bodies
  double least_, largest_ = 0.0;
  Vec3 frame_{};  ///< velocity of the supports at the state that was followed
};

}  // namespace carom
