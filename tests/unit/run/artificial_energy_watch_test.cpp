// Runs whose energy goes into hourglass modes or artificial viscosity say so, and are good otherwise.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "output/summary.hpp"
#include "run_fixture.hpp"

namespace carom::run_artificial_energy_test {
namespace {

using namespace test;

/// Warnings of the run that speak of energy, and whether the run was good.
std::vector<std::string> warnings_of(const std::string& text) {
  const TemporaryCase given(text);
  EXPECT_EQ(given.run(), ExitCode::good) << given.result("summary.json");
  std::vector<std::string> found = parse_summary(given.result("summary.json")).warnings;
  std::erase_if(found, [](const std::string& warning) { return warning.find("energy") == std::string::npos; });
  return found;
}

/// A cantilever, or with `pulled` a bar, of one layer of cells.
std::string plate(const std::string& formulation, bool pulled) {
  return fmt::format(R"(units = "mm-t-s"
[[mesh.block]]
size = [10.0, 1.0, 1.0]
divisions = [10, 1, 1]
[materials.steel]
law = "linear_elastic"
E = 2.1e5
nu = 0.0
rho = 7.8e-9
[[part]]
name = "plate"
cells = "BLOCK"
material = "steel"
formulation = "{}"
[[support]]
nodes = "XMIN"
blocked = ["x", "y", "z"]
[[load]]
force = {}
group = "XMAX"
[scheme]
kind = "statics"
[time]
end = 1.0
step = 1.0
)",
                     formulation, pulled ? "[0.01, 0.0, 0.0]" : "[0.0, 0.0, -0.01]");
}

// One cell through its thickness bends by nothing but its hourglass modes.
TEST(ArtificialEnergy, OfHourglassModesIsSaid) {
  const std::vector<std::string> found = warnings_of(plate("one_point", false));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("part \"plate\": its hourglass energy")) << found[0];
  EXPECT_NE(found[0].find("formulation = \"stabilised\""), std::string::npos) << found[0];
  EXPECT_TRUE(warnings_of(plate("one_point", true)).empty()) << "a uniform stress excites none";
  EXPECT_TRUE(warnings_of(plate("stabilised", false)).empty()) << "whose modes are the bending";
}

/// A bar falls on a wall.
std::string impact(double viscosity) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
size = [0.1, 0.1, 1.0]
divisions = [1, 1, 20]
[materials.steel]
law = "linear_elastic"
E = 2.0e11
nu = 0.0
rho = 8000.0
[[part]]
name = "bar"
cells = "BLOCK"
material = "steel"
linear_bulk_viscosity = {}
[[initial]]
part = "bar"
velocity = [0.0, 0.0, -1.0]
[[contact]]
name = "wall"
kind = "plane"
group = "ZMIN"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[scheme]
kind = "central_differences"
[time]
end = 4.0e-4
)",
                     viscosity);
}

TEST(ArtificialEnergy, OfViscosityIsSaid) {
  EXPECT_TRUE(warnings_of(impact(0.06)).empty()) << "the customary one";
  const std::vector<std::string> found = warnings_of(impact(3.0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].starts_with("artificial viscosity has dissipated ")) << found[0];
}

// The bar's cells are 0.05 long, narrower than wide, and its waves travel at sqrt(E / rho) = 5000 m/s: 10 us.
TEST(CrossingTimes, AreThoseOfAWaveThroughACell) {
  const TemporaryCase given(impact(0.0));
  EXPECT_EQ(given.run(), ExitCode::good);
  const Summary summary = parse_summary(given.result("summary.json"));
  ASSERT_EQ(summary.crossings.size(), 1U);
  EXPECT_EQ(summary.crossings[0].name, "wall");
  EXPECT_NEAR(summary.crossings[0].value, 1e-5, 1e-19);
  EXPECT_TRUE(summary.ties.empty());
}

}  // namespace
}  // namespace carom::run_artificial_energy_test
