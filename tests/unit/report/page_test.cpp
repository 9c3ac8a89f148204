#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "base/errors.hpp"
#include "output/summary.hpp"
#include "report/assets.hpp"
#include "report/report.hpp"
#include "report_sample.hpp"

namespace carom::report_page_test {
namespace {

namespace fs = std::filesystem;

class ReportPage : public testing::Test {
 protected:
  void SetUp() override { write_sample_results(folder_, 3000); }
  void TearDown() override { fs::remove_all(folder_); }

  std::string page() const {
    write_report(folder_.string());
    std::ifstream stream(folder_ / "report.html", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  /// The page without the library and its licence, which mention addresses and markup of their own.
  std::string own_page() const {
    std::string text = page();
    for (const std::string_view asset : {assets::dygraph_js, assets::dygraph_css}) {
      const std::size_t at = text.find(asset);
      EXPECT_NE(at, std::string::npos);
      if (at != std::string::npos) text.erase(at, asset.size());
    }
    return text;
  }

  static nlohmann::json charts(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"charts\">";
    const std::size_t at = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
  }

  fs::path folder_ = fs::temp_directory_path() / fmt::format("carom_report_{}", ::getpid());
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ReportPage, ShowsVerdictChecksLedgerAndCase) {
  const std::string html = page();
  EXPECT_TRUE(contains(html, "<strong>Failed</strong><span>1 of 3 checks did not pass: B.velocity_z at t = 4e-05."));
  EXPECT_TRUE(contains(
      html, "<td data-label=\"Item\">energy balance</td><td class=\"number\" data-label=\"value\">3.9e-15</td>"));
  // 101.2 against 100: 1.2 % above, tolerance 1e-3.
  EXPECT_TRUE(contains(html,
                       "<td class=\"number\" data-label=\"value\">101.2</td><td class=\"number\" "
                       "data-label=\"reference\">100</td><td data-label=\"unit\">m/s</td>"
                       "<td class=\"number\" data-label=\"difference\">1.2 %</td><td class=\"number\" "
                       "data-label=\"tolerance\">± 0.1 %</td><td class=\"mark fail\" data-label=\"\">✗ fail</td>"
                       "<td data-label=\"source\">exact solution of the bar</td>"));
  // An absolute tolerance with reference 0 has no percent.
  EXPECT_TRUE(contains(html, ">-1.3e-09</td><td class=\"number\" data-label=\"tolerance\">± 1e-06</td>"));
  EXPECT_TRUE(contains(html, ">contact stored</td>"));
  EXPECT_TRUE(contains(html, ">TRAV_LIAI</td><td class=\"number\" data-label=\"energy [J]\">0.002</td>"));
  EXPECT_TRUE(contains(html, "file = &quot;bar.msh&quot;"));
  EXPECT_TRUE(contains(html, "88 nodes, 21 cells"));
  EXPECT_TRUE(contains(html, "SI (m, s, kg, N, Pa, J)"));
}

// The bar of the sample: rho c v A = 400 kN, a quarter more by ringing right after the touch at 20 us, closed for two
// wave transits of 4 us; the rows stand 0.017 us apart.
TEST_F(ReportPage, KeyFiguresStandOnTop) {
  const std::string html = page();
  const std::size_t figures = html.find("<h2>Key figures</h2>"), checks = html.find("<h2>Checks</h2>");
  ASSERT_NE(figures, std::string::npos);
  EXPECT_LT(figures, checks);
  EXPECT_TRUE(contains(html, "<dt>Peak force, wall</dt><dd><strong>499.4 kN</strong> at 20.01 µs"));
  EXPECT_TRUE(contains(html, "<dt>Duration of contact, wall</dt><dd><strong>8.003 µs</strong> from 20.01 µs"));
  EXPECT_TRUE(
      contains(html, "<dt>Rebound speed, bar</dt><dd><strong>98 m/s</strong> 100 m/s at the beginning, ratio 0.98"));
  EXPECT_TRUE(
      contains(html, "<strong>410 MPa</strong> in bar, cell 7 at (0.005, 0, 0.001) m, at 22 µs; of 201 instants"));
}

TEST_F(ReportPage, SaysWhereProbesAreAndMarksStages) {
  const std::string html = page();
  EXPECT_TRUE(contains(html, "B · displacement <span class=\"place\">node 1 at (0, 0, 0.02) m</span>"));
  const auto json = charts(html);
  ASSERT_EQ(json["marks"].size(), 1U);
  EXPECT_EQ(json["marks"][0]["t"], 1e-5);
  EXPECT_EQ(json["marks"][0]["name"], "Newmark beta 0.25 gamma 0.5");
  EXPECT_EQ(json["time_unit"], "µs");
  EXPECT_EQ(json["time_power"], -6);
}

/// The sample's summary with another end.
class ReportOfOutcome : public ReportPage {
 protected:
  std::string page_of(Outcome outcome, bool has_checks) {
    Summary summary = read_summary((folder_ / "summary.json").string());
    summary.outcome = outcome;
    if (!has_checks) summary.checks.clear();
    std::erase_if(summary.verdict, [](const VerdictItem& item) { return !item.pass; });
    write_summary((folder_ / "summary.json").string(), summary);
    return own_page();
  }
};

TEST_F(ReportOfOutcome, GoodWithoutChecksIsNotTheGreenOfAValidatedRun) {
  EXPECT_TRUE(
      contains(page_of(Outcome::good, true), "<div class=\"banner good\" role=\"status\"><strong>Good</strong>"));
  EXPECT_TRUE(contains(page_of(Outcome::good, false),
                       "<div class=\"banner unchecked\" role=\"status\"><strong>Good, no checks</strong>"));
}

TEST_F(ReportOfOutcome, FailuresStandInTheBannerWithWhatHelps) {
  Summary summary = read_summary((folder_ / "summary.json").string());
  summary.verdict = {{"energy gained", 0.0123, 0.005, false, "energy < that. A shorter step helps"},
                     {"quadrature", 0.01, 0.05, true, "fine"}};
  summary.checks.resize(1);
  summary.checks[0].pass = false;
  write_summary((folder_ / "summary.json").string(), summary);
  const std::string html = own_page();
  EXPECT_TRUE(contains(html,
                       "<ul>\n<li><strong>energy gained</strong>: 0.0123, and the limit is 0.005 (energy &lt; that. "
                       "A shorter step helps)</li>\n<li><strong>check " +
                           summary.checks[0].name + "</strong>: "));
  EXPECT_FALSE(contains(page_of(Outcome::good, false), "<ul>\n<li><strong>"));
}

TEST_F(ReportOfOutcome, GoodWithWarningsHasAColourOfItsOwn) {
  Summary summary = read_summary((folder_ / "summary.json").string());
  summary.warnings = {"something is doubtful"};
  write_summary((folder_ / "summary.json").string(), summary);
  EXPECT_TRUE(contains(page_of(Outcome::good, true),
                       "<div class=\"banner cautious\" role=\"status\"><strong>Good, with warnings</strong>"));
  EXPECT_TRUE(contains(page_of(Outcome::good, false), "<strong>Good, with warnings, no checks</strong>"));
}

TEST_F(ReportOfOutcome, WhatADeckLostStandsOnTop) {
  Summary summary = read_summary((folder_ / "summary.json").string());
  summary.notes = {"a.inp:3: *DAMPING: is left out. It is not damped. (accepted)", "a.inp:9: a note"};
  summary.warnings.clear();
  write_summary((folder_ / "summary.json").string(), summary);
  const std::string html = page_of(Outcome::good, true);
  const std::size_t lost = html.find("<li>a.inp:3: *DAMPING: is left out. It is not damped.</li>");
  ASSERT_NE(lost, std::string::npos);
  EXPECT_LT(lost, html.find("</header>"));
  EXPECT_EQ(html.find("(accepted)"), std::string::npos);
  EXPECT_GT(html.find("a.inp:9: a note"), html.find("</header>"));
  EXPECT_TRUE(contains(html, "banner cautious"));
}

TEST_F(ReportOfOutcome, ASpeedOfRoundOffIsNoneAtTheBeginning) {
  Summary summary = read_summary((folder_ / "summary.json").string());
  summary.parts.front().velocity_begin = {0.0, 0.0, -1e-16};
  write_summary((folder_ / "summary.json").string(), summary);
  EXPECT_TRUE(contains(own_page(), "<strong>98 m/s</strong> at rest at the beginning</dd>"));
}

TEST_F(ReportOfOutcome, AnErrorHasNoWallOfPasses) {
  const std::string html = page_of(Outcome::error, true);
  EXPECT_TRUE(contains(html,
                       "<h2>No verdict: the run did not reach its end</h2>\n<details><summary>The items up to there: "
                       "3 of 3 within their limits</summary>"));
  EXPECT_FALSE(contains(html, "<h2>Verdict</h2>"));
}

TEST_F(ReportPage, TextOfTheUserStaysText) {
  const std::string html = own_page();
  EXPECT_FALSE(contains(html, "<script>alert"));
  EXPECT_TRUE(contains(html, "<h1>Elastic bar on a rigid wall &lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt;"));
}

TEST_F(ReportPage, NeedsNoNetwork) {
  const std::string html = own_page();
  for (const char* word : {"url(", "@import", "fetch(", "XMLHttpRequest"}) EXPECT_FALSE(contains(html, word)) << word;
  for (const std::string key : {"src", "href"}) {
    for (std::size_t i = html.find(key); i != std::string::npos; i = html.find(key, i + 1)) {
      const std::size_t equals = html.find_first_not_of(" \n", i + key.size());
      if (equals == std::string::npos || html[equals] != '=') continue;
      const std::size_t quote = html.find_first_not_of(" \n", equals + 1);
      if (quote == std::string::npos || html[quote] != '"') continue;
      EXPECT_EQ(html.substr(quote, 6), "\"data:") << html.substr(i, 80);
    }
  }
  EXPECT_FALSE(contains(page(), "sourceMappingURL"));
}

TEST_F(ReportPage, HoldsTheLibraryAndItsLicence) {
  const std::string html = page();
  EXPECT_GT(assets::dygraph_js.size(), 100000U);  // dygraph.min.js 2.2.1 has 131 kB
  EXPECT_TRUE(contains(html, "Permission is hereby granted, free of charge"));
}

TEST_F(ReportPage, EveryChartHasItsData) {
  const std::string html = page();
  const auto json = charts(html);
  ASSERT_GE(json["charts"].size(), 10U);
  for (std::size_t i = 0; i < json["charts"].size(); ++i) {
    EXPECT_TRUE(contains(html, fmt::format("data-chart=\"{}\"", i)));
  }
  EXPECT_FALSE(contains(html, fmt::format("data-chart=\"{}\"", json["charts"].size())));
  EXPECT_EQ(json["charts"][0]["label"], "displacement");
  EXPECT_EQ(json["charts"][0]["curves"][1]["name"], "z, exact");
}

TEST_F(ReportPage, LongRunsStaySmall) {
  write_sample_results(folder_, 100000);
  const auto json = charts(page());
  for (const auto& chart : json["charts"]) {
    for (const auto& curve : chart["curves"]) EXPECT_LE(curve["t"].size(), 2003U);
  }
}

TEST_F(ReportPage, InterruptedRunStillHasAReport) {
  fs::remove(folder_ / "summary.json");
  fs::remove(folder_ / "case.resolved.toml");
  fs::remove(folder_ / "exact.csv");
  fs::resize_file(folder_ / "probes.csv", fs::file_size(folder_ / "probes.csv") / 2 + 1);
  const std::string html = page();
  EXPECT_TRUE(contains(html, "<strong>No verdict</strong>"));
  EXPECT_TRUE(contains(html, "<li>summary.json is missing.</li>"));
  EXPECT_TRUE(contains(html, "<li>case.resolved.toml is missing.</li>"));
  EXPECT_TRUE(contains(html, "is not a whole row; it and what follows were left out.</li>"));
  const auto json = charts(html);
  EXPECT_EQ(json["time_unit"], "µs");  // from the tables' comments
  EXPECT_EQ(json["charts"][0]["unit"], "mm");
}

// Of the case while there is no summary, of that once there is.
TEST_F(ReportPage, TiesHaveALineOfTheirOwn) {
  const char* const line = "<dt>Largest force carried by tie wall</dt><dd><strong>499.4 kN</strong> at 20.01 µs</dd>";
  EXPECT_FALSE(contains(page(), line));
  Summary summary = read_summary((folder_ / "summary.json").string());
  summary.ties = {"wall"};
  write_summary((folder_ / "summary.json").string(), summary);
  EXPECT_TRUE(contains(page(), line));
  fs::remove(folder_ / "summary.json");
  EXPECT_FALSE(contains(page(), line));
  std::ofstream(folder_ / "case.resolved.toml", std::ios::app) << "[[contact]]\nname = \"wall\"\nkind = \"tie\"\n";
  const std::string running = page();
  EXPECT_TRUE(contains(running, line));
  EXPECT_FALSE(contains(running, "Duration of contact, wall"));
}

TEST_F(ReportPage, EmptyOrDamagedFolderStillHasAReport) {
  std::ofstream(folder_ / "summary.json") << "{\"outcome\": \"go";
  for (const char* name : {"energy.csv", "contact.csv", "probes.csv", "exact.csv"}) std::ofstream(folder_ / name) << "";
  const std::string html = page();
  EXPECT_TRUE(contains(html, "summary.json is damaged"));
  EXPECT_TRUE(contains(html, "<li>energy.csv: the file is empty.</li>"));
  EXPECT_TRUE(charts(html)["charts"].empty());
}

TEST_F(ReportPage, MissingFolderIsAnErrorThatNamesThePage) {
  try {
    write_report("/proc/absent");
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_EQ(error.path(), "/proc/absent/report.html");
  }
}

}  // namespace
}  // namespace carom::report_page_test
