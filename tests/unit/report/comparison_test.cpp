// The page of several runs: what they are called, and which curves share a picture.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "output/summary.hpp"
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

  static std::string text_of(const fs::path& page) {
    std::ifstream stream(page, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static nlohmann::json charts_of(const fs::path& page) {
    const std::string text = text_of(page);
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

// Of two runs that differ in nothing but the modulus and, here, in what a summary says of mesh and stress.
TEST_F(ReportComparison, SaysWhatDiffersInTheInputsAndByHowMuchInTheFigures) {
  std::ofstream(second_ / "case.resolved.toml") << "units = \"SI\"\n[mesh]\nfile = \"bar.msh\"\n\n[materials.steel]\n"
                                                   "E = 1e11\nnu = 0.0\n";
  Summary summary = read_summary((second_ / "summary.json").string());
  summary.mesh.cells = 42;  // of 21
  summary.stress.value *= 0.75;
  write_summary((second_ / "summary.json").string(), summary);
  const std::string tables = tables_of_runs({first_.string(), second_.string()}, "csv");
  for (const char* row : {"\nmaterials.steel.E,2e+11,1e+11\n", "\ncells of the mesh,21,42\n",
                          "\nLargest von Mises stress,410 MPa,307.5 MPa,-102 MPa (-25 %)\n",
                          "\nB.velocity_z at t = 4e-05 s,101.2 m/s ✗,101.2 m/s ✗,none\n", "\nkinetic,80,80,none\n"})
    EXPECT_NE(tables.find(row), std::string::npos) << row << tables;
  for (const char* same : {"materials.steel.nu", "nodes of the mesh", "title", "\nfriction,"})
    EXPECT_EQ(tables.find(same), std::string::npos) << same << tables;
  write_comparison({first_.string(), second_.string()}, (folder_ / "both.html").string());
  EXPECT_NE(text_of(folder_ / "both.html").find("<td data-label=\"Key\">materials.steel.E</td>"), std::string::npos);
}

TEST_F(ReportComparison, SaysThatNothingDiffersOrThatItIsNotKnown) {
  const fs::path page = folder_ / "both.html";
  write_comparison({first_.string(), second_.string()}, page.string());
  EXPECT_NE(text_of(page).find("No key of the cases differs"), std::string::npos);
  std::ofstream(second_ / "case.resolved.toml") << "[mesh\n";  // cut short
  write_comparison({first_.string(), second_.string()}, page.string());
  EXPECT_NE(text_of(page).find("What differs in the cases is not known"), std::string::npos);
  fs::remove(second_ / "case.resolved.toml");
  EXPECT_EQ(tables_of_runs({first_.string(), second_.string()}, "csv").find("materials"), std::string::npos);
  write_comparison({first_.string(), second_.string()}, page.string());
  for (const char* claim : {"No key of the cases differs", "What differs in the"})
    EXPECT_EQ(text_of(page).find(claim), std::string::npos) << claim;
}

// A page of one run has no differences to show.
TEST_F(ReportComparison, HasTheTablesOfOneRun) {
  const std::string tables = tables_of_runs({first_.string()}, "text");
  EXPECT_EQ(tables.find("differ"), std::string::npos);
  EXPECT_NE(tables.find("Largest von Mises stress     410 MPa\n"), std::string::npos) << tables;
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << "# units: m, s, kg, N, Pa, J\n" << text;
}

// Accelerations of 1000 and 1500 times 9.80665 m/s2; the differences are in the units of the values.
TEST_F(ReportComparison, HasDifferencesOfShocks) {
  for (const auto& [run, factor] : {std::pair{first_, 1.0}, std::pair{second_, 1.5}}) {
    Summary summary = read_summary((run / "summary.json").string());
    summary.shock = {{.probe = "head", .quantity = "acceleration", .cfc = 1000.0, .peak_g = 1000.0 * factor}};
    summary.shock[0].hic15 = summary.shock[0].hic36 = 250.0 * factor;
    summary.shock[0].pulse_end = 4e-3 / factor;
    write_summary((run / "summary.json").string(), summary);
    const std::string rows = fmt::format("time,head.acceleration_x\n0,0\n1,{}\n", 9806.65 * factor);
    write_text(run / "probes.csv", rows);
    write_text(run / "probes_filtered.csv", "# head.acceleration_x: SAE J211 CFC 1000\n" + rows);
  }
  const std::string tables = tables_of_runs({first_.string(), second_.string()}, "csv");
  for (const char* row :
       {"\n\"HIC15, head\",250,375,+125 (+50 %)\n", "\n\"Shock pulse, head\",4 ms,2.667 ms,-1.33 ms (-33.3 %)\n",
        "\n\"Peak acceleration, head, CFC 1000\",1000 g,1500 g,+500 g (+50 %)\n"})
    EXPECT_NE(tables.find(row), std::string::npos) << row << tables;
}

TEST_F(ReportComparison, HasThePeaksOfProbesAndOfParts) {
  for (const auto& [run, energy] : {std::pair{first_, 6}, std::pair{second_, 3}})
    write_text(run / "parts.csv",
               fmt::format("time,glass.kinetic_energy,foam.kinetic_energy\n0,{},1\n1,0,2\n", energy));
  const std::string one = tables_of_runs({first_.string()}, "csv");
  for (const char* row : {"\nglass,kinetic energy,6 J,0 s\n", "\nfoam,kinetic energy,2 J,1 s\n",
                          "\ndisplacement,2.2 mm,50 µs,\"B: node 1 at (0, 0, 0.02) m\"\n"})  // 100 m/s over 22 us
    EXPECT_NE(one.find(row), std::string::npos) << row << one;
  const std::string both = tables_of_runs({first_.string(), second_.string()}, "csv");
  for (const char* row :
       {"\n\"glass, kinetic energy\",6 J,3 J,-3 J (-50 %)\n", "\n\"displacement, B\",2.2 mm,2.2 mm,none\n"})
    EXPECT_NE(both.find(row), std::string::npos) << row << both;
  write_comparison({first_.string(), second_.string()}, (folder_ / "both.html").string());
  EXPECT_NE(text_of(folder_ / "both.html").find("<h2>Largest values of the parts</h2>"), std::string::npos);
}

// In all pictures: a colour for a run, a kind of line for what its curves are called there.
TEST_F(ReportComparison, GivesARunItsColourAndACurveItsLine) {
  const fs::path page = folder_ / "both.html";
  write_comparison({first_.string(), second_.string()}, page.string());
  for (const auto& chart : charts_of(page)) {
    std::map<std::string, int> lines;
    for (const auto& curve : chart["curves"]) {
      const std::string name = curve["name"];
      if (curve["kind"] == "exact") {
        EXPECT_FALSE(curve.contains("colour")) << name;
        continue;
      }
      EXPECT_EQ(curve["colour"], name.starts_with("fine/run: ") ? 0 : 1) << name;
      const std::string own = name.substr(name.find(": ") + 2);
      EXPECT_EQ(lines.try_emplace(own, curve["line"]).first->second, curve["line"]) << name;
    }
    std::set<int> different;
    for (const auto& [name, line] : lines) different.insert(line);
    EXPECT_EQ(different.size(), lines.size());
  }
}

}  // namespace
}  // namespace carom::report_comparison_test
