// What watches every run, whether it leaves results or not.
#pragma once

#include "march/artificial_energy_watch.hpp"
#include "march/fold_watch.hpp"
#include "march/march.hpp"
#include "march/overlap_watch.hpp"
#include "march/penetration_watch.hpp"
#include "march/rotation_watch.hpp"

namespace carom {

/// Some of them stop the run. The simulation outlives them.
struct Watches {
  Watches(const Simulation& simulation, const March& march)
      : penetration(simulation.model()),
        overlap(simulation, march.state()),
        rotation(simulation),
        folds(simulation),
        artificial(simulation) {}

  /// They outlive the march.
  void look_at(March& march) {
    march.add(penetration);
    march.add(overlap);
    march.add(rotation);
    march.add(folds);
    march.add(artificial);
  }

  template <class A>
  friend void fields(A& archive, Watches& x) {
    archive("penetration", x.penetration);
    archive("overlap", x.overlap);
    archive("rotation", x.rotation);
    archive("folds", x.folds);
    archive("artificial", x.artificial);
  }

  PenetrationWatch penetration;
  OverlapWatch overlap;
  RotationWatch rotation;
  FoldWatch folds;
  ArtificialEnergyWatch artificial;
};

}  // namespace carom
