// The same pulse in the three unit systems has the same numbers.
#include "record/shock_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "output/csv.hpp"
#include "run_fixture.hpp"

namespace carom::record_shock_numbers_test {
namespace {

using namespace test;

constexpr double g = 9.80665, A = 100.0 * g, T = 0.006;  // m/s^2, s

/// A half-sine of A and T along -z within 1 ms at rest, in a table that begins later than at 0.
void write_record(const std::string& path, UnitSystem units) {
  const double second = si_factor(Dimension::time, units), unit = si_factor(Dimension::acceleration, units);
  CsvFile file(path, {"time", "head.acceleration_x", "head.acceleration_y", "head.acceleration_z"});
  for (int i = 0; i <= 8000; ++i) {
    const double t = 1e-6 * i - 0.001;
    const double a = t > 0.0 && t < T ? -A * std::sin(std::numbers::pi * t / T) : 0.0;
    file.append(std::vector{(0.002 + t) / second, 0.0, 0.0, a / unit});
  }
  file.close();
}

TEST(ShockNumbers, AreThoseOfThePulseInEveryUnitSystem) {
  for (const UnitSystem units : unit_systems) {
    SCOPED_TRACE(name(units));
    const TemporaryCase folder("");
    const std::string path = folder.results().parent_path().string();
    write_record(path + "/probes.csv", units);
    const std::vector<ShockSummary> found = write_shock(
        {path + "/probes.csv", path + "/probes_filtered.csv", path + "/shock_spectra.csv", {"title"}, units},
        {{"head", "acceleration", 0.0, 25.0}});
    ASSERT_EQ(found.size(), 1U);
    const ShockSummary& shock = found[0];
    const double second = si_factor(Dimension::time, units), speed = si_factor(Dimension::velocity, units);
    EXPECT_EQ(shock.cfc, 0.0);
    EXPECT_NEAR(shock.peak_g, 100.0, 1e-4);
    EXPECT_NEAR(shock.time * second, 0.002 + 0.5 * T, 1e-6);
    EXPECT_NEAR((shock.pulse_end - shock.pulse_begin) * second, T * (1.0 - 2.0 * std::asin(0.1) / std::numbers::pi),
                1e-8);
    EXPECT_NEAR(shock.velocity_change * speed, 2.0 * A * T / std::numbers::pi, 1e-5);
    EXPECT_NEAR(shock.hic15, 0.41465 * 1e5 * T, 0.01);  // tests/unit/output/shock_test.cpp
    EXPECT_EQ(shock.hic36, shock.hic15);
    Columns spectra = read_csv(read_text(path + "/shock_spectra.csv"));
    const std::vector<double>& f = spectra["frequency"];
    // From a tenth of 1 / 8 ms to 10 kHz, the last but twelve being half of the last.
    EXPECT_GE(f.front() / second, 12.5 * (1.0 - 1e-9));
    EXPECT_LT(f.front() / second, 12.5 * std::exp2(1.0 / 12.0));
    EXPECT_LE(f.back() / second, 1e4);
    EXPECT_GT(f.back() / second, 1e4 / std::exp2(1.0 / 12.0));
    EXPECT_NEAR(f[f.size() - 13], 0.5 * f.back(), 1e-12 * f.back());
    // Stiff oscillators follow the pulse: within 1 / (f T)^2.
    EXPECT_NEAR(spectra["head.acceleration_z"].back() * si_factor(Dimension::acceleration, units), A, 0.02 * A);
    EXPECT_EQ(spectra["head.acceleration_x"].back(), 0.0);
  }
}

TEST(ShockNumbers, AreOfTheFilteredRecordUpToItsClass) {
  const TemporaryCase in(case_of_block(R"([[initial]]
part = "body"
velocity = [0.0, 0.0, -0.05]
[[contact]]
name = "floor"
kind = "plane"
group = "FOOT"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = 60.0
[[probe]]
name = "top"
group = "HEAD"
quantities = ["acceleration", "local_acceleration"]
cfc = 0.1
shock = true
)"));
  in.run();
  const std::string summary = in.result("summary.json");
  EXPECT_NE(summary.find("\"cfc\": 0.1"), std::string::npos) << summary;
  EXPECT_NE(summary.find("\"quantity\": \"local_acceleration\""), std::string::npos);
  Columns spectra = read_csv(in.result("shock_spectra.csv")), filtered = read_csv(in.result("probes_filtered.csv"));
  EXPECT_LE(spectra["frequency"].back(), 0.1 * (1.0 + 1e-9));
  EXPECT_GT(spectra["top.local_acceleration_z"].back(), 0.0);
  EXPECT_TRUE(std::filesystem::exists(in.results() / "report.html"));
  EXPECT_NE(in.result("report.html").find("Shock response spectra"), std::string::npos);
}

}  // namespace
}  // namespace carom::record_shock_numbers_test
