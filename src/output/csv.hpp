// Tables of numbers that grow row by row during a run.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carom {

/// A comma-separated table: comment lines (each after "# ", ends of line in them become spaces), one line of column
/// names, then rows. Numbers are written with the fewest digits that give the same double back. Only whole rows reach
/// the disk, at most half a second late, so an interrupted run leaves whole rows. Every failure to write is an
/// OutputError with the path and the reason.
class CsvFile {
 public:
  CsvFile(std::string path, const std::vector<std::string>& columns, const std::vector<std::string>& comments = {});
  /// Goes on with a table of so many columns after its first `bytes`; what follows them is cut off.
  CsvFile(std::string path, std::size_t columns, std::size_t bytes);
  ~CsvFile();
  CsvFile(CsvFile&& other) noexcept;
  CsvFile& operator=(CsvFile&&) = delete;
  CsvFile(const CsvFile&) = delete;
  CsvFile& operator=(const CsvFile&) = delete;

  /// Precondition: row.size() is the number of columns.
  void append(std::span<const double> row);
  /// Hands the buffered rows to the system.
  void flush();
  /// Bytes of all rows so far, which are on the disk then.
  std::size_t sync();
  /// Flushes and closes; call it at the end of the run, since the destructor cannot report an error.
  void close();

 private:
  std::string path_;
  std::size_t columns_ = 0;
  int descriptor_ = -1;
  std::size_t written_ = 0;  ///< bytes of whole rows on disk
  std::string buffer_;
  std::chrono::steady_clock::time_point last_flush_;
};

}  // namespace carom
