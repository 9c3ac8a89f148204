// Errors, orders and advice from tables made by hand.
#include "compare/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "compare/convergence.hpp"
#include "compare/histories.hpp"
#include "compare/log_plot.hpp"
#include "compare/page.hpp"
#include "compare/recommend.hpp"
#include "compare/tables.hpp"
#include "report/xy_plot.hpp"

namespace carom::compare::compare_measure_test {
namespace {

TEST(CompareMeasure, IntegratesByTheTrapezoidalRule) {
  // |u - r| = 1, 0, 2 at t = 0, 1, 3: areas 1/2 and 2; squares 1, 0, 4: 1/2 and 4. |r| = 1, 2, 2: 3/2 and 4; squares
  // 1, 4, 4: 5/2 and 8.
  const std::array<double, 3> time{0.0, 1.0, 3.0}, values{2.0, 2.0, 0.0}, reference{1.0, 2.0, 2.0};
  const Deviation d = deviation(time, values, reference);
  EXPECT_DOUBLE_EQ(d.l1(), 2.5 / 5.5);
  EXPECT_DOUBLE_EQ(d.l2(), std::sqrt(4.5 / 10.5));
  const std::array<double, 3> zero{};
  EXPECT_TRUE(std::isnan(deviation(time, values, zero).l2()));
  EXPECT_TRUE(std::isnan(deviation(time, values, zero).l1()));
}

TEST(CompareMeasure, InterpolatesLinearly) {
  const std::array<double, 3> from{0.0, 1.0, 3.0}, values{1.0, 2.0, 6.0};
  const std::array<double, 6> to{-1.0, 0.0, 0.25, 1.0, 2.0, 4.0};
  EXPECT_EQ(interpolated(from, values, to), (std::vector<double>{1.0, 1.0, 1.25, 2.0, 4.0, 6.0}));
}

CsvTable energy_table(const std::vector<std::vector<double>>& columns) {
  CsvTable table;
  table.columns = {"time",    "kinetic",       "strain",       "contact_stored",
                   "damping", "external_work", "support_work", "friction"};
  table.values = columns;
  return table;
}

TEST(CompareMeasure, EnergyKeptCountsOnlyWhatTheComputationLost) {
  // 10 at the start, 4 supplied, 2 rubbed away and 1 damped: 11 are left where nothing is lost.
  const auto with_end = [](double kinetic) {
    return energy_table(
        {{0.0, 1.0}, {8.0, kinetic}, {1.0, 0.5}, {1.0, 0.5}, {0.0, 1.0}, {0.0, 3.0}, {0.0, 1.0}, {0.0, 2.0}});
  };
  EXPECT_DOUBLE_EQ(energy_kept(with_end(10.0)), 1.0);
  EXPECT_DOUBLE_EQ(energy_kept(with_end(9.0)), 0.9);
  // From rest: scaled by the largest supplied energy, which was given back before the end.
  EXPECT_DOUBLE_EQ(energy_kept(energy_table({{0.0, 1.0, 2.0},
                                             {0.0, 4.0, 0.5},
                                             {0.0, 0.0, 0.0},
                                             {0.0, 0.0, 0.0},
                                             {0.0, 0.0, 0.0},
                                             {0.0, 5.0, 0.0},
                                             {0.0, 0.0, 0.0},
                                             {0.0, 0.0, 0.0}})),
                   1.1);
}

TEST(CompareConvergence, SlopeOfAPowerIsItsExponent) {
  const std::array<double, 3> x{1.0, 2.0, 8.0}, y{3.0, 3.0 * std::pow(2.0, 1.5), 3.0 * std::pow(8.0, 1.5)};
  EXPECT_NEAR(*slope(x, y), 1.5, 1e-14);  // round-off of logarithms
  const std::array<double, 2> same{2.0, 2.0}, any{1.0, 3.0};
  EXPECT_FALSE(slope(same, any));
}

TEST(CompareLogPlot, TicksAreRoundNumbers) {
  EXPECT_EQ(log_ticks(0.04, 0.6), (std::vector<double>{0.05, 0.1, 0.2, 0.5}));
  EXPECT_EQ(log_ticks(0.5, 2000.0), (std::vector<double>{1.0, 10.0, 100.0, 1000.0}));
}

/// A run that ended, whose force is `force` at t = 0, 1, 2 beside the exact 1.
Result result_of(const std::string& scheme, int cells, double force, double cpu_seconds) {
  Result r;
  r.variant.choice.scheme = r.variant.varied.scheme = r.variant.scheme = scheme;
  r.variant.choice.cells = r.variant.varied.cells = r.variant.cells = cells;
  r.variant.label = label_of(r.variant.varied);
  r.variant.name = scheme + std::to_string(cells);
  r.variant.element_step = 2.0;
  r.exit_code = 0;
  r.summary.emplace();
  r.summary->outcome = Outcome::good;
  r.summary->scheme.dt_largest = 1.0;
  r.summary->scheme.steps = 2;
  r.summary->mesh.cells = static_cast<std::size_t>(cells);
  r.summary->cost.cpu_seconds = cpu_seconds;
  r.summary->verdict = {{"quadrature", 0.01, 0.05, true, ""}, {"penetration", 0.002, 0.05, true, ""}};
  r.curves.columns = {"time", "A.velocity_z", "wall.force_z", "wall.penetration", "kinetic"};
  r.curves.values = {{0.0, 1.0, 2.0}, {1.0, 1.0, 1.0}, {force, force, force}, {0.0, 0.1, 0.0}, {1.0, 1.0, 1.0}};
  r.exact.emplace();
  r.exact->columns = {"time", "A.velocity_z", "wall.force_z"};
  r.exact->values = {{0.0, 1.0, 2.0}, {2.0, 2.0, 2.0}, {1.0, 1.0, 1.0}};
  r.energy_kept = 0.99;
  r.penetration = 0.1;
  return r;
}

/// Errors of the force 0.2, 0.1, 0.09 and 0.4.
Comparison sample() {
  Comparison c;
  c.title = "Sample <b>";
  c.units = "SI";
  c.results = {result_of("a", 10, 1.2, 1.0), result_of("a", 20, 1.1, 2.0), result_of("b", 20, 1.09, 5.0),
               result_of("b", 40, 1.4, 0.1)};
  return c;
}

void finish(Comparison& c) {
  c.reference = measure(c.results);
  c.quantity = ranking_quantity(c.results);
  c.claims = claim_errors(c.results, c.quantity);
  c.recommendation = recommend(c.results, c.quantity, c.reference, c.claims);
}

TEST(CompareMeasure, ComparesWithTheExactSolution) {
  Comparison c = sample();
  finish(c);
  EXPECT_EQ(c.reference, ReferenceKind::exact);
  EXPECT_EQ(c.quantity, "force");
  EXPECT_NEAR(c.results[0].error("force"), 0.2, 1e-15);
  EXPECT_NEAR(c.results[0].error("velocity"), 0.5, 1e-15);
  EXPECT_DOUBLE_EQ(c.results[0].peak_force / c.results[0].reference_peak_force, 1.2);
  EXPECT_TRUE(std::isnan(c.results[0].error("kinetic")));  // exact.csv does not hold it
}

TEST(CompareMeasure, ComparesWithTheFinestRunWithoutAnExactSolution) {
  Comparison c = sample();
  for (Result& r : c.results) r.exact.reset();
  finish(c);
  EXPECT_EQ(c.reference, ReferenceKind::finest);
  EXPECT_EQ(c.finest(), &c.results[3]);
  EXPECT_NEAR(c.results[0].error("force"), 0.2 / 1.4, 1e-15);
  EXPECT_DOUBLE_EQ(c.results[0].error("kinetic"), 0.0);
  EXPECT_TRUE(std::isnan(c.results[0].error("penetration")));
  // All have one enforcement: nobody can say what it does to them.
  EXPECT_FALSE(c.recommendation.result);
  EXPECT_NE(c.recommendation.headline.find("No run can judge another"), std::string::npos);
  ASSERT_EQ(c.recommendation.reasons.size(), 1U);
  EXPECT_NE(c.recommendation.reasons[0].find("--enforcement"), std::string::npos);
}

TEST(CompareRecommend, TakesTheCheapestOfThoseThatAreAsGood) {
  Comparison c = sample();
  finish(c);
  EXPECT_EQ(c.recommendation.result, std::optional<std::size_t>(1));  // 0.1 <= 1.25 x 0.09, and 2 s instead of 5 s
  EXPECT_NE(c.recommendation.reasons[1].find("1.11 times the smallest (9 %, b, 20 cells)"), std::string::npos)
      << c.recommendation.reasons[1];
  c.results[1].summary->verdict[0] = {"quadrature", 0.06, 0.05, false, ""};
  c.recommendation = recommend(c.results, c.quantity, c.reference, c.claims);
  EXPECT_EQ(c.recommendation.result, std::optional<std::size_t>(2));
  EXPECT_NE(c.recommendation.reasons.back().find("a, 20 cells; its verdict fails (quadrature 0.06 > 0.05)"),
            std::string::npos);
}

TEST(CompareRecommend, RecommendsNothingThatFails) {
  Comparison c = sample();
  for (Result& r : c.results) r.summary->verdict[0].pass = false;
  finish(c);
  EXPECT_FALSE(c.recommendation.result);
  EXPECT_EQ(c.recommendation.reasons.size(), 4U);
}

// Books that are off by rounding say nothing against the curves.
TEST(CompareRecommend, ConsidersRunsWhoseBooksAreOffByRounding) {
  Comparison c = sample();
  c.results[1].summary->verdict.push_back({"energy balance", 1.02e-10, 1e-10, false, ""});
  finish(c);
  EXPECT_EQ(c.recommendation.result, std::optional<std::size_t>(1));
  EXPECT_NE(c.recommendation.reasons.back().find("a, 20 cells; its verdict fails by rounding alone"),
            std::string::npos);
  c.results[1].summary->verdict.back().value = 1e-6;
  finish(c);
  EXPECT_EQ(c.recommendation.result, std::optional<std::size_t>(2));
}

TEST(CompareRecommend, RecommendsNothingFromErrorsThatSayNothing) {
  Comparison c;
  c.results = {result_of("a", 10, 1.35, 1.0), result_of("a", 20, 1.35, 2.0)};  // 35 %, order 0
  finish(c);
  EXPECT_FALSE(c.recommendation.result);
  EXPECT_NE(c.recommendation.reasons.front().find("35 %"), std::string::npos);
}

/// Runs with contact enforced in a way, the step in proportion to the cells, without an exact solution.
Result judged_run(const std::string& scheme, const std::string& enforcement, int cells, double force, double cpu) {
  Result r = result_of(scheme, cells, force, cpu);
  r.variant.enforcement = enforcement;
  r.summary->scheme.dt_largest = 1.0 / cells;
  r.exact.reset();
  return r;
}

/// Forces that tend to 1 with the cells, by a penalty that is off by 1 / cells and exactly, off by a tenth of that.
Comparison judged_sample() {
  Comparison c;
  c.results = {judged_run("p", "penalty", 10, 1.1, 1.0), judged_run("p", "penalty", 20, 1.05, 2.0),
               judged_run("l", "lagrange", 10, 1.01, 1.0), judged_run("l", "lagrange", 20, 1.005, 2.0)};
  return c;
}

// Expected numbers by hand, from the rule in claims.hpp.
TEST(CompareClaims, AreOfRunsThatShareNothingAndAboveTheSpread) {
  Comparison c = judged_sample();
  finish(c);
  const double spread = 0.045 / 1.05;  // of the two differences, over 1.05 and over 1.005, the smaller
  EXPECT_NEAR(c.claims.spread, spread, 1e-14);
  EXPECT_NEAR(c.results[1].claimed, 3.0 * 0.05 / 1.05, 1e-14);
  EXPECT_NEAR(c.results[3].claimed, spread, 1e-14);  // 3 x 0.005 / 1.005 is less
  EXPECT_NEAR(c.results[0].claimed, 0.095 / 1.005 + spread, 1e-14);
  EXPECT_NEAR(c.results[2].claimed, 0.04 / 1.05 + 0.15 / 1.05, 1e-14);
  EXPECT_EQ(c.recommendation.result, std::optional<std::size_t>(3));
  const std::vector<double> truth{0.1, 0.05, 0.01, 0.005};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_GE(c.results[i].claimed, truth[i]) << i;
  const auto tells = [&](const char* text) {
    return std::any_of(c.recommendation.reasons.begin(), c.recommendation.reasons.end(),
                       [&](const std::string& reason) { return reason.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(tells("Enforcements of contact differ by 4.29 %"));
  EXPECT_TRUE(tells("claimed error of the force is the smallest of them, 4.29 %"));
}

TEST(CompareClaims, OfThreeMeshesTakeTheObservedOrder) {
  Comparison c = judged_sample();
  c.results.push_back(judged_run("p", "penalty", 40, 1.025, 4.0));
  c.results.push_back(judged_run("l", "lagrange", 40, 1.0025, 4.0));
  finish(c);
  // 0.05 / 1.05 to 0.025 / 1.025: an order of 0.965
  const double order = std::log2((0.05 / 1.05) / (0.025 / 1.025));
  EXPECT_NEAR(c.results[4].claimed, 1.25 * (0.025 / 1.025) / (std::pow(2.0, order) - 1.0), 1e-14);
  // Slow convergence counts as that of curves that jump.
  c.results[1].curves.values[2] = {1.06, 1.06, 1.06};
  finish(c);
  EXPECT_NEAR(c.results[4].claimed, 1.25 * (0.035 / 1.025) / (std::sqrt(2.0) - 1.0), 1e-13);
  // A run that does not converge is charged more.
  c.results[1].curves.values[2] = {1.1, 1.1, 1.1};
  finish(c);
  EXPECT_NEAR(c.results[4].claimed, 3.0 * (0.075 / 1.025) / (std::sqrt(2.0) - 1.0), 1e-13);
}

TEST(CompareClaims, AreNoneWhereAllShareTheirMesh) {
  Comparison c = judged_sample();
  c.results = {c.results[0], c.results[2]};
  finish(c);
  EXPECT_FALSE(c.recommendation.result);
  EXPECT_TRUE(std::isnan(c.results[0].claimed));
  EXPECT_NE(c.recommendation.reasons.front().find("--refine"), std::string::npos);
}

TEST(CompareClaims, ARunOnTheSameMeshGivesNoOrder) {
  Comparison c = judged_sample();
  c.results.push_back(judged_run("p", "penalty", 40, 1.025, 4.0));
  c.results.push_back(judged_run("l", "lagrange", 40, 1.0025, 4.0));
  c.results.back().summary->scheme.steps = 3;  // of runs that are alike the one of more steps
  finish(c);
  ASSERT_EQ(c.finest(), &c.results[5]);
  // The penalty's runs on coarser cells alone share nothing with it: two points are no order.
  const std::vector<Series> all = series_along(c.results, Along::cells, c.quantity);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].points.size(), 2U);
  EXPECT_FALSE(all[0].order);
}

// Of the finest runs the one whose force does not chatter, though the other has more steps.
TEST(CompareMeasure, TheReferenceIsTheLeastNoisyOfTheFinestRunsOrTheNamedOne) {
  Comparison c = sample();
  c.results.push_back(result_of("c", 40, 1.1, 1.0));
  for (Result& r : c.results) r.exact.reset();
  Result& noisy = c.results[3];
  noisy.curves.values[2] = {1.0, -1.0, 1.0};
  noisy.summary->scheme.steps = 4;
  EXPECT_DOUBLE_EQ(variation(noisy.curves), 2.0);
  EXPECT_DOUBLE_EQ(variation(c.results[4].curves), 0.0);
  c.reference = measure(c.results);
  EXPECT_EQ(c.finest(), &c.results[4]);
  EXPECT_NE(c.reference_text().find("least noisy scheme (c, 40 cells"), std::string::npos);

  Comparison named = sample();
  named.reference = measure(named.results, "a");
  EXPECT_EQ(named.reference, ReferenceKind::named);
  EXPECT_EQ(named.finest(), &named.results[1]);  // the finest of a
  Comparison absent = sample();
  EXPECT_THROW(measure(absent.results, "zebra"), CaseError);
}

TEST(CompareConvergence, SeriesShareAllButOneChoice) {
  Comparison c = sample();
  finish(c);
  const std::vector<Series> all = series_along(c.results, Along::cells, c.quantity);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "a");
  EXPECT_FALSE(all[0].order);  // of two points
  EXPECT_TRUE(series_along(c.results, Along::stiffness, c.quantity).empty());
  EXPECT_TRUE(series_along(c.results, Along::step, c.quantity).empty());
  const std::vector<Series> cost = series_of_cost(c.results, c.quantity, c.reference);
  ASSERT_EQ(cost.size(), 2U);
  EXPECT_EQ(cost[1].points[0].x, 0.1);  // ascending in time
}

// 0.2, 0.1 and 0.04 on twice the cells each: 1 and log2(2.5), the mean of both by least squares.
TEST(CompareConvergence, OrdersHaveAScatter) {
  Comparison c = sample();
  c.results.push_back(result_of("a", 40, 1.04, 4.0));
  finish(c);
  const std::vector<Series> all = series_along(c.results, Along::cells, c.quantity);
  ASSERT_TRUE(all[0].order);
  EXPECT_NEAR(all[0].order->least, 1.0, 1e-13);
  EXPECT_NEAR(all[0].order->largest, std::log2(2.5), 1e-13);
  EXPECT_NEAR(all[0].order->slope, 0.5 * (1.0 + std::log2(2.5)), 1e-13);
  EXPECT_EQ(to_string(*all[0].order), "1.16 (1.00 to 1.32)");
  const nlohmann::json json = nlohmann::json::parse(json_table(c));
  EXPECT_NEAR(json["orders"]["cells"]["a"]["least"].get<double>(), 1.0, 1e-13);
  EXPECT_NE(make_page(c, "").find("a: order 1.16 (1.00 to 1.32)"), std::string::npos);
}

// The same runs, their cells doubled by --refine.
TEST(CompareConvergence, RefinementsAreOneSeries) {
  Comparison c = sample();
  for (Result& r : c.results) {
    r.variant.varied.cells.reset();
    r.variant.varied.refine = r.variant.choice.refine = r.variant.cells / 20;
  }
  finish(c);
  const std::vector<Series> all = series_along(c.results, Along::cells, c.quantity);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "a");
  EXPECT_EQ(series_of_cost(c.results, c.quantity, c.reference).size(), 2U);
}

TEST(CompareTables, HoldEveryVariant) {
  Comparison c = sample();
  Result refused;
  refused.variant.name = refused.variant.label = "z";
  refused.exit_code = 2;
  refused.failure = "not allowed: \"z\"";
  c.results.push_back(refused);
  finish(c);
  const nlohmann::json json = nlohmann::json::parse(json_table(c));
  ASSERT_EQ(json["variants"].size(), 5U);
  EXPECT_NEAR(json["variants"][0]["errors"]["force"]["l2"].get<double>(), 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(json["variants"][0]["courant"].get<double>(), 0.5);
  EXPECT_FALSE(json["variants"][4]["allowed"].get<bool>());
  EXPECT_TRUE(json["orders"]["cells"].empty());  // two points are none
  EXPECT_EQ(json["recommendation"]["variant"], "a20");
  const std::string csv = csv_table(c), header = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(header,
            "name,scheme,enforcement,stiffness,cells,courant,step,steps,cpu_seconds,l2_velocity,l1_velocity,l2_force,"
            "l1_force,claimed_error,peak_force,peak_force_over_reference,energy_kept,penetration,status");
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  EXPECT_EQ(last, "z,\"\",\"\",,,,,,,,,,,,,,,,\"not allowed: \"\"z\"\"\"\n");
  EXPECT_EQ(std::count(last.begin(), last.end(), ','), std::count(header.begin(), header.end(), ','));
  EXPECT_NE(remarks_text(c).find("Recommended: a, 20 cells"), std::string::npos);
}

TEST(ComparePage, ShowsVariantsPicturesAndAdvice) {
  Comparison c = sample();
  c.results.push_back(c.results[0]);
  c.results.back().failure = "stopped <early>";
  finish(c);
  const std::string page = make_page(c, "case <text>");
  const auto has = [&page](const char* text) { return page.find(text) != std::string::npos; };
  EXPECT_TRUE(has("<strong>Recommended</strong><span>a, 20 cells</span>"));
  EXPECT_TRUE(has("<a href=\"variants/a20/report.html\">a, 20 cells</a> <strong>recommended</strong>"));
  EXPECT_TRUE(has("stopped &lt;early&gt;"));
  EXPECT_TRUE(has("Sample &lt;b&gt;"));
  EXPECT_TRUE(has("case &lt;text&gt;"));
  const std::vector<Chart> charts = make_histories(c);
  ASSERT_EQ(charts.size(), 2U);  // force, velocity; the sample has no strain energy for the mechanical one
  EXPECT_EQ(charts[0].title, "wall · force z");
  ASSERT_EQ(charts[0].curves.size(), 5U);              // four that ended and the exact one
  EXPECT_EQ(charts[0].curves[3].name, "b, 20 cells");  // the best is drawn last, under the exact one
  EXPECT_EQ(charts[0].curves[4].kind, CurveKind::exact);
}

TEST(ComparePage, HidesTheWorstOfMany) {
  Comparison c;
  c.units = "SI";
  for (int i = 1; i <= 10; ++i) c.results.push_back(result_of("a", i, 1.0 + 0.01 * i, 1.0));
  finish(c);
  const Chart chart = make_histories(c).front();
  ASSERT_EQ(chart.curves.size(), 11U);
  EXPECT_EQ(chart.curves[7].name, "a, 1 cells");
  EXPECT_TRUE(chart.curves[7].shown);
  EXPECT_FALSE(chart.curves[8].shown);
  EXPECT_EQ(chart.curves[9].name, "a, 10 cells");
  EXPECT_FALSE(chart.curves[9].shown);
}

// Steps that differ by more than rounding are others, whatever the unit of time.
TEST(CompareClaims, StepsAreComparedRelativeToEachOther) {
  Result a = result_of("a", 10, 1.2, 1.0), b = result_of("b", 20, 1.1, 2.0);
  a.variant.enforcement = "penalty";
  b.variant.enforcement = "lagrange";
  for (const double unit : {1e-9, 1.0, 1e9}) {
    a.summary->scheme.dt_largest = unit;
    b.summary->scheme.dt_largest = 2.0 * unit;
    EXPECT_TRUE(shares_nothing(a, b)) << unit;
    b.summary->scheme.dt_largest = (1.0 + 1e-9) * unit;
    EXPECT_FALSE(shares_nothing(a, b)) << unit;
  }
}

}  // namespace
}  // namespace carom::compare::compare_measure_test
