// A file seen as memory.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace carom {

/// The bytes of a file, read from the disk as they are looked at. The file must not be shortened meanwhile; files of a
/// results folder are replaced whole. Throws std::runtime_error when it cannot be read.
class MappedFile {
 public:
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {data_, size_}; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace carom
