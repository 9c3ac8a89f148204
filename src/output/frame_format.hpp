// The formats of frames: a row of the table each.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "output/frame.hpp"

namespace carom {

/// Writes the frames of one body, bodies or obstacles, into a results folder.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// file: relative to the folder. The file appears under its name only when it is complete. Throws OutputError.
  virtual void write(const std::string& file, const FieldFrame& frame) = 0;
};

/// A frame that is on disk; files are relative to the results folder, obstacles "" when there are none.
struct FrameEntry {
  double time = 0.0;
  std::string file, obstacles;
};

template <class A>
void fields(A& archive, FrameEntry& x) {
  archive("time", x.time);
  archive("file", x.file);
  archive("obstacles", x.obstacles);
}

/// A text file that names the frames and their times: the same head and tail, and between them an entry for each frame,
/// which may be "".
struct IndexFile {
  std::string_view name, head, tail;
  std::string (*entry)(const std::string& folder, const FrameEntry& frame) = nullptr;
};

struct FrameFormat {
  std::string_view name;                 ///< in case files: output.format
  std::string_view end;                  ///< of the names of frames
  std::span<const IndexFile> indices{};  ///< the first is what one opens
  bool shares_mesh = false;              ///< the mesh is in a file of its own, fields/<body> + end
  /// Writes the mesh where frames share it. Throws OutputError.
  std::unique_ptr<FrameWriter> (*make_writer)(const std::string& folder, std::string_view body, FrameMesh mesh){};
};

/// In the order of the choices of output.format.
std::span<const FrameFormat> frame_formats();

/// The two bodies that are written.
constexpr std::string_view bodies_mesh = "mesh", obstacles_mesh = "obstacles";

/// "fields/step_000010.vtu" for step 10, "fields/obstacles_000010.vtu".
std::string frame_file(const FrameFormat& format, long long step);
std::string obstacles_file(const FrameFormat& format, long long step);

/// The index of the frames of a folder, which grows frame by frame and is readable at any moment.
class FrameIndex {
 public:
  /// Writes an index of these frames. Throws OutputError.
  FrameIndex(std::string folder, const FrameFormat& format, std::vector<FrameEntry> frames = {});
  /// Adds a frame that is already on disk. Throws OutputError.
  void add(FrameEntry frame);
  const std::vector<FrameEntry>& frames() const { return frames_; }

 private:
  std::string folder_;
  FrameFormat format_;
  std::vector<FrameEntry> frames_;
  std::vector<std::size_t> ends_;  ///< by index file: where its tail begins; 0: there is no such file
};

/// The rows.
FrameFormat xdmf_format();
FrameFormat vtu_format();

}  // namespace carom
