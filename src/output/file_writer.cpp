#include "output/file_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "base/errors.hpp"

namespace carom {

namespace {
constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
}

std::size_t write_all(int descriptor, const char* data, std::size_t bytes) {
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t n = ::write(descriptor, data + done, bytes - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

FileWriter::FileWriter(std::string path) : path_(std::move(path)), temporary_(path_ + ".tmp") {
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw OutputError(path_, std::strerror(errno));
}

FileWriter::~FileWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void FileWriter::write(const void* data, std::size_t bytes) {
  const auto* text = static_cast<const char*>(data);
  if (buffer_.size() + bytes <= kBufferBytes) {
    buffer_.append(text, bytes);
    return;
  }
  flush();
  if (write_all(descriptor_, text, bytes) < bytes) throw OutputError(path_, std::strerror(errno));
}

void FileWriter::flush() {
  if (write_all(descriptor_, buffer_.data(), buffer_.size()) < buffer_.size()) {
    throw OutputError(path_, std::strerror(errno));
  }
  buffer_.clear();
}

void FileWriter::commit() {
  flush();
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (closed != 0) throw OutputError(path_, std::strerror(errno));
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw OutputError(path_, std::strerror(errno));
  temporary_.clear();
}

void write_file(const std::string& path, std::string_view text) {
  FileWriter file(path);
  file.write(text);
  file.commit();
}

}  // namespace carom
