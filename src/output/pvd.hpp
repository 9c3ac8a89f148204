// The collection file (.pvd) that gives each .vtu its time.
#pragma once

#include <string>
#include <vector>

namespace carom {

/// "fields/step_000010.vtu" for step 10: the frame's name relative to the results folder.
std::string frame_file(int step);

struct PvdFrame {
  double time = 0.0;
  std::string file, obstacles;
};

template <class A>
void fields(A& archive, PvdFrame& x) {
  archive("time", x.time);
  archive("file", x.file);
  archive("obstacles", x.obstacles);
}

/// A .pvd file that grows frame by frame. Each add() replaces the whole file at once, so it is readable at any moment.
class PvdCollection {
 public:
  /// Writes a collection of these frames to `path`. Throws OutputError.
  explicit PvdCollection(std::string path, std::vector<PvdFrame> frames = {});
  /// Adds a frame that is already on disk; files are relative to the collection's folder. `obstacles` stands beside the
  /// bodies as a part of its own; "" when there are none. Throws OutputError.
  void add(double time, const std::string& file, const std::string& obstacles = "");
  const std::vector<PvdFrame>& frames() const { return frames_; }

 private:
  std::string path_;
  std::vector<PvdFrame> frames_;
};

}  // namespace carom
