// The point driver: paths, closed forms, tables, files and what is refused.
#include "driver/material_path.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/errors.hpp"
#include "casefile/read_case.hpp"
#include "driver/material_page.hpp"
#include "driver/measured_curve.hpp"
#include "report/csv_table.hpp"
#include "report/xy_plot.hpp"

namespace carom::run_material_path_test {
namespace {

constexpr double E = 200.0, nu = 0.3, yield = 1.0, H = 10.0;

Material material(const char* law) {
  return {law, 1.0, {{"E", E}, {"nu", nu}, {"yield_stress", yield}, {"hardening_modulus", H}}};
}

MaterialPath path(const std::string& kind, std::vector<double> to, int steps = 50) {
  return make_path({.path = kind, .to = std::move(to), .steps = steps, .rate = 2.0});
}

// sigma = yield + H alpha, eps = sigma / E + alpha; at a rate of 2 the leg of 0.05 takes 0.025.
TEST(MaterialPath, TensionIsTheTensileTest) {
  const MaterialCurve curve = follow(material("j2_small_strain"), 0, path("uniaxial_stress", {0.05}));
  const std::vector<double> strain = curve.column("strain"), stress = curve.column("stress_xx");
  ASSERT_EQ(strain.size(), 51U);
  EXPECT_EQ(stress[0], 0.0);
  for (std::size_t i = 0; i < strain.size(); ++i) {
    const double elastic = E * strain[i], plastic = (yield + H * strain[i]) / (1 + H / E);
    EXPECT_NEAR(stress[i], std::min(elastic, plastic), 1e-12);
    EXPECT_NEAR(curve.column("von_mises")[i], stress[i], 1e-12);
    EXPECT_EQ(curve.column("stress_yy")[i], 0.0);
  }
  EXPECT_NEAR(curve.column("time").back(), 0.025, 1e-15);
  const double alpha = curve.column("equivalent_plastic_strain").back();
  EXPECT_NEAR(curve.column("dissipation").back(), (yield + 0.5 * H * alpha) * alpha, 1e-12);
  EXPECT_NEAR(curve.column("F_yy").back(), 1 - nu * stress.back() / E - 0.5 * alpha, 1e-12);
}

// At finite strain tau follows ln(l / l_0) and the Cauchy stress is tau / J; the sides give J = exp((1 - 2 nu) tau /
// E).
TEST(MaterialPath, FiniteTensionGivesCauchyStress) {
  const MaterialCurve curve = follow(material("j2"), 0, path("uniaxial_stress", {0.5, -0.2}));
  const std::vector<double> strain = curve.column("strain"), stress = curve.column("stress_xx");
  const double tau = (yield + H * std::log(1.5)) / (1 + H / E), J = std::exp((1 - 2 * nu) * tau / E);
  EXPECT_NEAR(strain[50], 0.5, 1e-15);
  EXPECT_NEAR(stress[50], tau / J, 1e-11);
  EXPECT_EQ(strain.back(), -0.2);
  EXPECT_LT(stress.back(), -yield);
}

// Hooke: sigma_xy = G gamma in shear, (lambda + 2 G) eps where the sides are held, E / (1 - nu^2) where one is.
TEST(MaterialPath, ElasticPathsHaveTheirModuli) {
  const Material hooke("linear_elastic", 1.0, {{"E", E}, {"nu", nu}});
  const double G = E / (2 * (1 + nu));
  EXPECT_NEAR(follow(hooke, 0, path("simple_shear", {0.1})).column("stress_xy").back(), 0.1 * G, 1e-12);
  const double wave = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_NEAR(follow(hooke, 0, path("uniaxial_strain", {-0.1})).column("stress_xx").back(), -0.1 * wave, 1e-12);
  EXPECT_NEAR(follow(hooke, 1, path("uniaxial_strain", {0.1})).column("stress_xx").back(), 0.1 * E / (1 - nu * nu),
              1e-12);
}

/// A place of this process alone: tests run side by side.
std::string temporary(const std::string& name) {
  return testing::TempDir() + "carom_" + std::to_string(getpid()) + "_" + name;
}

class MaterialTable : public testing::Test {
 protected:
  MaterialCurve curve_of(const std::string& text) {
    std::ofstream(file) << text;
    return follow(material("j2"), 0, make_path({.path = file}));
  }
  std::string message_of(const std::string& text) {
    try {
      curve_of(text);
    } catch (const CaseError& error) {
      return error.what();
    }
    return "no error";
  }
  const std::string file = temporary("material_table.csv");
};

TEST_F(MaterialTable, OfDeformationOrStrainIsFollowed) {
  const MaterialCurve shear = follow(material("j2"), 0, path("simple_shear", {0.1}, 2));
  const MaterialCurve same = curve_of("time,F_xy\n0.025,0.05\n0.05,0.1\n");
  EXPECT_EQ(shear.column("stress_xy"), same.column("stress_xy"));
  const MaterialCurve strained = curve_of("time,strain_xx,strain_xy\n1,0.01,0.02\n");
  EXPECT_EQ(strained.column("F_xx").back(), 1.01);
  EXPECT_EQ(strained.column("F_xy").back(), 0.02);
  EXPECT_EQ(strained.column("F_yx").back(), 0.02);
  // a rotation by 90 degrees after a stretch turns the stress
  const MaterialCurve turned = curve_of("time,F_xx,F_xy,F_yx,F_yy\n1,1.01,0,0,1\n2,0,-1,1.01,0\n");
  EXPECT_NEAR(turned.column("stress_yy").back(), turned.column("stress_xx")[1], 1e-13);
  EXPECT_NEAR(turned.column("stress_xx").back(), turned.column("stress_yy")[1], 1e-13);
}

TEST_F(MaterialTable, WhatIsNoneIsRefused) {
  EXPECT_NE(message_of("time,F_xx\n1,-0.5\n").find("det F = -0.5 in row 1"), std::string::npos);
  EXPECT_NE(message_of("time,F_xx,stress\n1,1,1\n").find("the column stress"), std::string::npos);
  EXPECT_NE(message_of("time,F_xx,strain_xx\n1,1,0\n").find("columns of F and of strain"), std::string::npos);
  EXPECT_NE(message_of("time\n1\n").find("no column of F or strain"), std::string::npos);
  EXPECT_NE(message_of("time,F_xx\n1,1.1\n1,1.2\n").find("time 1 after 1 in row 2"), std::string::npos);
  EXPECT_NE(message_of("time,F_xx\n1,1.1,3\n").find("not a whole row"), std::string::npos);
  EXPECT_NE(message_of("F_xx\n1\n").find("line 1 is not a line of column names beginning with time"),
            std::string::npos);
  EXPECT_NE(message_of("time,F_xx\n0,1.1\n").find("time 0 in row 1"), std::string::npos);
  EXPECT_THROW(make_path({.path = "tension"}), CaseError);
  EXPECT_THROW(path("uniaxial_stress", {-1.0}), CaseError);
  EXPECT_THROW(path("simple_shear", {0.1, 0.1}), CaseError);
}

const std::string text = R"(title = "t"
units = "SI"
[mesh]
file = "none.msh"
[materials.copper]
law = "j2"
E = 117e9
nu = 0.35
rho = 8930.0
yield_stress = 400e6
hardening_modulus = 100e6
[[part]]
name = "rod"
cells = "all"
material = "copper"
[[part]]
name = "wire"
cells = "W"
section = "bar"
area = 1e-6
material = "copper"
[scheme]
kind = "central_differences"
[time]
end = 1e-3
)";

TEST(MaterialDriver, LeavesATableAndAPage) {
  const std::string folder = temporary("material_driver");
  std::filesystem::remove_all(folder);
  const Case given = parse_case(text, "c.toml");
  const std::string printed = drive_material(given, "rod", {.path = "uniaxial_stress", .to = {0.02, -0.02}}, folder);
  // ln(1 + 0.0035) E > 400 MPa, in steps of 1e-4; the Cauchy stress is tau / J
  EXPECT_NE(printed.find("First yielding: 399.6 MPa at a strain of 0.0035"), std::string::npos) << printed;
  const auto table = read_csv(folder + "/rod.csv");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->damage, "");
  EXPECT_EQ(table->rows(), 401U);
  ASSERT_TRUE(table->units);
  EXPECT_EQ(table->units->stress, "Pa");
  std::ifstream stream(folder + "/rod.html");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const char* wanted :
       {"Cauchy stress over strain", "engineering strain", "hardening_modulus", "<svg", "Dissipated"})
    EXPECT_NE(page.find(wanted), std::string::npos) << wanted;
}

