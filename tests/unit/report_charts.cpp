#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "report/charts.hpp"

namespace carom {
namespace {

using Columns = std::vector<std::pair<std::string, std::vector<double>>>;

CsvTable table_of(const Columns& columns) {
  CsvTable table;
  for (const auto& [name, values] : columns) {
    table.columns.push_back(name);
    table.values.push_back(values);
  }
  return table;
}

const Chart* find(const std::vector<Chart>& charts, const std::string& title) {
  const auto at = std::find_if(charts.begin(), charts.end(), [&](const Chart& chart) { return chart.title == title; });
  return at == charts.end() ? nullptr : &*at;
}

const Units kUnits = units_of("mm-t-s");

TEST(Charts, ComponentsOfOneQuantityShareAChart) {
  const CsvTable probes = table_of({{"time", {0, 1}},
                                    {"B.displacement_x", {0, 1}},
                                    {"B.velocity_z", {5, 6}},
                                    {"B.displacement_z", {0, 2}},
                                    {"C.displacement_z", {1, 1}}});
  const auto charts = make_charts({.probes = probes}, kUnits);
  ASSERT_EQ(charts.size(), 3U);
  EXPECT_EQ(charts[0].title, "B · displacement");
  EXPECT_EQ(charts[0].section, "Probes");
  EXPECT_EQ(charts[0].label, "displacement");
  EXPECT_EQ(charts[0].unit, "mm");
  ASSERT_EQ(charts[0].curves.size(), 2U);
  EXPECT_EQ(charts[0].curves[0].name, "x");
  EXPECT_EQ(charts[0].curves[1].name, "z");
  EXPECT_EQ(charts[0].curves[1].values, (std::vector{0.0, 2.0}));
  EXPECT_EQ(charts[1].title, "B · velocity");
  EXPECT_EQ(charts[1].unit, "mm/s");
  EXPECT_EQ(charts[2].title, "C · displacement");
}

TEST(Charts, ExactSolutionFollowsItsCurveOnItsOwnTimes) {
  const CsvTable contact = table_of({{"time", {0, 1}}, {"wall.force_y", {3, 3}}, {"wall.force_z", {3, 4}}});
  const CsvTable exact = table_of({{"time", {0, 0.5, 1}}, {"wall.force_z", {3, 3.5, 4}}, {"B.velocity_z", {1, 1, 1}}});
  const auto charts = make_charts({.contact = contact, .exact = exact}, kUnits);
  ASSERT_EQ(charts.size(), 1U);
  ASSERT_EQ(charts[0].curves.size(), 3U);
  EXPECT_EQ(charts[0].curves[1].kind, CurveKind::computed);
  EXPECT_EQ(charts[0].curves[2].name, "z, exact");
  EXPECT_EQ(charts[0].curves[2].kind, CurveKind::exact);
  EXPECT_EQ(charts[0].curves[2].time, (std::vector{0.0, 0.5, 1.0}));
}

TEST(Charts, FilteredProbesLieOverTheRawOnes) {
  const CsvTable probes = table_of({{"time", {0, 1}}, {"B.velocity_z", {3, 4}}});
  const CsvTable filtered = table_of({{"time", {0, 1}}, {"B.velocity_z", {3.1, 3.9}}});
  const auto charts = make_charts({.probes = probes, .probes_filtered = filtered}, kUnits);
  ASSERT_EQ(charts.size(), 1U);
  ASSERT_EQ(charts[0].curves.size(), 2U);
  EXPECT_EQ(charts[0].curves[1].name, "z, filtered");
  EXPECT_EQ(charts[0].curves[1].values, (std::vector{3.1, 3.9}));
}

TEST(Charts, NegligibleComponentsAreNamedInsteadOfDrawn) {
  const CsvTable probes = table_of(
      {{"time", {0, 1}}, {"B.velocity_x", {0, 1e-10}}, {"B.velocity_y", {0, 1.1e-9}}, {"B.velocity_z", {0, -1}}});
  const auto charts = make_charts({.probes = probes}, kUnits);
  ASSERT_EQ(charts.size(), 1U);
  ASSERT_EQ(charts[0].curves.size(), 2U);
  EXPECT_EQ(charts[0].curves[0].name, "y");
  EXPECT_EQ(charts[0].note, "Not drawn, zero or below 1e-9 of the largest: x.");
}

TEST(Charts, ZeroThroughoutGivesNoChart) {
  const CsvTable contact = table_of({{"time", {0, 1}}, {"wall.force_z", {0, 0}}, {"wall.closed", {0, 0}}});
  EXPECT_TRUE(make_charts({.contact = contact}, kUnits).empty());
}

TEST(Charts, EnergyColumnsAreGroupedByMeaning) {
  const CsvTable energy = table_of({{"time", {0, 1}},
                                    {"step", {0, 1}},
                                    {"dt", {1, 1}},
                                    {"kinetic", {8, 4}},
                                    {"strain", {0, 4}},
                                    {"plastic", {0, 1}},
                                    {"imbalance", {0, 1e-12}},
                                    {"quadrature", {0, 1e-3}},
                                    {"ENER_CIN", {0, -4}},
                                    {"TRAV_EXT", {0, 0}},
                                    {"momentum_z", {1, 2}}});
  const auto charts = make_charts({.energy = energy}, kUnits);
  const Chart* energies = find(charts, "Energies and work");
  ASSERT_NE(energies, nullptr);
  ASSERT_EQ(energies->curves.size(), 3U);  // a column of a later version (plastic) is drawn with the energies
  EXPECT_EQ(energies->curves[0].name, "kinetic");
  EXPECT_EQ(energies->unit, "mJ");
  ASSERT_NE(find(charts, "Numerical energies"), nullptr);
  EXPECT_EQ(find(charts, "Numerical energies")->curves[0].name, "quadrature");
  ASSERT_NE(find(charts, "Imbalance of powers"), nullptr);
  ASSERT_NE(find(charts, "In Code_Aster's terms"), nullptr);
  EXPECT_EQ(find(charts, "In Code_Aster's terms")->curves[0].name, "ENER_CIN");
  EXPECT_EQ(find(charts, "In Code_Aster's terms")->note, "Not drawn, zero or below 1e-9 of the largest: TRAV_EXT.");
  ASSERT_NE(find(charts, "Linear momentum"), nullptr);
  ASSERT_NE(find(charts, "Time step"), nullptr);
}

TEST(Charts, TablesWithoutRowsGiveNoCharts) {
  EXPECT_TRUE(make_charts({.energy = table_of({{"time", {}}, {"kinetic", {}}})}, kUnits).empty());
}

TEST(Charts, JsonIsSafeInsideAScriptElement) {
  const std::string hostile = "</script><!-- \"\\ é";
  const std::vector<Chart> charts{
      {"Probes", "t", hostile, "m", {{hostile, {0.0, 1.0}, {0.1, 1.0 / 3.0}, CurveKind::exact}}, ""}};
  const std::string text = charts_json(charts, kUnits);
  EXPECT_EQ(text.find('<'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["time_unit"], "s");
  EXPECT_EQ(json["charts"][0]["label"], hostile);
  EXPECT_EQ(json["charts"][0]["curves"][0]["name"], hostile);
  EXPECT_EQ(json["charts"][0]["curves"][0]["kind"], "exact");
  EXPECT_EQ(json["charts"][0]["curves"][0]["t"], (std::vector{0.0, 1.0}));
  // Eight significant digits of 1/3.
  EXPECT_EQ(json["charts"][0]["curves"][0]["y"][1], 0.33333333);
  EXPECT_TRUE(nlohmann::json::parse(charts_json({}, kUnits))["charts"].empty());
}

}  // namespace
}  // namespace carom
