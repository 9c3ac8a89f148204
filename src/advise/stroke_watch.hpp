// What springs of contact take of a motion that is imposed in statics.
#pragma once

#include <optional>

#include "advise/locking.hpp"
#include "march/observer.hpp"

namespace carom {

/// Bodies that are pressed together by an imposed motion give way by less than that by the depth of the springs between
/// them, and the force is too small by as much. A depth of some percent of a cell, which is little in an impact, may be
/// a large part of the motion. Of forces that are imposed nothing is lost.
class StrokeWatch : public Observer {
 public:
  void see(const StepView& view) override;
  /// Where the deepest spring of the penalty was deeper than 2 % of the largest motion.
  std::optional<Doubt> doubt() const;

 private:
  template <class A>
  friend void fields(A& archive, StrokeWatch& x) {
    archive("depth", x.depth_);
    archive("motion", x.motion_);
  }

  double depth_ = 0.0, motion_ = 0.0;  ///< largest of static stages so far
};

}  // namespace carom
