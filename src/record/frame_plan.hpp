// How often the fields of a run are written, and what they take.
#pragma once

#include <string>

#include "build/simulation.hpp"
#include "output/frame_format.hpp"

namespace carom {

/// Of a frame, and of the mesh that all share; uncompressed, with the types that the recorder gives them.
struct FieldBytes {
  double frame = 0.0, mesh = 0.0;
};
FieldBytes field_bytes(const Simulation& simulation);

/// Into how many pieces frames of this size may cut a run so that they take no more than so many bytes: from 1 to 50,
/// with a frame at either end.
long long intervals_within(double bytes, double of_frame);

/// Steps between two frames of fields: those that the case says, or a 50th of the run, or more where frames so often
/// might take more than 2 GB of disk.
long long frame_interval(const Simulation& simulation);

/// Which frames of a run are due.
class FrameClock {
 public:
  explicit FrameClock(const Simulation& simulation) : simulation_(simulation), interval_(frame_interval(simulation)) {}
  /// The last frame that is due by step `step` at time t. Frame k is due at step k frame_interval where the case says
  /// how often; else at the time that this step has where every stage takes its usual step, so that a run whose steps
  /// are shortened has no more frames than one whose steps are not.
  long long due(long long step, double t) const;

 private:
  const Simulation& simulation_;
  long long interval_;
};

/// Says that there are fewer than 50 frames for the disk's sake; "" where there are not.
std::string frame_note(const Simulation& simulation);
/// The format that the case asks for.
const FrameFormat& frame_format(const Simulation& simulation);

}  // namespace carom
