// Programs side by side, and a whole comparison by the program itself.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/errors.hpp"
#include "compare/compare_cases.hpp"
#include "compare/jobs.hpp"

namespace carom::compare::compare_run_test {
namespace {

namespace fs = std::filesystem;

class CompareRun : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  Job shell(const std::string& script, const std::string& log) const {
    return {{"/bin/sh", "-c", script}, (folder_ / log).string()};
  }
  static std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_ = fs::path(testing::TempDir()) / ("carom_compare_" + std::to_string(::getpid()));
  std::atomic<bool> stop_{false};
};

TEST_F(CompareRun, JobsDoNotConcernEachOther) {
  const std::vector<Job> jobs{shell("echo out; echo err >&2; exit 3", "a"), shell("kill -SEGV $$", "b"),
                              shell("exit 0", "c")};
  std::vector<std::size_t> finished;
  const ExitCodes codes = run_jobs(jobs, 2, stop_, [&](std::size_t job, int) { finished.push_back(job); });
  EXPECT_EQ(codes, (ExitCodes{3, 128 + SIGSEGV, 0}));
  EXPECT_EQ(finished.size(), 3U);
  EXPECT_EQ(read(folder_ / "a"), "out\nerr\n");
}

TEST_F(CompareRun, StopEndsTheRunningJobsAndStartsNoMore) {
  const std::vector<Job> jobs{shell("exit 0", "a"), shell("exec sleep 60", "b"), shell("exit 0", "c")};
  const auto begin = std::chrono::steady_clock::now();
  const ExitCodes codes = run_jobs(jobs, 1, stop_, [&](std::size_t job, int) {
    if (job == 0) stop_.store(true);
  });
  EXPECT_EQ(codes, (ExitCodes{0, -1, -1}));
  stop_.store(false);
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop_.store(true);
  });
  EXPECT_EQ(run_jobs({jobs[1], jobs[2]}, 1, stop_, [](std::size_t, int) {}), (ExitCodes{128 + SIGTERM, -1}));
  later.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));  // half of what the job would sleep
}

TEST_F(CompareRun, AProgramThatIsNotThereIsAnError) {
  EXPECT_THROW(run_jobs({{{(folder_ / "none").string()}, (folder_ / "log").string()}}, 1, stop_, [](auto, auto) {}),
               std::system_error);
  EXPECT_THROW(run_jobs({{{"/bin/true"}, (folder_ / "no/log").string()}}, 1, stop_, [](auto, auto) {}), OutputError);
}

/// Column of a table written by a run.
std::vector<double> column(const fs::path& path, const std::string& name) {
  std::ifstream stream(path);
  std::string line;
  std::vector<std::string> names;
  std::vector<double> values;
  while (std::getline(stream, line)) {
    if (line.starts_with("#")) continue;
    std::istringstream cells(line);
    std::string cell;
    std::size_t position = 0;
    const bool is_header = names.empty();
    while (std::getline(cells, cell, ',')) {
      if (is_header) names.push_back(cell);
      if (!is_header && names[position] == name) values.push_back(std::stod(cell));
      ++position;
    }
  }
  return values;
}

/// sqrt of the sum over the steps of the mean of both ends of (u - r)^2, over that of r^2.
double relative_l2(const fs::path& run, const std::string& name) {
  const std::vector<double> t = column(run / "exact.csv", "time"), r = column(run / "exact.csv", name),
                            u = column(run / "contact.csv", name);
  double sum = 0.0, norm = 0.0;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double half = 0.5 * (t[i + 1] - t[i]);
    sum += half * (std::pow(u[i] - r[i], 2) + std::pow(u[i + 1] - r[i + 1], 2));
    norm += half * (r[i] * r[i] + r[i + 1] * r[i + 1]);
  }
  return std::sqrt(sum / norm);
}

