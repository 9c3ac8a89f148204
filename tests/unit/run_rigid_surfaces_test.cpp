// Rigid surfaces of faces that are finer than the cells they meet.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "run_fixture.hpp"

namespace carom::run_rigid_surfaces_test {
namespace {

using namespace test;

/// A cube of one cell, side 1 and mass 1000, falls at 1 m/s on a rigid punch of side 0.2 that none of its nodes meets.
std::string on_punch(const std::string& scheme, bool is_plane) {
  const std::string kind = is_plane ? "kind = \"quad\"\n" : "";
  const auto numbers = [&](const char* plane, const char* solid) { return is_plane ? plane : solid; };
  return fmt::format(R"(units = "SI"
[mesh]
unused = "ignore"
[[mesh.block]]
{0}origin = [-0.5, 0.0, {1}]
size = {2}
divisions = {3}
groups = {{ cells = "BLOCK", ymin = "FOOT" }}
[[mesh.block]]
{0}origin = [-0.1, -0.31, {4}]
size = {5}
divisions = {3}
groups = {{ cells = "PUNCH", xmin = "SKIN", xmax = "SKIN", ymax = "SKIN" }}
[materials.stuff]
law = "linear_elastic"
E = 1.0e9
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "stuff"
section = "{6}"
[[initial]]
part = "block"
velocity = [0.0, -1.0, 0.0]
[[contact]]
name = "punch"
kind = "surface"
group = "FOOT"
surface = "SKIN"
[scheme]
{7}
end = 0.03
[output]
fields = []
)",
                     kind, is_plane ? 0.0 : -0.5, numbers("[1.0, 1.0]", "[1.0, 1.0, 1.0]"),
                     numbers("[1, 1]", "[1, 1, 1]"), is_plane ? 0.0 : -0.1, numbers("[0.2, 0.3]", "[0.2, 0.3, 0.2]"),
                     is_plane ? "plane_strain" : "solid", scheme);
}

// The block is stopped, 1000 N s, and thrown back with what is left of its energy: at most as much again, and a quarter
// of a per cent more where half a per cent of energy gained is still good.
TEST(RigidSurfaces, StopFacesThatTheyMeetBetweenNodes) {
  for (const bool is_plane : {true, false}) {
    for (const char* scheme : {"kind = \"central_differences\"\n[time]", "kind = \"newmark\"\n[time]\nstep = 1e-4"}) {
      const TemporaryCase run(on_punch(scheme, is_plane));
      EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
      const double impulse = last_row(run.result("contact.csv")).at("punch.impulse_y");
      EXPECT_GT(impulse, 1000.0) << scheme << is_plane;
      EXPECT_LT(impulse, 2002.5) << scheme << is_plane;
      EXPECT_NEAR(last_row(run.result("energy.csv")).at("momentum_y"), impulse - 1000.0, 1e-6) << scheme << is_plane;
    }
  }
}

/// A block of 3 x 2 cells that is pressed with 1e6 on a rigid floor ten times as wide, of one face and of seven.
std::string on_floor(int faces) {
  return fmt::format(R"(units = "SI"
[mesh]
unused = "ignore"
[[mesh.block]]
kind = "quad"
origin = [0.0, 0.0, 0.0]
size = [1.0, 1.0]
divisions = [3, 2]
groups = {{ cells = "BLOCK", ymin = "FOOT", ymax = "HEAD", xmin = "LEFT" }}
[[mesh.block]]
kind = "quad"
origin = [-4.0, -1.0, 0.0]
size = [10.0, 1.0]
divisions = [{}, 1]
groups = {{ cells = "FLOOR", ymax = "TOP", xmin = "TOP", xmax = "TOP" }}
[materials.stuff]
law = "linear_elastic"
E = 1.0e9
nu = 0.3
rho = 1000.0
[[part]]
name = "block"
cells = "BLOCK"
material = "stuff"
section = "plane_strain"
[[support]]
nodes = "LEFT"
blocked = ["x"]
[[load]]
group = "HEAD"
pressure = 1.0e6
[[contact]]
name = "floor"
kind = "surface"
group = "FOOT"
surface = "TOP"
stiffness = 1.0e9
[scheme]
kind = "statics"
enforcement = "penalty"
[time]
step = 1.0
end = 1.0
[output]
fields = []
)",
                     faces);
}

// Springs of 1e9 per area under a uniform pressure of 1e6 are pressed by 1e-3, wherever the faces of the floor end. The
// equations are solved to 1e-8 of their forces.
TEST(RigidSurfaces, CarryAUniformPressure) {
  for (const int faces : {1, 7}) {
    const TemporaryCase run(on_floor(faces));
    EXPECT_EQ(run.run(), ExitCode::good) << run.result("summary.json");
    const auto contact = last_row(run.result("contact.csv"));
    EXPECT_NEAR(contact.at("floor.force_y"), 1e6, 0.1) << faces;
    EXPECT_NEAR(contact.at("floor.penetration"), 1e-3, 1e-10) << faces;
    EXPECT_EQ(contact.at("floor.closed"), 4.0) << faces;
  }
}

}  // namespace
}  // namespace carom::run_rigid_surfaces_test
