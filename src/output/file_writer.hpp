// A file that appears under its name only when it is complete.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carom {

/// Writes to <path>.tmp; commit() gives it its name in one step. Without commit() the temporary file is removed.
/// Every failure is an OutputError with the path and the system's reason.
class FileWriter {
 public:
  explicit FileWriter(std::string path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Small pieces are collected, large ones go straight to the system.
  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void commit();

 private:
  void flush();

  std::string path_, temporary_;
  int descriptor_ = -1;
  std::string buffer_;
};

/// Replaces the file at `path` by `text` in one step.
void write_file(const std::string& path, std::string_view text);

/// write(2) until everything is written. Returns the bytes written: fewer than `bytes` means failure, errno tells why.
std::size_t write_all(int descriptor, const char* data, std::size_t bytes);

}  // namespace carom
