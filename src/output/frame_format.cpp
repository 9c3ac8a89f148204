#include "output/frame_format.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "base/errors.hpp"
#include "output/file_writer.hpp"

namespace carom {

namespace {

/// Replaces what follows `place` in one call of the system: a killed program leaves the old end or the new one.
void write_end(const std::string& path, std::size_t place, const std::string& text) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor < 0) throw OutputError(path, std::strerror(errno));
  const ssize_t written = ::pwrite(descriptor, text.data(), text.size(), static_cast<off_t>(place));
  const int reason = written < 0 ? errno : ENOSPC;
  const bool is_closed = ::close(descriptor) == 0;
  if (written != static_cast<ssize_t>(text.size()) || !is_closed) throw OutputError(path, std::strerror(reason));
}

}  // namespace

std::span<const FrameFormat> frame_formats() {
  static const std::array<FrameFormat, 2> formats{xdmf_format(), vtu_format()};
  return formats;
}

std::string frame_file(const FrameFormat& format, long long step) {
  return fmt::format("fields/step_{:06}{}", step, format.end);
}

std::string obstacles_file(const FrameFormat& format, long long step) {
  return fmt::format("fields/obstacles_{:06}{}", step, format.end);
}

FrameIndex::FrameIndex(std::string folder, const FrameFormat& format, std::vector<FrameEntry> frames)
    : folder_(std::move(folder)), format_(format), frames_(std::move(frames)), ends_(format.indices.size()) {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const IndexFile& index = format.indices[i];
    std::string text(index.head);
    for (const FrameEntry& frame : frames_) text += index.entry(folder_, frame);
    if (i > 0 && text.size() == index.head.size()) continue;  // no obstacles
    ends_[i] = text.size();
    write_file(fmt::format("{}/{}", folder_, index.name), text.append(index.tail));
  }
}

void FrameIndex::add(FrameEntry frame) {
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    const IndexFile& index = format_.indices[i];
    const std::string path = fmt::format("{}/{}", folder_, index.name), entry = index.entry(folder_, frame);
    if (entry.empty()) continue;
    if (ends_[i] == 0) {
      ends_[i] = index.head.size();
      write_file(path, fmt::format("{}{}", index.head, index.tail));
    }
    write_end(path, ends_[i], fmt::format("{}{}", entry, index.tail));
    ends_[i] += entry.size();
  }
  frames_.push_back(std::move(frame));
}

}  // namespace carom
