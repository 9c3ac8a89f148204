// How far surfaces have slid along each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "exact/friction.hpp"
#include "run_fixture.hpp"
#include "view/frame_file.hpp"

namespace carom::run_contact_slip_test {
namespace {

using namespace test;

/// A bar of mass 2 whose two nodes lie on the ground, or `gap` above it; g = 9.81, and springs of 5e6 per node carry
/// it.
std::string block(double gap, const std::string& contact, const std::string& rest) {
  return fmt::format(R"(units = "SI"
[[mesh.block]]
kind = "bar"
origin = [0.0, 0.0, 0.0]
end = [0.2, 0.0, 0.0]
divisions = 1
groups = {{ cells = "BLOCK" }}
[materials.steel]
law = "linear_elastic"
E = 1.0e9
nu = 0.0
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "steel"
section = "bar"
area = 0.01
[[load]]
gravity = [0.0, 0.0, -9.81]
[[contact]]
name = "ground"
kind = "plane"
group = "BLOCK"
point = [0.0, 0.0, {}]
normal = [0.0, 0.0, 1.0]
measure = "node"
{}
[output]
fields = ["contact_slip"]
precision = "double"
[[probe]]
name = "block"
group = "BLOCK"
quantities = ["displacement", "contact_slip"]
)",
                     -gap, contact) +
         rest;
}

const std::string carried = "initial_penetration = \"prestress\"\nstiffness = 5.0e6\n";

std::string flying(double speed, double height) {
  return fmt::format("[[initial]]\npart = \"block\"\nvelocity = [{}, 0.0, 0.0]\ndisplacement = [0.0, 0.0, {}]\n", speed,
                     height);
}

// Led 0.3 along x and back again, it has slid 0.6 and stands where it stood; the speed is the same all the time, so
// that the rule over the steps errs by rounding alone.
TEST(ContactSlip, IsThePathAndNotThePlace) {
  const TemporaryCase in(block(0.0, carried, R"([[initial]]
part = "block"
displacement = [0.0, 0.0, -1.962e-06]
[[support]]
nodes = "BLOCK"
displacement = { x = 0.3, function = "there_and_back" }
[functions.there_and_back]
time = [0.0, 0.5, 1.5]
value = [0.0, 1.0, -1.0]
[scheme]
kind = "newmark"
[time]
end = 1.0
step = 0.05
)"));
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  Columns rows = test::read_csv(in.result("probes.csv"));
  ASSERT_EQ(rows["time"].size(), 21U);
  for (std::size_t i = 0; i < 21; ++i) EXPECT_NEAR(rows["block.contact_slip"][i], 0.6 * rows["time"][i], 1e-14);
  EXPECT_NEAR(rows["block.displacement_x"].back(), 0.0, 1e-15);
  const FrameFile frame((in.results() / "fields/step_000020.vtkhdf").string());
  const StoredArray* field = frame.point_field("contact_slip");
  ASSERT_NE(field, nullptr);
  EXPECT_NEAR(field->at(0, 0), 0.6, 1e-14);
  EXPECT_NEAR(field->at(1, 0), 0.6, 1e-14);
}

// A block that slows down by friction slides as SlidingBlock says; half of the first step is without friction, as its
// tangential springs start without force: mu g dt / 2 = 2.9e-5 of the speed of 2, for 0.6 s.
TEST(ContactSlip, OfASlidingBlockIsItsWay) {
  const TemporaryCase in(block(0.0, carried + "friction = 0.3\n", flying(2.0, -1.962e-6) + R"([scheme]
kind = "central_differences"
[time]
end = 0.6
step = 2.0e-5
)"));
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  const SlidingBlock exact({.mass = 2.0, .mu = 0.3, .gravity = 9.81, .angle = 0.0, .speed = 2.0});
  const double tolerance = 0.5 * 0.3 * 9.81 * 2e-5 * 0.6;
  EXPECT_NEAR(last_row(in.result("probes.csv"))["block.contact_slip"], exact.position(0.6), 1.1 * tolerance);
}

// Flying 0.05 above the ground it slides nowhere; from sqrt(2 h / g) on, where it stays on the ground, it slides with
// the speed that it has. The step in which it touches counts by halves.
TEST(ContactSlip, CountsFromTheTouchOn) {
  const double speed = 2.0, height = 0.05, step = 1e-3, end = 0.2;
  const TemporaryCase in(block(height, "",
                               flying(speed, 0.0) + fmt::format(R"([scheme]
kind = "moreau_jean"
[time]
end = {}
step = {}
)",
                                                                end, step)));
  ASSERT_EQ(in.run(), ExitCode::good) << in.result("summary.json");
  Columns rows = test::read_csv(in.result("probes.csv"));
  const double touch = std::sqrt(2.0 * height / 9.81);
  for (std::size_t i = 0; i < rows["time"].size(); ++i)
    EXPECT_NEAR(rows["block.contact_slip"][i], speed * std::max(0.0, rows["time"][i] - touch), 2.0 * speed * step);
  EXPECT_EQ(rows["block.contact_slip"][static_cast<std::size_t>(touch / step) - 2], 0.0);
  EXPECT_GT(rows["block.contact_slip"].back(), 0.15);
}

}  // namespace
}  // namespace carom::run_contact_slip_test
