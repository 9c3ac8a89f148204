// Which keys of cases differ.
#include "report/case_differences.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace carom::report_case_differences_test {
namespace {

std::vector<std::string> keys(const std::vector<KeyDifference>& differences) {
  std::vector<std::string> found;
  for (const KeyDifference& d : differences) found.push_back(d.key);
  return found;
}

const std::string base = R"(title = "one"
[scheme]
kind = "newmark"
beta = 0.25
[[contact]]
name = "wall"
stiffness = 1e9
[[contact]]
name = "floor"
stiffness = 2e9
[[load]]
value = [0.0, 1.0]
[[check]]
value = 1.0
)";

TEST(CaseDifferences, AreKeysWithTheirValues) {
  const std::string other = R"(title = "two"
[scheme]
kind = "bathe"
[[contact]]
name = "floor"
stiffness = 2e9
[[contact]]
name = "wall"
stiffness = 3e9
[[load]]
value = [0.0, 2.0]
)";
  const auto found = case_differences({{".", base}, {".", other}, {".", base}});
  // Entries go by their names, whatever their order; the load has none. Title and checks are no inputs of a run.
  EXPECT_EQ(keys(found),
            (std::vector<std::string>{"scheme.kind", "scheme.beta", "contact[wall].stiffness", "load[1].value"}));
  EXPECT_EQ(found[0].values, (std::vector<std::string>{"\"newmark\"", "\"bathe\"", "\"newmark\""}));
  EXPECT_EQ(found[1].values, (std::vector<std::string>{"0.25", "–", "0.25"}));
  EXPECT_EQ(found[2].values, (std::vector<std::string>{"1e+09", "3e+09", "1e+09"}));
  EXPECT_EQ(found[3].values[1], "[0.0, 2.0]");
}

TEST(CaseDifferences, AreNoneOfEqualCases) {
  EXPECT_TRUE(case_differences({{".", base}, {".", base}}).empty());
  EXPECT_TRUE(case_differences({{".", base}}).empty());
}

// "../bar.msh" and "../../bar.msh" are one file where the folders are at different depths.
TEST(CaseDifferences, AreNoneOfOneFileSeenFromTwoFolders) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("carom_differences_" + std::to_string(::getpid()));
  fs::create_directories(folder / "deep/er");
  std::ofstream(folder / "bar.msh") << "mesh";
  const auto text = [](const char* file) { return std::string("[mesh]\nfile = \"") + file + "\"\n"; };
  const CaseText near{(folder / "deep").string(), text("../bar.msh")},
      far{(folder / "deep/er").string(), text("../../bar.msh")}, missing{folder.string(), text("beam.msh")};
  EXPECT_TRUE(case_differences({near, far}).empty());
  EXPECT_EQ(case_differences({near, missing})[0].values[1], "\"beam.msh\"");
  fs::remove_all(folder);
}

TEST(CaseDifferences, AreNotKnownOfWhatIsNoToml) {
  EXPECT_THROW(case_differences({{".", base}, {".", "[scheme\n"}}), CaseError);
}

}  // namespace
}  // namespace carom::report_case_differences_test
