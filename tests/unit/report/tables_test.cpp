// What the report reads from tables and how it cuts long curves down.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "report/csv_table.hpp"
#include "report/decimate.hpp"

namespace carom::report_tables_test {
namespace {

namespace fs = std::filesystem;

CsvTable read_text_as_csv(const std::string& text) {
  const fs::path path = fs::temp_directory_path() / fmt::format("carom_report_{}.csv", ::getpid());
  std::ofstream(path, std::ios::binary) << text;
  const auto table = read_csv(path.string());
  fs::remove(path);
  return table.value();
}

TEST(CsvTable, CommentsColumnsAndRows) {
  const CsvTable table = read_text_as_csv("# units: mm, s, t, N, MPa, mJ\n# CFC 60\ntime,a\n0,1.5\n1e-3,-nan\n");
  EXPECT_EQ(table.damage, "");
  EXPECT_EQ(table.units.value().stress, "MPa");
  EXPECT_EQ(table.comments.at(1), "CFC 60");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.column("a")->at(0), 1.5);
  EXPECT_TRUE(std::isnan(table.column("a")->at(1)));
  EXPECT_EQ(table.column("b"), nullptr);
}

TEST(CsvTable, MissingFileIsNothing) {
  EXPECT_FALSE(read_csv("/proc/absent.csv"));
}

TEST(CsvTable, RowsBeforeTheDamageAreKept) {
  const std::string good = "time,a,b\n0,1,2\n1,3,4\n";
  for (const char* bad : {"2,5", "2,5,6", "2,5,6,7\n", "2,x,6\n", "2,5,6x\n", "\n", "2;5;6\n", "2,,6\n"}) {
    const CsvTable table = read_text_as_csv(good + bad);
    EXPECT_EQ(table.rows(), 2U) << bad;
    EXPECT_EQ(table.damage, "line 4 is not a whole row; it and what follows were left out") << bad;
  }
}

TEST(CsvTable, FilesThatAreNoTables) {
  EXPECT_EQ(read_text_as_csv("").damage, "the file is empty");
  EXPECT_EQ(read_text_as_csv("# only a comment\n").damage, "the file is empty");
  for (const char* text : {"time,a", "a,time\n0,1\n", "\n",
                           "\x7f"
                           "ELF\n"}) {
    const CsvTable table = read_text_as_csv(text);
    EXPECT_EQ(table.damage, "line 1 is not a line of column names beginning with time") << text;
    EXPECT_EQ(table.rows(), 0U) << text;
  }
}

TEST(Decimate, ShortCurvesAreKeptWhole) {
  EXPECT_EQ(decimate(std::vector{0.0, 1.0, 2.0}, std::vector{3.0, 3.0, 3.0}, 2), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(decimate({}, {}, 10).empty());
}

TEST(Decimate, EveryIntervalKeepsItsExtremes) {
  constexpr unsigned kSeed = 20261121;
  SCOPED_TRACE(fmt::format("seed {}", kSeed));
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  constexpr std::size_t n = 100000, intervals = 100;
  std::vector<double> time(n), values(n);
  for (std::size_t i = 0; i < n; ++i) {
    time[i] = static_cast<double>(i);
    values[i] = uniform(random);
  }
  const std::vector<std::size_t> rows = decimate(time, values, intervals);
  EXPECT_LE(rows.size(), 2 * intervals + 3);  // two per interval, both ends, the interval of the end itself
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), n - 1);
  // Brute force: the rows whose time falls into interval k are those with floor(i intervals / (n - 1)) == k.
  for (std::size_t k = 0; k < intervals; ++k) {
    const std::size_t begin = (k * (n - 1) + intervals - 1) / intervals;
    const std::size_t end = ((k + 1) * (n - 1) + intervals - 1) / intervals;
    const auto [low, high] = std::minmax_element(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 values.begin() + static_cast<std::ptrdiff_t>(end));
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), static_cast<std::size_t>(low - values.begin()))) << k;
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), static_cast<std::size_t>(high - values.begin()))) << k;
  }
}

TEST(Decimate, WhatIsNotFiniteIsLeftOut) {
  const std::vector<double> time{0.0, 1.0, 2.0, 3.0};
  const std::vector<double> values{NAN, 1.0, INFINITY, 2.0};
  EXPECT_EQ(decimate(time, values, 10), (std::vector<std::size_t>{1, 3}));
}

TEST(Decimate, TimeThatStandsStillEnds) {
  const std::vector<double> time(100, 1.0), values(100, 2.0);
  const std::vector<std::size_t> rows = decimate(time, values, 10);
  EXPECT_EQ(rows.front(), 0U);
  EXPECT_EQ(rows.back(), 99U);
}

}  // namespace
}  // namespace carom::report_tables_test
