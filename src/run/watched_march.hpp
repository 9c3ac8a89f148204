// A march and those that watch it, as one value that a checkpoint holds.
#pragma once

#include <string>
#include <vector>

#include "advise/stroke_watch.hpp"
#include "march/fold_watch.hpp"
#include "march/march.hpp"
#include "march/overlap_watch.hpp"
#include "march/penetration_watch.hpp"
#include "march/rotation_watch.hpp"
#include "record/recorder.hpp"

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
    march.add(stroke);
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
    archive("stroke", x.stroke);
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
  StrokeWatch stroke;
  std::string case_file;                     ///< as the user named it
  std::vector<std::string> warnings, notes;  ///< of the case, before the first step
  std::vector<std::string> doubts;           ///< Summary::doubts
};

}  // namespace carom