TEST(MaterialDriver, RefusesWhatDoesNotGoTogether) {
  const Case given = parse_case(text, "c.toml");
  const std::string folder = temporary("material_refused");
  EXPECT_THROW(drive_material(given, "", {.path = "uniaxial_stress"}, folder), CaseError);
  EXPECT_THROW(drive_material(given, "tube", {.path = "uniaxial_stress"}, folder), CaseError);
  EXPECT_THROW(drive_material(given, "wire", {.path = "simple_shear"}, folder), CaseError);
  EXPECT_NO_THROW(drive_material(given, "wire", {.path = "uniaxial_stress"}, folder));
}

// Of the straight line 2 x through three points: 0.1 off at one of two points within, those beyond do not count.
TEST(MeasuredCurve, IsReadAndCompared) {
  const std::string file = temporary("measured.csv");
  std::ofstream(file) << "# a test\nstrain, stress\n0.25,0.5\n 0.75 , 1.6\r\n\n2.0,9.0\n";
  const MeasuredCurve measured = read_measured(file);
  EXPECT_EQ(measured.strain, (std::vector<double>{0.25, 0.75, 2.0}));
  const std::vector<double> strain{0.0, 0.5, 1.0, 0.5}, stress{0.0, 1.0, 2.0, 7.0};
  EXPECT_NEAR(rms_difference(measured, strain, stress), std::sqrt(0.01 / 2), 1e-15);
  const std::vector<double> shortening{0.0, -0.5, -1.0, -0.5}, compression{0.0, -1.0, -2.0, -7.0};
  EXPECT_NEAR(rms_difference({{-0.25, -0.75, -2.0}, {-0.6, -1.5, 0.0}}, shortening, compression), std::sqrt(0.01 / 2),
              1e-15);
  EXPECT_TRUE(std::isnan(rms_difference({{3.0}, {1.0}}, strain, stress)));
  std::ofstream(file) << "0.25,0.5\nend\n";
  EXPECT_THROW(read_measured(file), CaseError);
  std::ofstream(file) << "0.0;1e8\n0.1,2e8\n";  // a first row that went wrong is not one of names
  EXPECT_THROW(read_measured(file), CaseError);
  std::ofstream(file) << "strain,stress\n";
  EXPECT_THROW(read_measured(file), CaseError);
  EXPECT_THROW(read_measured(file + ".none"), CaseError);
}

