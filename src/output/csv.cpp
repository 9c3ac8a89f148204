#include "output/csv.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <exception>
#include <iterator>
#include <utility>

#include "base/errors.hpp"
#include "output/file_writer.hpp"

namespace carom {

namespace {
constexpr std::chrono::milliseconds kFlushInterval{500};
constexpr std::size_t kRowBufferBytes = std::size_t{1} << 20;
}  // namespace

CsvFile::CsvFile(std::string path, const std::vector<std::string>& columns, const std::vector<std::string>& comments)
    : path_(std::move(path)), columns_(columns.size()), last_flush_(std::chrono::steady_clock::now()) {
  for (std::string comment : comments) {
    std::replace_if(
        comment.begin(), comment.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    fmt::format_to(std::back_inserter(buffer_), "# {}\n", comment);
  }
  fmt::format_to(std::back_inserter(buffer_), "{}\n", fmt::join(columns, ","));
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw OutputError(path_, std::strerror(errno));
}

CsvFile::CsvFile(std::string path, std::size_t columns, std::size_t bytes)
    : path_(std::move(path)), columns_(columns), written_(bytes), last_flush_(std::chrono::steady_clock::now()) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  const auto end = static_cast<off_t>(bytes);
  const bool is_open =
      descriptor_ >= 0 && ::ftruncate(descriptor_, end) == 0 && ::lseek(descriptor_, end, SEEK_SET) == end;
  if (is_open) return;
  const int reason = errno;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw OutputError(path_, std::strerror(reason));
}

CsvFile::CsvFile(CsvFile&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(other.columns_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      written_(other.written_),
      buffer_(std::exchange(other.buffer_, {})),
      last_flush_(other.last_flush_) {}

CsvFile::~CsvFile() {
  if (descriptor_ < 0) return;
  try {
    close();
  } catch (const OutputError&) {
    // reported by close() where the run ends in order
  }
}

void CsvFile::append(std::span<const double> row) {
  assert(row.size() == columns_);
  fmt::format_to(std::back_inserter(buffer_), "{}\n", fmt::join(row, ","));
  if (buffer_.size() > kRowBufferBytes || std::chrono::steady_clock::now() - last_flush_ > kFlushInterval) flush();
}

void CsvFile::flush() {
  last_flush_ = std::chrono::steady_clock::now();
  const std::size_t done = write_all(descriptor_, buffer_.data(), buffer_.size());
  if (done == buffer_.size()) {
    written_ += done;
    buffer_.clear();
    return;
  }
  const int reason = errno;
  const std::size_t end_of_row = buffer_.rfind('\n', done > 0 ? done - 1 : 0);
  const std::size_t kept = done > 0 && end_of_row != std::string::npos ? end_of_row + 1 : 0;
  // A full device may refuse this too; the error below is thrown either way.
  [[maybe_unused]] const int truncated = ::ftruncate(descriptor_, static_cast<off_t>(written_ + kept));
  buffer_.clear();
  throw OutputError(path_, std::strerror(reason));
}

std::size_t CsvFile::sync() {
  flush();
  if (::fsync(descriptor_) != 0 && errno != EINVAL) throw OutputError(path_, std::strerror(errno));  // EINVAL: a pipe
  return written_;
}

void CsvFile::close() {
  if (descriptor_ < 0) return;
  std::exception_ptr failure;
  try {
    flush();
  } catch (const OutputError&) {
    failure = std::current_exception();
  }
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (failure) std::rethrow_exception(failure);
  if (closed != 0) throw OutputError(path_, std::strerror(errno));
}

}  // namespace carom
