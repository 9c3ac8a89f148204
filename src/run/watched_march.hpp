// A march and those that watch it, as one value that a checkpoint holds.
#pragma once

#include <string>
#include <vector>

#include "advise/law_depth_watch.hpp"
#include "advise/stroke_watch.hpp"
#include "march/march.hpp"
#include "march/watches.hpp"
#include "record/recorder.hpp"

namespace carom {

/// Not movable, since the march refers to its observers.
struct WatchedMarch {
  /// Touches no file; folder: of the results, "" where none are written. Throws CaseError as Recorder does.
  WatchedMarch(const Simulation& simulation, const std::string& folder)
      : march(simulation), recorder(simulation, folder), watches(simulation, march) {
    march.add(recorder);
    watches.look_at(march);
    march.add(stroke);
    march.add(law_depth);
  }
  WatchedMarch(const WatchedMarch&) = delete;
  WatchedMarch& operator=(const WatchedMarch&) = delete;

  template <class A>
  friend void fields(A& archive, WatchedMarch& x) {
    archive("march", x.march);
    archive("recorder", x.recorder);
    fields(archive, x.watches);
    archive("stroke", x.stroke);
    archive("law_depth", x.law_depth);
    archive("case_file", x.case_file);
    archive("warnings", x.warnings);
    archive("doubts", x.doubts);
    archive("notes", x.notes);
  }

  March march;
  Recorder recorder;
  Watches watches;
  StrokeWatch stroke;
  LawDepthWatch law_depth;
  std::string case_file;                     ///< as the user named it
  std::vector<std::string> warnings, notes;  ///< of the case, before the first step
  std::vector<std::string> doubts;           ///< Summary::doubts
};

}  // namespace carom