// A curve that is flat but for its round-off is drawn, at any size.
TEST(XyPlot, OfFlatCurvesEnds) {
  for (const double value : {0.0, 1e-300, 1.0, 1e17}) {
    XyPlot plot;
    plot.curves.push_back({"flat", {0.0, 1.0}, {value, std::nextafter(value, 1e300)}, false});
    EXPECT_EQ(xy_plot(plot).find("nan"), std::string::npos) << value;
  }
}

// Multiples of 1, 2 or 5 times a power of ten, within the axis.
TEST(XyPlot, HasItsNumbersForAFile) {
  XyPlot plot{"t", "strain", "stress", "", "Pa", {}};
  plot.curves.push_back({"a, \"b\"", {0.0, 0.5}, {1.0, 2.5e6}, false});
  EXPECT_NE(xy_plot(plot).find("data-csv=\"curve,strain,stress [Pa]\n&quot;a, &quot;&quot;b&quot;&quot;&quot;,0,1\n"
                               "&quot;a, &quot;&quot;b&quot;&quot;&quot;,0.5,2500000\n\""),
            std::string::npos);
}

TEST(XyPlot, TicksAreRound) {
  EXPECT_EQ(round_ticks(-0.02, 0.02), (std::vector<double>{-0.02, -0.015, -0.01, -0.005, 0, 0.005, 0.01, 0.015, 0.02}));
  EXPECT_EQ(round_ticks(1.0, 9.0), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(round_ticks(0.0, 45.0), (std::vector<double>{0, 10, 20, 30, 40}));
  EXPECT_TRUE(round_ticks(1.0, 1.0).empty());
}

}  // namespace
}  // namespace carom::run_material_path_test
