// The page of several runs: what they are called, and which curves share a picture.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/report.hpp"
#include "report_sample.hpp"

namespace carom::report_comparison_test {
namespace {

namespace fs = std::filesystem;

class ReportComparison : public testing::Test {
 protected:
  void SetUp() override {
    for (const fs::path& run : {first_, second_}) write_sample_results(run, 100);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static nlohmann::json charts_of(const fs::path& page) {
    std::ifstream stream(page, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::string begin = "<script type=\"application/json\" id=\"charts\">";
    const std::size_t at = text.find(begin) + begin.size();
    return nlohmann::json::parse(text.substr(at, text.find("</script>", at) - at))["charts"];
  }

  fs::path folder_ = fs::temp_directory_path() / fmt::format("carom_comparison_{}", ::getpid());
  fs::path first_ = folder_ / "fine" / "run", second_ = folder_ / "coarse" / "run";
};

// As much of the end of their paths as tells them apart; the exact solution is the same for both and is drawn once.
TEST_F(ReportComparison, LaysTheCurvesOfRunsOfOneNameOverEachOther) {
  const fs::path page = folder_ / "both.html";
  write_comparison({first_.string(), second_.string()}, page.string());
  write_report(first_.string());
  const nlohmann::json both = charts_of(page), one = charts_of(first_ / "report.html");
  EXPECT_EQ(both.size(), one.size());  // a picture is not drawn twice
  std::vector<std::string> names;
  for (const auto& curve : both[0]["curves"]) names.push_back(curve["name"]);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"coarse/run: z", "fine/run: z", "z, exact"}));
}

}  // namespace
}  // namespace carom::report_comparison_test
