// The main function of every program of tests: each process writes its files in a folder of its own.

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

namespace {

namespace fs = std::filesystem;

/// A new folder for what the tests of this process write, where testing::TempDir() and temp_directory_path() point from
/// then on: cases that run side by side, in processes of their own, cannot write over each other's files.
fs::path own_folder() {
  std::string name = fs::temp_directory_path() / "carom_tests_XXXXXX";
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder can be made like " + name);
  setenv("TMPDIR", name.c_str(), 1);
  setenv("TEST_TMPDIR", name.c_str(), 1);
  return name;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (getenv("TEST_TMPDIR") != nullptr) return RUN_ALL_TESTS();  // a folder that the caller chose is kept
  const fs::path folder = own_folder();
  const int failed = RUN_ALL_TESTS();
  if (failed == 0)
    fs::remove_all(folder);
  else
    std::cerr << "The files of these tests are kept in " << folder.string() << '\n';
  return failed;
}
