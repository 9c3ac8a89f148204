// A march and those that watch it, as one value that a checkpoint holds.
#pragma once

#include <string>
#include <vector>

#include "run/fold_watch.hpp"
#include "run/march.hpp"
#include "run/overlap_watch.hpp"
#include "run/penetration_watch.hpp"
#include "run/recorder.hpp"
#include "run/rotation_watch.hpp"

namespace carom {

/// Not movable, since the march refers to its observers.
struct WatchedMarch {
  /// Touches no file; folder: of the results, "" where none are written. Throws CaseError as Recorder does.
  WatchedMarch(const Simulation& simulation, const std::string& folder)
      : march(simulation),
        recorder(simulation, folder),
        penetration(simulation.model()),
        overlap(simulation, march.state()),
        rotation(simulation),
        folds(simulation) {
    march.add(recorder);
    march.add(penetration);
    march.add(overlap);
    march.add(rotation);
    march.add(folds);
  }
  WatchedMarch(const WatchedMarch&) = delete;
  WatchedMarch& operator=(const WatchedMarch&) = delete;

  template <class A>
  friend void fields(A& archive, WatchedMarch& x) {
    archive("march", x.march);
    archive("recorder", x.recorder);
    archive("penetration", x.penetration);
    archive("overlap", x.overlap);
    archive("rotation", x.rotation);
    archive("folds", x.folds);
    archive("case_file", x.case_file);
    archive("warnings", x.warnings);
    archive("doubts", x.doubts);
    archive("notes", x.notes);
  }

  March march;
  Recorder recorder;
  PenetrationWatch penetration;
  OverlapWatch overlap;
  RotationWatch rotation;
  FoldWatch folds;
  std::string case_file;                     ///< as the user named it
  std::vector<std::string> warnings, notes;  ///< of the case, before the first step
  std::vector<std::string> doubts;           ///< Summary::doubts
};

}  // namespace carom
