#include "output/csv.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.hpp"
#include "output/file_writer.hpp"

namespace carom::output_csv_test {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

fs::path scratch(const std::string& name) {
  return fs::temp_directory_path() / fmt::format("carom_{}_{}", ::getpid(), name);
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Csv, HeaderCommentsAndRows) {
  const fs::path path = scratch("a.csv");
  CsvFile file(path.string(), {"time", "B.displacement_z"}, {"units: m, s, kg, N, Pa, J", "second\nline"});
  file.append(std::vector{0.0, 0.002});
  file.append(std::vector{1e-5, -1.5});
  file.close();
  EXPECT_EQ(read_text(path),
            "# units: m, s, kg, N, Pa, J\n# second line\ntime,B.displacement_z\n0,0.002\n1e-05,-1.5\n");
  fs::remove(path);
}

TEST(Csv, NumbersComeBackBitForBit) {
  const fs::path path = scratch("bits.csv");
  const std::vector<double> row{0.1, 1.0 / 3.0, std::nextafter(1.0, 2.0), std::numeric_limits<double>::denorm_min(),
                                -std::numeric_limits<double>::max()};
  CsvFile file(path.string(), {"a", "b", "c", "d", "e"});
  file.append(row);
  file.close();
  std::istringstream lines(read_text(path));
  std::string line, cell;
  std::getline(lines, line);
  std::getline(lines, line);
  std::istringstream cells(line);
  for (const double expected : row) {
    ASSERT_TRUE(std::getline(cells, cell, ','));
    EXPECT_EQ(std::strtod(cell.c_str(), nullptr), expected);
  }
  fs::remove(path);
}

TEST(Csv, RowsReachTheDiskWhileTheRunGoesOn) {
  const fs::path path = scratch("live.csv");
  CsvFile file(path.string(), {"time"});
  file.append(std::vector{1.0});
  std::this_thread::sleep_for(std::chrono::milliseconds(550));  // longer than the flush interval of 500 ms
  file.append(std::vector{2.0});
  EXPECT_EQ(read_text(path), "time\n1\n2\n");
  fs::remove(path);
}

TEST(Csv, DestructorWritesWhatIsLeft) {
  const fs::path path = scratch("left.csv");
  { CsvFile(path.string(), {"time"}).append(std::vector{1.0}); }
  EXPECT_EQ(read_text(path), "time\n1\n");
  fs::remove(path);
}

TEST(Csv, FullDeviceIsAnErrorThatNamesThePath) {
  // Writing to /dev/full gives ENOSPC (man 4 full).
  CsvFile file("/dev/full", {"time"});
  file.append(std::vector{1.0});
  EXPECT_EQ(message_of([&] { file.close(); }), "cannot write /dev/full: No space left on device");
}

TEST(Csv, UnwritablePathIsAnErrorThatNamesIt) {
  EXPECT_EQ(message_of([] { CsvFile("/proc/absent/a.csv", {"time"}); }),
            "cannot write /proc/absent/a.csv: No such file or directory");
  EXPECT_EQ(message_of([] { CsvFile("/", {"time"}); }), "cannot write /: Is a directory");
}

/// Limits the size of files for one scope: the disk is full after `bytes` (write gives EFBIG, man 2 setrlimit).
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(Csv, DiskThatFillsUpLeavesWholeRows) {
  const fs::path path = scratch("filling.csv");
  CsvFile file(path.string(), {"time", "value"});
  std::string message;
  {
    const FileSizeLimit limit(1000);  // in the middle of a row
    for (int i = 0; i < 500; ++i) file.append(std::vector{1.25, 2.5});
    message = message_of([&] { file.close(); });
  }
  EXPECT_EQ(message, fmt::format("cannot write {}: {}", path.string(), std::strerror(EFBIG)));
  const std::string text = read_text(path);
  EXPECT_TRUE(text.ends_with("\n1.25,2.5\n"));
  // 1000 - 11 = 989 bytes hold 109 rows of 9 bytes.
  EXPECT_EQ(text.size(), 11U + 109U * 9U);
  fs::remove(path);
}

TEST(FileWriter, WithoutCommitNothingAppears) {
  const fs::path path = scratch("never");
  { FileWriter(path.string()).write("half a file"); }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(fs::exists(path.string() + ".tmp"));
}

TEST(FileWriter, FullDiskKeepsTheOldFile) {
  const fs::path path = scratch("kept");
  write_file(path.string(), "old");
  const std::string large(1 << 20, 'x');
  std::string message;
  {
    const FileSizeLimit limit(1000);
    message = message_of([&] { write_file(path.string(), large); });
  }
  EXPECT_EQ(message, fmt::format("cannot write {}: {}", path.string(), std::strerror(EFBIG)));
  EXPECT_EQ(read_text(path), "old");
  EXPECT_FALSE(fs::exists(path.string() + ".tmp"));
  fs::remove(path);
}

}  // namespace
}  // namespace carom::output_csv_test
