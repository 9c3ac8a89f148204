#include "report/charts.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/readable_unit.hpp"
#include "report/figures.hpp"

namespace carom::report_charts_test {
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
  EXPECT_EQ(charts[0].curves[0].kind, CurveKind::raw);
  EXPECT_EQ(charts[0].curves[1].kind, CurveKind::filtered);
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

TEST(Charts, ZeroThroughoutIsSaidInALine) {
  const CsvTable contact = table_of({{"time", {0, 1}}, {"wall.force_z", {0, 0}}, {"wall.closed", {0, 0}}});
  const auto charts = make_charts({.contact = contact}, kUnits);
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_TRUE(charts[0].curves.empty());
  EXPECT_EQ(charts[0].title, "Zero throughout:");
  EXPECT_EQ(charts[0].note, "wall · force; wall · closed.");
}

// 1e-13 of the largest of its kind is what rounding leaves of zero; 1e-11 may be a result.
TEST(Charts, RoundOffIsSaidInALine) {
  const CsvTable probes = table_of(
      {{"time", {0, 1}}, {"A.velocity_z", {0, 1e-13}}, {"B.velocity_z", {0, -1}}, {"C.velocity_z", {0, 1e-11}}});
  const auto charts = make_charts({.probes = probes}, kUnits);
  ASSERT_EQ(charts.size(), 3U);
  EXPECT_EQ(charts[0].title, "B · velocity");
  EXPECT_EQ(charts[1].title, "C · velocity");
  EXPECT_EQ(charts[2].title, "Round-off, not drawn:");
  EXPECT_EQ(charts[2].note, "A · velocity.");
}

TEST(Charts, ImbalancesWithinTheirBoundAreSaidInALine) {
  const CsvTable energy = table_of({{"time", {0, 1}}, {"kinetic", {8, 4}}, {"imbalance", {0, 3e-14}}});
  Summary summary;
  summary.verdict = {{"energy balance", 4e-15, 1e-10, true, ""}};
  const auto kept = make_charts({.energy = energy}, kUnits, summary);
  const Chart* said = find(kept, "Imbalance of powers:");
  ASSERT_NE(said, nullptr);
  EXPECT_TRUE(said->curves.empty());
  EXPECT_EQ(said->note, "zero within the bound: at most 4e-15 of 1e-10 allowed, relative.");
  // A broken bound is drawn.
  const CsvTable off = table_of({{"time", {0, 1}}, {"kinetic", {8, 4}}, {"imbalance", {0, 3e-3}}});
  summary.verdict = {{"energy balance", 4e-4, 1e-10, false, ""}};
  const auto broken = make_charts({.energy = off}, kUnits, summary);
  ASSERT_NE(find(broken, "Imbalance of powers"), nullptr);
  EXPECT_EQ(find(broken, "Imbalance of powers")->curves.size(), 1U);
}

TEST(Charts, AConstantStepIsSaidInALine) {
  const CsvTable energy = table_of({{"time", {0, 2e-6, 4e-6, 5e-6}}, {"dt", {0, 2e-6, 2e-6, 1e-6}}});
  const auto charts = make_charts({.energy = energy}, kUnits);
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_EQ(charts[0].note, "2 µs, the last shorter.");
}

TEST(Charts, TheMechanicalEnergyIsDrawnWithItsTerms) {
  const CsvTable energy = table_of({{"time", {0, 1}},
                                    {"kinetic", {8, 4}},
                                    {"strain", {0, 3}},
                                    {"hourglass", {0, 0.25}},
                                    {"distortion", {0, 0.125}},
                                    {"contact_stored", {0, 0.5}}});
  const auto charts = make_charts({.energy = energy}, kUnits);
  ASSERT_EQ(charts.at(0).curves.size(), 6U);
  EXPECT_EQ(charts[0].curves[5].name, "total: kinetic + strain + hourglass + distortion + contact stored");
  EXPECT_EQ(charts[0].curves[5].values, (std::vector{8.0, 7.875}));
}

TEST(Charts, CountsHaveWholeTicks) {
  const CsvTable contact = table_of({{"time", {0, 1}}, {"wall.force_z", {0, 1}}, {"wall.closed", {0, 2}}});
  const auto json = nlohmann::json::parse(charts_json({make_charts({.contact = contact}, kUnits), "s"}));
  EXPECT_EQ(json["charts"][0]["count"], false);
  EXPECT_EQ(json["charts"][1]["count"], true);
}

TEST(Charts, EnergyColumnsAreGroupedByMeaning) {
  const CsvTable energy = table_of({{"time", {0, 1}},
                                    {"step", {0, 1}},
                                    {"dt", {1, 1}},
                                    {"kinetic", {8, 4}},
                                    {"strain", {0, 4}},
                                    {"plastic", {0, 1}},
                                    {"imbalance", {0, 1e-3}},
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
  const std::string text = charts_json({charts, "s"});
  EXPECT_EQ(text.find('<'), std::string::npos);
  const auto json = nlohmann::json::parse(text);
  EXPECT_EQ(json["time_unit"], "s");
  EXPECT_EQ(json["charts"][0]["label"], hostile);
  EXPECT_EQ(json["charts"][0]["curves"][0]["name"], hostile);
  EXPECT_EQ(json["charts"][0]["curves"][0]["kind"], "exact");
  EXPECT_EQ(json["charts"][0]["curves"][0]["t"], (std::vector{0.0, 1.0}));
  // Eight significant digits of 1/3.
  EXPECT_EQ(json["charts"][0]["curves"][0]["y"][1], 0.33333333);
  EXPECT_TRUE(nlohmann::json::parse(charts_json({{}, "s"}))["charts"].empty());
}

TEST(ReadableUnit, TakesPrefixesWhereThereAreSome) {
  const auto name = [](double largest, const char* unit) { return readable_unit(largest, unit).name; };
  EXPECT_EQ(name(40600.0, "N"), "kN");
  EXPECT_EQ(name(5000.0, "mm/s"), "m/s");
  EXPECT_EQ(name(0.0021, "m"), "mm");
  EXPECT_EQ(name(4e8, "Pa"), "MPa");
  EXPECT_EQ(name(2100.0, "MPa"), "GPa");
  EXPECT_EQ(name(12000.0, "mJ"), "J");
  EXPECT_EQ(name(4e-4, "s"), "µs");
  EXPECT_EQ(name(0.002, "N s"), "mN s");
  EXPECT_EQ(name(226.0, "MPa"), "MPa");
  EXPECT_EQ(name(5000.0, "kg m/s"), "kg m/s");
  EXPECT_EQ(name(2e-4, "t mm/s"), "10⁻⁶ t mm/s");
  EXPECT_EQ(name(2e7, ""), "10⁶");
  EXPECT_EQ(name(0.0, "N"), "N");
  EXPECT_EQ(readable_unit(4e8, "Pa").power, 6);
  EXPECT_EQ(with_readable_unit(-40665.7, "N", 3), "-40.7 kN");
}

// What is lost or only told apart is no scale: kinetic 8 is the largest that there was, whatever friction took since.
TEST(Scales, OfEnergyAreThoseThatAreStoredOrSupplied) {
  const CsvTable stored = table_of({{"time", {0, 1}}, {"kinetic", {8, 4}}, {"strain", {0, 3}}, {"friction", {0, 20}}});
  EXPECT_EQ(scales_of({.energy = stored}, std::nullopt).energy, 8.0);
  const CsvTable supplied = table_of({{"time", {0, 1}}, {"kinetic", {8, 4}}, {"external_work", {0, -12}}});
  EXPECT_EQ(scales_of({.energy = supplied}, std::nullopt).energy, 12.0);
}

// In units of GPa stresses of steel are below 1.
TEST(LargestValues, HaveTheStressHoweverSmallItsNumber) {
  Summary summary;
  summary.stress = {0.25, 2e-5, "bar", 7, {0.0, 0.0, 0.0}, 3};
  const std::vector<LargestValue> values = largest_values({}, summary, kUnits);
  ASSERT_EQ(values.size(), 1U);
  EXPECT_EQ(values[0].quantity, "von Mises stress");
  summary.stress.value = 0.0;
  EXPECT_TRUE(largest_values({}, summary, kUnits).empty());
}

// A raw peak of 50 m/s2 of a node that shakes, of which the filter leaves (0, 3, 4) x 9.80665: 5 g; a force of 8 N, 6
// N.
/// A run of bodies of these speeds along x at the beginning and at the end, all of 1 kg.
std::vector<KeyFigure> figures_of_speeds(const std::vector<std::array<double, 2>>& speeds) {
  Tables tables;
  tables.energy = table_of({{"time", {0, 1}}, {"kinetic", {50, 50}}});  // 10 m/s of 1 kg
  Summary summary;
  for (std::size_t i = 0; i < speeds.size(); ++i)
    summary.parts.push_back({fmt::format("b{}", i + 1),
                             1.0 / static_cast<double>(speeds.size()),
                             {speeds[i][0], 0, 0},
                             {speeds[i][1], 0, 0}});
  return key_figures(tables, summary, units_of("SI"));
}

TEST(KeyFigures, SpeedsOfRoundOffAreRest) {
  const std::vector<KeyFigure> figures = figures_of_speeds({{10.0, 6.66e-16}, {1e-16, -4.0}});
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].title, "Speed at the end, b1");
  EXPECT_EQ(figures[0].value, "at rest");
  EXPECT_EQ(figures[0].remark, "10 m/s at the beginning");
  EXPECT_EQ(figures[1].title, "Speed at the end, b2") << "no rebound of what was at rest";
  EXPECT_EQ(figures[1].remark, "at rest at the beginning");
}

TEST(KeyFigures, RatiosThatSayNothingAreLeftOut) {
  EXPECT_EQ(figures_of_speeds({{1e-4, 5.3}})[0].remark, "100 µm/s at the beginning, velocity change 5.3 m/s");
  EXPECT_EQ(figures_of_speeds({{2.0, 5.0}})[0].remark, "2 m/s at the beginning, ratio 2.5, velocity change 3 m/s");
  EXPECT_EQ(figures_of_speeds({{2.0, -1.0}})[0].remark, "2 m/s at the beginning, ratio 0.5, velocity change 3 m/s");
}

TEST(KeyFigures, ManyBodiesAreThereInTheOrderOfTheCaseAndNoneIsDropped) {
  const std::vector<KeyFigure> figures = figures_of_speeds({{0, 1}, {0, 7}, {0, 0}, {0, 5}, {0, 6}, {0, 2}, {0, 4}});
  std::vector<std::string> titles;
  for (const KeyFigure& f : figures) titles.push_back(f.title);
  EXPECT_EQ(titles, (std::vector<std::string>{"Speed at the end, b2", "Speed at the end, b4", "Speed at the end, b5",
                                              "Speed at the end, b7", "Speed, 3 more"}));
  EXPECT_EQ(figures.back().value, "at most 2 m/s");
  EXPECT_EQ(figures.back().remark, "b1, b3, b6");
  // What the others reach at most is that of both ends.
  EXPECT_EQ(figures_of_speeds({{0, 7}, {0, 5}, {0, 6}, {0, 4}, {3, 1}, {0, 2}}).back().value, "at most 3 m/s");
  // Five are shown whole, and what is at rest is named.
  EXPECT_EQ(figures_of_speeds({{0, 1}, {0, 7}, {0, 5}, {0, 6}, {0, 2}}).size(), 5U);
  const std::vector<KeyFigure> resting = figures_of_speeds({{0, 1}, {0, 0}});
  ASSERT_EQ(resting.size(), 2U);
  EXPECT_EQ(resting[1].title, "Speed, 1 more");
  EXPECT_EQ(resting[1].value, "at rest");
  EXPECT_EQ(resting[1].remark, "b2");
}

TEST(KeyFigures, TheLargestForceHasItsTime) {
  EXPECT_EQ(time_of_largest_force(std::nullopt), std::nullopt);
  EXPECT_EQ(time_of_largest_force(table_of({{"time", {0, 1, 2}}, {"a.force_x", {0, 0, 0}}})), std::nullopt);
  EXPECT_EQ(
      time_of_largest_force(table_of(
          {{"time", {0, 1, 2}}, {"a.force_x", {0, 3, 0}}, {"a.force_y", {0, 4, 0}}, {"b.force_x", {0, 0, -4.9}}})),
      std::optional(1.0));
}

const std::string kOfEnforcement = "goes with the contact's stiffness or the step, and a cell's ringing";

/// What is said of the peak force of a floor, with forces and impulses of rows 1 s apart.
std::string remark_on_floor(const std::vector<double>& force, const std::vector<double>& impulse, double crossing) {
  Columns columns{{"time", {}}, {"floor.force_z", force}, {"floor.impulse_z", impulse}};
  for (std::size_t row = 0; row < force.size(); ++row) columns[0].second.push_back(static_cast<double>(row));
  Summary summary;
  summary.crossings = {{"floor", crossing}};
  for (const KeyFigure& f : key_figures({.contact = table_of(columns)}, summary, units_of("SI")))
    if (f.title == "Peak force, floor") return f.value + " " + f.remark;
  return "";
}

// A blow of 10 N s by the trapezoidal rule, all of it within 4 s: 2.5 N in the mean.
TEST(KeyFigures, PeaksStandBesideTheMeanOverAWavesWayThroughACell) {
  const std::vector<double> blow{0, 0, 10, 0, 0, 0, 0, 0, 0}, of_blow{0, 0, 5, 10, 10, 10, 10, 10, 10};
  EXPECT_EQ(
      remark_on_floor(blow, of_blow, 4.0),
      "10 N at 2 s; at most 2.5 N in the mean of 4 s, a wave's way through a cell: what is above it " + kOfEnforcement);
  // Windows of 2.5 s hold all of it, too, wherever they begin between 0 and 0.5 s: rows need not be their ends.
  EXPECT_NE(remark_on_floor(blow, of_blow, 2.5).find("at most 4 N in the mean of 2.5 s"), std::string::npos);
  EXPECT_EQ(remark_on_floor(blow, of_blow, 0.5), "10 N at 2 s") << "rows too far apart to know";
  EXPECT_EQ(remark_on_floor({10, 10, 10, 10}, {0, 10, 20, 30}, 2.0), "10 N at 0 s") << "what lasts is no ringing";
}

// In statics time is that of the loads.
TEST(KeyFigures, StaticsHasNoImpulsesAndNoStepsThatRing) {
  Tables tables;
  tables.energy = table_of({{"time", {0, 1}}, {"kinetic", {0, 0}}});
  tables.contact = table_of({{"time", {0, 1}}, {"floor.force_z", {0, 8}}, {"floor.impulse_z", {0, 4}}});
  const std::vector<KeyFigure> figures = key_figures(tables, std::nullopt, units_of("SI"));
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].title + ": " + figures[0].remark, "Peak force, floor: at 1 s");
}

