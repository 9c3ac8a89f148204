#include "output/results_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/errors.hpp"
#include "base/terminal_text.hpp"
#include "output/frame_format.hpp"
#include "output/results_lock.hpp"

namespace carom::output_results_folder_test {
namespace {

namespace fs = std::filesystem;

class ResultsFolder : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(base_); }
  static void touch(const fs::path& path) { std::ofstream(path) << "x"; }

  fs::path base_ = fs::temp_directory_path() / fmt::format("carom_results_{}", ::getpid());
};

TEST_F(ResultsFolder, IsMadeWithItsParents) {
  prepare_results_folder((base_ / "a" / "b").string());
  EXPECT_TRUE(fs::is_directory(base_ / "a" / "b" / "fields"));
}

TEST_F(ResultsFolder, OnlyFilesOfAnEarlierRunAreRemoved) {
  prepare_results_folder(base_.string());
  const auto ours = {"summary.json", "energy.csv",          "contact.csv",        "probes.csv",
                     "exact.csv",    "probes_filtered.csv", "fields.pvd",         "case.resolved.toml",
                     "mesh.txt",     "summary.json.tmp",    "report.html",        "contact_filtered.csv",
                     "fields.xdmf",  "obstacles.xdmf",      "fields/mesh.vtkhdf", "fields/obstacles.vtkhdf.tmp"};
  const auto others = {"notes.txt",       "case.toml",       "fields/step_x.vtu",    "fields/step_000001.vtu.bak",
                       "fields/mine.vtu", "fields/mesh.vtu", "fields/my_mesh.vtkhdf"};
  for (const char* name : ours) touch(base_ / name);
  for (const char* name : others) touch(base_ / name);
  for (const FrameFormat& format : frame_formats()) touch(base_ / frame_file(format, 10));
  prepare_results_folder(base_.string());
  for (const char* name : ours) EXPECT_FALSE(fs::exists(base_ / name)) << name;
  for (const char* name : others) EXPECT_TRUE(fs::exists(base_ / name)) << name;
  for (const FrameFormat& format : frame_formats()) EXPECT_FALSE(fs::exists(base_ / frame_file(format, 10)));
}

TEST_F(ResultsFolder, AFileInItsPlaceIsAnError) {
  touch(base_);
  EXPECT_THROW(prepare_results_folder(base_.string()), OutputError);
}

TEST_F(ResultsFolder, UnwritableIsAnErrorThatNamesThePath) {
  // /proc takes no folders, not even from root.
  try {
    prepare_results_folder("/proc/carom");
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), "/proc/carom");
  }
}

TEST_F(ResultsFolder, IsHeldByOneRunAtATime) {
  const std::string folder = (base_ / "held").string();
  {
    const ResultsLock first(folder);
    EXPECT_THROW(ResultsLock{folder}, OutputError);
    EXPECT_NO_THROW(ResultsLock{(base_ / "other").string()});
  }
  EXPECT_NO_THROW(ResultsLock{folder});
  EXPECT_TRUE(fs::is_empty(folder));  // nothing is left that a crash could leave behind
}

TEST(TerminalText, HasNoControlCharacters) {
  EXPECT_EQ(terminal_text("a\tb\nc"), "a\tb\nc");
  EXPECT_EQ(terminal_text("\x1b[2Jx\r\x7f"), "\\x1b[2Jx\\x0d\\x7f");
  EXPECT_EQ(terminal_text("Stoß µ"), "Stoß µ");
  EXPECT_EQ(terminal_text("\xc2\x9b"
                          "31m"),
            "\\x9b31m");  // CSI of ISO 6429 in UTF-8
}

// RFC 3629: what is no UTF-8 is read as ISO 8859-1, whose bytes are the first 256 characters of Unicode.
TEST(TerminalText, KeepsTheLettersOfMessages) {
  EXPECT_EQ(as_utf8("Sto\xc3\x9f \xe2\x82\xac"), "Sto\xc3\x9f \xe2\x82\xac");
  EXPECT_EQ(as_utf8("Sto\xdf \xb5m\x95"), "Sto\xc3\x9f \xc2\xb5m?");
  EXPECT_EQ(as_utf8("a\x1b[2J"), "a?[2J");
  EXPECT_EQ(printable("F\xc3\x9cSSE"), "'F\xc3\x9cSSE'");
  EXPECT_EQ(printable("F\xdcSSE\x07\xc2\x9b"), "'F\\xdcSSE\\x07\\xc2\\x9b'");
  EXPECT_EQ(printable(std::string(39, 'a') + "\xc3\x9c"), "'" + std::string(39, 'a') + "...'");  // whole characters
}

TEST(TerminalText, ColoursTheWordsThatLinesBeginWith) {
  EXPECT_EQ(with_colours("good: 3 of 3\n2 steps\n"), "\x1b[1;32mgood:\x1b[0m 3 of 3\n2 steps\n");
  EXPECT_EQ(with_colours("a\nwarning: b: error: c"), "a\n\x1b[1;33mwarning:\x1b[0m b: error: c");
  EXPECT_EQ(with_colours("good, with doubts: d\n"), "\x1b[1;33mgood, with doubts:\x1b[0m d\n");
  EXPECT_EQ(with_colours("FAILED  overlap\n\n"), "\x1b[1;31mFAILED\x1b[0m  overlap\n\n");
  EXPECT_EQ(with_colours(""), "");
}

// Files, pipes, and terminals whose user does not want any.
TEST(TerminalText, ShowsNoColoursInFiles) {
  std::FILE* file = std::tmpfile();
  EXPECT_FALSE(shows_colours(file));
  print_to_terminal(file, "error: \x1b[2J");
  std::rewind(file);
  std::array<char, 32> read{};
  EXPECT_EQ(std::string(read.data(), std::fread(read.data(), 1, read.size(), file)), "error: \\x1b[2J");
  std::fclose(file);
}

}  // namespace
}  // namespace carom::output_results_folder_test