TEST_F(CompareRun, OfTheImpactBarMeasuresWhatTheRunsWrote) {
  const std::string file = std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/newmark.toml";
  const Options options{{"newmark", "central_differences", "leapfrog"}, {}, {"900"}, {10, 20}, {0.4}};
  const Settings settings{{CAROM_PROGRAM}, (folder_ / "out").string(), 2};
  EXPECT_EQ(compare_cases(file, options, settings, {.quiet = true}, stop_), ExitCode::good);
  const nlohmann::json json = nlohmann::json::parse(read(folder_ / "out/compare.json"));
  ASSERT_EQ(json["variants"].size(), 6U);
  EXPECT_EQ(json["reference"], "exact");
  EXPECT_EQ(json["common"], "stiffness 900, Courant 0.4");
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& v = json["variants"][i];
    const fs::path run = folder_ / "out/variants" / v["name"].get<std::string>();
    const double error = v["errors"]["force"]["l2"];
    // Round-off of some hundred terms in another order.
    EXPECT_NEAR(error, relative_l2(run, "wall.force_z"), 1e-12 * error) << v["label"];
    EXPECT_GT(error, 0.01);  // an order below the width of the wave front, h / L
    const std::vector<double> force = column(run / "contact.csv", "wall.force_z");
    EXPECT_EQ(v["peak_force"], *std::max_element(force.begin(), force.end()));
    EXPECT_EQ(v["steps"].get<std::size_t>() + 1, force.size());
  }
  EXPECT_FALSE(json["variants"][4]["allowed"].get<bool>());
  EXPECT_FALSE(json["recommendation"]["variant"].is_null());
  EXPECT_NE(read(folder_ / "out/compare.html").find("Recommended"), std::string::npos);
  EXPECT_NE(read(folder_ / "out/compare.csv").find("01_newmark_10_cells,"), std::string::npos);
}

/// What runs claim of each other without the exact solution is no less than what it says. By both enforcements and
/// schemes that dissipate and do not, on two and on three meshes.
TEST_F(CompareRun, ClaimsNoLessThanTheTrueError) {
  struct Of {
    const char* file;
    std::vector<int> cells;
  };
  const std::vector<std::string> schemes{"newmark:beta=0.25:gamma=0.5", "hht:alpha=-0.1", "cd_lagrange", "moreau_jean",
                                         "modified_mass"};
  for (const Of& of : {Of{"impact_bar/rigid_wall", {25, 50}}, Of{"impact_bar/rigid_wall", {12, 25, 50}},
                       Of{"two_bars/equal", {20, 40}}, Of{"two_bars/double_impedance", {10, 20, 40}}}) {
    const std::string file = std::string(CAROM_SOURCE_DIR) + "/cases/" + of.file + ".toml";
    const Settings settings{{CAROM_PROGRAM}, (folder_ / "out").string(), 1};
    EXPECT_EQ(compare_cases(file, {schemes, {}, {}, of.cells, {0.5}}, settings, {.quiet = true}, stop_),
              ExitCode::good);
    const nlohmann::json json = nlohmann::json::parse(read(folder_ / "out/compare.json"));
    EXPECT_GT(json["enforcement_spread"].get<double>(), 0.0);
    std::size_t claims = 0;
    for (const auto& v : json["variants"]) {
      if (v["claimed_error"].is_null()) continue;
      ++claims;
      EXPECT_GE(v["claimed_error"].get<double>(), v["errors"]["force"]["l2"].get<double>())
          << of.file << ": " << v["label"];
    }
    // All on the coarsest and on the finest cells; those between have judges of the finest as well.
    EXPECT_EQ(claims, schemes.size() * of.cells.size()) << of.file;
  }
}

TEST_F(CompareRun, OfForbiddenCombinationsOnlyIsAnErrorOfTheCase) {
  const std::string file = std::string(CAROM_SOURCE_DIR) + "/cases/impact_bar/newmark.toml";
  const Settings settings{{CAROM_PROGRAM}, (folder_ / "out").string(), 1};
  EXPECT_THROW(compare_cases(file, {{"leapfrog"}, {}, {}, {}, {}}, settings, {.quiet = true}, stop_), CaseError);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace carom::compare::compare_run_test