// The preload of a static stage is no impact: force times the time of its loads is no impulse.
TEST(KeyFigures, OfImpactsBeginWhereTheMotionBegins) {
  Tables tables;
  tables.energy = table_of({{"time", {0, 1, 1.5, 2, 2.5}}, {"kinetic", {0, 0, 3, 4, 0}}});
  tables.contact = table_of({{"time", {0, 1, 1.5, 2, 2.5}},
                             {"floor.closed", {0, 1, 1, 0, 0}},
                             {"floor.force_z", {0, 40, 8, 0, 0}},
                             {"floor.impulse_z", {0, 20, 26, 27, 27}}});
  std::map<std::string, double> values;
  for (const KeyFigure& f : key_figures(tables, std::nullopt, units_of("SI"))) values[f.title] = f.number;
  EXPECT_EQ(values.at("Impulse, floor"), 7.0);
  EXPECT_EQ(values.at("Duration of contact, floor"), 0.75);
}

TEST(KeyFigures, LeadWithWhatTheStiffnessOfContactLeavesAlone) {
  Tables tables;
  tables.contact = table_of({{"time", {0, 1, 2}},
                             {"floor.force_x", {0, 8, 0}},
                             {"floor.impulse_x", {0, 3, 6}},
                             {"floor.impulse_y", {0, 4, 8}},
                             {"floor.closed", {0, 1, 0}}});
  Summary summary;
  summary.parts = {{"ball", 1.0, {-2, 0, 0}, {1, 0, 0}}};
  std::vector<std::string> titles;
  const std::vector<KeyFigure> figures = key_figures(tables, summary, units_of("SI"));
  for (const KeyFigure& f : figures) titles.push_back(f.title);
  EXPECT_EQ(titles, (std::vector<std::string>{"Impulse, floor", "Duration of contact, floor", "Rebound speed, ball",
                                              "Peak force, floor"}));
  EXPECT_EQ(figures[0].value, "10 N s");
}

