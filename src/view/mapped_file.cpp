#include "view/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace carom {

MappedFile::MappedFile(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);  // NOLINT(cppcoreguidelines-pro-type-vararg): POSIX
  if (file < 0) throw std::system_error(errno, std::generic_category(), "cannot read " + path);
  struct stat status {};
  const bool is_known = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  if (is_known && status.st_size > 0) {
    size_ = static_cast<std::size_t>(status.st_size);
    void* const start = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
    if (start != MAP_FAILED) data_ = static_cast<const std::byte*>(start);  // NOLINT: MAP_FAILED is POSIX' cast
  }
  ::close(file);
  if (data_ == nullptr) throw std::runtime_error("cannot read " + path + ": it is empty or no file");
}

MappedFile::~MappedFile() {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): as POSIX declares it
  ::munmap(const_cast<std::byte*>(data_), size_);
}

}  // namespace carom
