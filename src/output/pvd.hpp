// The collection file (.pvd) that gives each .vtu its time.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace carom {

/// "fields/step_000010.vtu" for step 10: the frame's name relative to the results folder.
std::string frame_file(int step);

/// A .pvd file that grows frame by frame. Each add() replaces the whole file at once, so it is readable at any moment.
class PvdCollection {
 public:
  /// Writes an empty collection to `path`. Throws OutputError.
  explicit PvdCollection(std::string path);
  /// Adds a frame that is already on disk; `file` is relative to the collection's folder. Throws OutputError.
  void add(double time, const std::string& file);

 private:
  std::string path_;
  std::vector<std::pair<double, std::string>> frames_;
};

}  // namespace carom