TEST(KeyFigures, ATieIsNoImpact) {
  const CsvTable contact = table_of({{"time", {0, 1, 2}},
                                     {"glue.force_x", {0, 3, -9}},
                                     {"glue.impulse_x", {0, 1, -2}},
                                     {"glue.closed", {4, 4, 4}},
                                     {"floor.force_x", {0, 8, 0}},
                                     {"floor.impulse_x", {0, 4, 8}},
                                     {"floor.closed", {0, 1, 0}}});
  std::vector<std::string> of_glue;
  for (const KeyFigure& f : key_figures({.contact = contact, .ties = {"glue"}}, std::nullopt, units_of("SI")))
    if (f.title.ends_with("glue")) of_glue.push_back(f.title + ": " + f.value + " " + f.remark);
  EXPECT_EQ(of_glue, std::vector<std::string>{"Largest force carried by tie glue: 9 N at 2 s"});
  EXPECT_EQ(time_of_largest_force(contact, {"glue"}), std::optional(1.0));
  EXPECT_EQ(time_of_largest_force(contact, {"glue", "floor"}), std::optional(2.0));
}

TEST(KeyFigures, HaveWhatFiltersLeaveOfPeaks) {
  constexpr double g = 9.80665;
  Tables tables;
  tables.contact = table_of({{"time", {0, 1, 2}}, {"floor.force_x", {0, 8, 0}}, {"floor.force_y", {0, 0, 0}}});
  tables.contact_filtered = table_of({{"time", {0, 1, 2}}, {"floor.force_x", {0, 5, 6}}, {"floor.force_y", {0, 0, 0}}});
  tables.contact_filtered->comments = {"floor.force_x: SAE J211 CFC 600"};
  tables.probes = table_of({{"time", {0, 1, 2}},
                            {"head.acceleration_x", {0, 50, 0}},
                            {"head.acceleration_y", {0, 0, 0}},
                            {"head.acceleration_z", {0, 0, 0}}});
  tables.probes_filtered = table_of({{"time", {0, 1, 2}},
                                     {"head.acceleration_x", {0, 0, 0}},
                                     {"head.acceleration_y", {0, 0, 3 * g}},
                                     {"head.acceleration_z", {0, 0, 4 * g}}});
  tables.probes_filtered->comments = {"head.acceleration_x: SAE J211 CFC 1000"};
  const std::vector<KeyFigure> figures = key_figures(tables, std::nullopt, units_of("SI"));
  const auto has = [&](const std::string& name, const std::string& value, const std::string& remark) {
    return std::ranges::any_of(
        figures, [&](const KeyFigure& f) { return f.title == name && f.value == value && f.remark == remark; });
  };
  EXPECT_TRUE(has("Peak force, floor, CFC 600", "6 N", "at 2 s; 8 N unfiltered, which " + kOfEnforcement));
  EXPECT_TRUE(has("Peak acceleration, head, CFC 1000", "5 g", "49.03 m/s², at 2 s; 5.099 g unfiltered"));
  for (const KeyFigure& f : figures)
    if (f.title.starts_with("Peak acceleration")) {
      EXPECT_DOUBLE_EQ(f.number, 5.0);
      EXPECT_EQ(f.unit, "g");
    }
  const std::vector<LargestValue> largest = largest_values(tables, std::nullopt, units_of("SI"));
  const auto of = [&](const std::string& quantity) {
    const auto found = std::ranges::find(largest, quantity, &LargestValue::quantity);
    return found == largest.end() ? "" : found->value;
  };
  EXPECT_EQ(of("force"), "8 N");
  EXPECT_EQ(of("force, filtered"), "6 N");
  EXPECT_EQ(of("acceleration"), "50 m/s², 5.099 g");
  EXPECT_EQ(of("acceleration, filtered"), "49.03 m/s², 5 g");
  tables.probes_filtered.reset();
  for (const KeyFigure& figure : key_figures(tables, std::nullopt, units_of("SI")))
    EXPECT_FALSE(figure.title.starts_with("Peak acceleration")) << "of a mesh whose nodes shake";
}

