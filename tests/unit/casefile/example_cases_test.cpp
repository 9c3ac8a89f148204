// Cases that come with the program, as beginnings of others.
#include "casefile/example_cases.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "casefile/read_case.hpp"

namespace carom::casefile_example_cases_test {
namespace {

namespace fs = std::filesystem;

class ExampleCases : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  static std::string content(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  const std::string examples_ = CAROM_SOURCE_DIR;
  const fs::path folder_ = fs::temp_directory_path() / ("carom_examples_" + std::to_string(::getpid()));
};

// Each can be read where it was written, and its mesh, or what makes it, stands beside it.
TEST_F(ExampleCases, AllOfThemBeginACase) {
  const std::vector<std::string> names = example_names(examples_);
  for (const char* name : {"taylor_bar/rigid_wall", "sdnv100/plain/b", "tutorial/phone"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const fs::path own = folder_ / std::to_string(i);
    const BegunCase begun = begin_case(examples_, names[i], own.string());
    EXPECT_EQ(begun.case_file, own / (std::to_string(i) + ".toml"));
    const Case given = read_case(begun.case_file);
    const std::string& mesh = *given.mesh.file;
    if (mesh.empty()) {
      EXPECT_EQ(begun.other_file, "") << names[i];
      continue;
    }
    EXPECT_TRUE(fs::exists(begun.other_file)) << names[i];
    if (begun.command.empty())
      EXPECT_EQ(begun.other_file, own / mesh) << names[i];
    else
      EXPECT_EQ(begun.command, "gmsh -3 " + begun.other_file + " -o " + (own / mesh).string()) << names[i];
  }
}

// Comments and all; a mesh that stood elsewhere is beside it now.
TEST_F(ExampleCases, AreWhatTheyWereButForThePlaceOfTheMesh) {
  begin_case(examples_, "roller/strip", (folder_ / "strip/").string());
  EXPECT_EQ(content(folder_ / "strip/strip.toml"), content(examples_ + "/cases/roller/strip.toml"));
  begin_case(examples_, "sdnv100/plain/b", (folder_ / "b").string());
  std::string text = content(folder_ / "b/b.toml");
  const std::string now = "\"sdnv100a.med\"", before = "\"../meshes/sdnv100a.med\"";
  ASSERT_NE(text.find(now), std::string::npos);
  EXPECT_EQ(text.replace(text.find(now), now.size(), before), content(examples_ + "/cases/sdnv100/plain/b.toml"));
  EXPECT_EQ(content(folder_ / "b/sdnv100a.med"), content(examples_ + "/cases/sdnv100/meshes/sdnv100a.med"));
}

TEST_F(ExampleCases, RefuseNamesThatAreNone) {
  try {
    begin_case(examples_, "taylor_bar/rigid_walls", folder_.string());
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_EQ(error.found(), "\"taylor_bar/rigid_walls\"");
    EXPECT_EQ(error.suggestion(), "Did you mean taylor_bar/rigid_wall?");
    EXPECT_NE(error.expected().find("\n  taylor_bar/rigid_wall, sliding_foot\n"), std::string::npos)
        << error.expected();
    EXPECT_NE(error.expected().find("\n  tutorial/bracket, phone"), std::string::npos) << error.expected();
  }
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(ExampleCases, OverwriteNothing) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "mine") << "text";
  for (const fs::path& taken : {folder_, folder_ / "mine"})
    EXPECT_THROW(begin_case(examples_, "roller/strip", taken.string()), CaseError) << taken;
  EXPECT_EQ(content(folder_ / "mine"), "text");
  fs::create_directories(folder_ / "empty");
  EXPECT_NO_THROW(begin_case(examples_, "roller/strip", (folder_ / "empty").string()));
}

TEST_F(ExampleCases, StandBesideAnInstalledProgramOrAroundABuild) {
  fs::create_directories(folder_ / "usr/bin");
  fs::create_directories(folder_ / "usr/share/carom/cases");
  fs::create_directories(folder_ / "source/build/release");
  fs::create_directories(folder_ / "source/cases");
  const auto place = [&](const char* program) { return examples_folder((folder_ / program).string()); };
  EXPECT_EQ(place("usr/bin/carom"), folder_ / "usr/share/carom");
  EXPECT_TRUE(fs::equivalent(place("source/build/release/carom"), folder_ / "source"));
  EXPECT_THROW(place("elsewhere/build/carom"), CaseError);
}

}  // namespace
}  // namespace carom::casefile_example_cases_test