// One picture for each quantity, the parts in the colours of the view; of many parts the highest.
TEST(Charts, PartsShareAChartOfEachQuantity) {
  Tables tables;
  tables.parts = table_of({{"time", {0, 1}},
                           {"glass.kinetic_energy", {5, 4}},
                           {"glass.momentum_z", {-2, 1}},
                           {"case.kinetic_energy", {0, 0}},
                           {"case.momentum_z", {0, 3}},
                           {"foam.kinetic_energy", {7, 2}},
                           {"foam.momentum_z", {1, 1}}});
  const auto charts = make_charts(tables, kUnits);
  const Chart* kinetic = find(charts, "Kinetic energy");
  ASSERT_NE(kinetic, nullptr);
  EXPECT_EQ(kinetic->section, "Parts");
  EXPECT_EQ(kinetic->unit, "mJ");
  ASSERT_EQ(kinetic->curves.size(), 2U);
  EXPECT_EQ(kinetic->curves[0].name, "glass");
  EXPECT_EQ(kinetic->curves[0].colour, std::optional<std::size_t>(0));
  EXPECT_EQ(kinetic->curves[1].name, "foam");
  EXPECT_EQ(kinetic->curves[1].colour, std::optional<std::size_t>(2));  // the third part of the case
  EXPECT_EQ(kinetic->note, "Not drawn, zero or below 1e-9 of the largest: case.");
  const Chart* momentum = find(charts, "Momentum, z");
  ASSERT_NE(momentum, nullptr);
  EXPECT_EQ(momentum->curves.size(), 3U);

  Columns many{{"time", {0, 1}}};
  for (int p = 0; p < 10; ++p) many.push_back({fmt::format("p{}.kinetic_energy", p), {1.0 + p, 0.5}});
  const auto shown = make_charts({.parts = table_of(many)}, kUnits);
  ASSERT_EQ(shown.size(), 1U);
  for (std::size_t p = 0; p < 10; ++p) EXPECT_EQ(shown[0].curves[p].shown, p >= 2) << p;

  EXPECT_TRUE(make_charts({.parts = table_of({{"time", {0, 1}}, {"all.kinetic_energy", {1, 2}}})}, kUnits).empty());
}

TEST(KeyFigures, LargestValuesOfParts) {
  const CsvTable table = table_of({{"time", {0, 1, 2}},
                                   {"glass.kinetic_energy", {5, 4, 6}},
                                   {"glass.plastic_energy", {0, 0, 0}},
                                   {"glass.momentum_x", {-3, 1, 0}},
                                   {"glass.momentum_y", {4, 1, 0}},
                                   {"foam.kinetic_energy", {0, 0, 0}},
                                   {"foam.plastic_energy", {0, 0, 0}},
                                   {"foam.momentum_x", {0, 1, 0}},
                                   {"foam.momentum_y", {0, 0, 0}}});
  const PartValues largest = largest_of_parts(table, units_of("SI"));
  EXPECT_EQ(largest.parts, (std::vector<std::string>{"glass", "foam"}));
  EXPECT_EQ(largest.quantities, (std::vector<std::string>{"kinetic energy", "momentum"}));
  EXPECT_EQ(largest.values[0][0].value, "6 J");
  EXPECT_EQ(largest.values[0][0].time, "2 s");
  EXPECT_EQ(largest.values[0][1].value, "5 kg m/s");
  EXPECT_EQ(largest.values[1][0].value, "–");
  EXPECT_EQ(largest.values[1][1].time, "1 s");
}

// In milliseconds and millimetres: frequencies in kHz, 1 g = 9.80665e-3 mm/ms^2.
TEST(KeyFigures, ShockIsSaidAndItsSpectrumDrawn) {
  Summary summary;
  ShockSummary shock{"head", "acceleration", 1000.0, 10.0};
  shock.hic15 = 250.0;
  shock.hic15_begin = 1.0;
  shock.hic15_end = 5.0;
  shock.hic36 = 300.0;
  shock.hic36_end = 20.0;
  shock.peak_g = 120.0;
  shock.pulse_begin = 1.0;
  shock.pulse_end = 7.5;
  shock.velocity_change = 4.0;
  summary.shock = {shock};
  const Units units = units_of("mm-kg-ms");
  const std::vector<KeyFigure> figures = key_figures({}, summary, units);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].title, "HIC15, head");
  EXPECT_EQ(figures[0].value, "250");
  EXPECT_EQ(figures[0].remark, "from 1 ms to 5 ms; HIC36 300, from 0 ms to 20 ms; CFC 1000");
  EXPECT_EQ(figures[1].title, "Shock pulse, head");
  EXPECT_EQ(figures[1].value, "6.5 ms");
  EXPECT_EQ(figures[1].remark, "above a tenth of its peak of 120 g; velocity change 4 mm/ms; CFC 1000");
  CsvTable table = table_of({{"frequency", {0.01, 0.1, 1.0}},
                             {"head.acceleration_x", {0, 0, 0}},
                             {"head.acceleration_y", {9.80665e-3, 9.80665e-2, std::nan("")}},
                             {"head.acceleration_z", {9.80665e-6, 0, 0}}});
  const std::vector<XyPlot> plots = spectrum_plots(table, summary, units);
  ASSERT_EQ(plots.size(), 1U);
  EXPECT_EQ(plots[0].title, "head · Q = 10, CFC 1000: y");  // the others are nothing beside it
  ASSERT_EQ(plots[0].curves.size(), 1U);
  ASSERT_EQ(plots[0].curves[0].x.size(), 2U);
  EXPECT_DOUBLE_EQ(plots[0].curves[0].x[1], 100.0);
  EXPECT_NEAR(plots[0].curves[0].y[1], 10.0, 1e-12);
  const std::string html = xy_plot(plots[0]);
  EXPECT_NE(html.find(">100</text>"), std::string::npos) << html;  // ticks of a logarithmic axis
}

}  // namespace
}  // namespace carom::report_charts_test
